#include "radiosity/kept_rows.h"

#include "raster/hash.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

std::uint64_t hash_options(const Options& options, std::uint64_t request) {
  Hash hash(request);
  hash.add(static_cast<std::uint64_t>(options.rung));
  for (const bool flag :
       {options.choose_rung, options.choose_resolution, options.estimate_error, options.balance,
        options.black_irradiance, options.hash_items, options.files->keeps_black_rows})
    hash.add(static_cast<std::uint64_t>(flag));
  hash.add(options.resolution);
  hash.add(options.error);
  return hash.value();
}

} // namespace

void KeptRows::init(const PatchSet& patches, const Options& options,
                    std::uint64_t request) noexcept {
  patches_ = &patches;
  options_ = &options;
  files_ = options.files;
  head_ = {};
  if (files_ == nullptr)
    return;
  head_.row_count = head_.column_count = patches.patch_count();
  head_.geometry = hash_geometry(patches);
  head_.request = hash_options(options, request);
}

ByteFile* KeptRows::file(Part part) const noexcept {
  if (files_ == nullptr)
    return nullptr;
  return part == Part::kRows    ? files_->rows
         : part == Part::kPairs ? files_->pairs
                                : files_->black_rows;
}

Status KeptRows::past_rounds(Buffer<double>* found) const noexcept {
  for (const Part part : {Part::kRows, Part::kPairs}) {
    MatrixFileHead head;
    bool is_sound = false;
    if (file(part) != nullptr)
      HC_TRY(read_head(*file(part), &head, &is_sound));
    if (is_sound && head.results == head_.results && head.part == part &&
        head.geometry == head_.geometry && head.request == head_.request)
      return found->assign(std::span(head.found, head.rounds));
  }
  return {};
}

void KeptRows::begin_round(const RungSetting& setting, std::span<const double> found) noexcept {
  head_.rung = static_cast<std::uint32_t>(setting.rung);
  head_.resolution = setting.resolution;
  head_.target = setting.target;
  // Beyond the last one that is remembered, a run that was killed begins anew.
  head_.rounds = static_cast<std::uint32_t>(std::min(found.size(), MatrixFileHead::kMostRounds));
  std::copy_n(found.begin(), head_.rounds, head_.found);
}

Status KeptRows::open(Part part, RowStorage* storage) noexcept {
  *storage = {};
  if (files_ == nullptr)
    return {};
  // Of rungs that find pairs first, these and the rows are there together, and pairs are larger.
  const std::uint64_t most = files_->most_bytes, of_rows = most / 3;
  if (most == RowStorage::kUnlimited || head_.setting().rung < Rung::kArea)
    storage->most_bytes = most;
  else
    storage->most_bytes = part == Part::kPairs ? most - of_rows : of_rows;
  storage->range_bytes = files_->range_bytes;
  head_.part = part;
  files_->rows_are_finished = files_->rows_are_finished && part != Part::kRows;
  return file(part) == nullptr ? Status() : open_to_append(*file(part), head_, storage);
}

Status KeptRows::begin_matrix(Part part, FormFactorMatrix* matrix, std::uint64_t* first) noexcept {
  RowStorage storage;
  HC_TRY(open(part, &storage));
  HC_TRY(matrix->init(patches_->patch_count(), patches_->patch_count(), storage));
  *first = 0;
  if (storage.file == nullptr)
    return {};
  std::uint64_t rest = 0;
  HC_TRY(matrix->adopt(storage.file->size(), &rest));
  HC_TRY(storage.file->truncate(rest));
  std::size_t block = 0;
  while (block < matrix->block_count() && matrix->is_finished(block))
    ++block;
  *first = std::min(matrix->block_begin(block), matrix->row_count());
  return {};
}

Status KeptRows::finish(FormFactorMatrix* matrix) noexcept {
  if (files_ == nullptr || files_->rows == nullptr || !files_->keeps_black_rows)
    return {};
  HC_TRY(finish_file(matrix));
  files_->rows_are_finished = true;
  return {};
}

Status KeptRows::read_given(FormFactorMatrix* matrix, RungSetting* setting) noexcept {
  MatrixFileHead head;
  const RowStorage storage{files_->rows, 0, files_->most_bytes, files_->range_bytes};
  HC_TRY(open_finished(storage, *patches_, matrix, &head));
  const RungSetting given = head.setting();
  const bool is_other = (!options_->choose_rung && options_->rung != given.rung) ||
                        (!options_->choose_resolution && given.rung <= Rung::kArea &&
                         options_->resolution != given.resolution);
  if (is_other)
    return Status::error(StatusCode::kInvalidArgument, files_->rows->name(),
                         ": was computed on rung ", rung_name(given.rung), ", resolution ",
                         given.resolution, "; ask for no other, or for another file");
  *setting = given;
  report(matrix->row_count());
  return {};
}

void KeptRows::report(std::uint64_t rows_resumed) const noexcept {
  if (files_ != nullptr)
    files_->rows_resumed = std::max(files_->rows_resumed, rows_resumed);
}

} // namespace hemicube::radiosity
