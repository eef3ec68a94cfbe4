#include "radiosity/cli/kept_files.h"

#include <filesystem>

namespace hemicube::radiosity::cli {

Status KeptFiles::begin(const std::string& path) {
  files.rows = &rows_;
  if (path.empty()) {
    rows_.use_temporary();
    return {};
  }
  files.pairs = &pairs_;
  files.black_rows = &black_rows_;
  HC_TRY(rows_.open(path + ".part"));
  HC_TRY(pairs_.open(path + ".pairs.part"));
  return black_rows_.open(path + ".black.part");
}

Status KeptFiles::begin_hcf(const std::string& path) {
  HC_TRY(begin(path));
  hcf_ = path;
  files.keeps_black_rows = true;
  files.black_rows = nullptr;
  return {};
}

Status KeptFiles::begin_or_read_hcf(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return begin_hcf(path);
  files.rows = &rows_;
  files.rows_are_given = files.keeps_black_rows = true;
  return rows_.open_to_read(path);
}

Status KeptFiles::finish(const Status& run) {
  if (files.rows_are_given)
    return run;
  const StatusCode code = run.code();
  const bool goes_on =
      code == StatusCode::kCancelled || code == StatusCode::kIo || code == StatusCode::kOutOfMemory;
  Status placed;
  // Of a run that did not end, the dial may still find the rows too coarse.
  if (!hcf_.empty() && files.rows_are_finished && !goes_on)
    placed = rows_.rename(hcf_);
  else if (!goes_on)
    rows_.remove();
  if (!goes_on || files.rows_are_finished)
    pairs_.remove();
  if (!goes_on)
    black_rows_.remove();
  if (run.ok())
    return placed;
  const RowFile* kept = rows_.is_on_disk() ? &rows_ : pairs_.is_on_disk() ? &pairs_ : nullptr;
  if (!goes_on || kept == nullptr)
    return run;
  return Status::error(code, run.message(), "; what was computed is kept in ", kept->name(),
                       ": the same command goes on from there");
}

} // namespace hemicube::radiosity::cli
