#include "radiosity/output/file_set.h"

#include "radiosity/output/file_writer.h"
#include "radiosity/output/number_text.h"

#include <atomic>
#include <filesystem>
#include <unistd.h>

namespace hemicube::radiosity {
namespace {

namespace fs = std::filesystem;

/// Different for every call of every running process, so that two runs into one folder do not mix.
std::string temporary_prefix() {
  static std::atomic<unsigned> count{0};
  std::string prefix = ".hemicube-";
  append_number(&prefix, ::getpid());
  prefix += '-';
  append_number(&prefix, count.fetch_add(1));
  prefix += '-';
  return prefix;
}

/// A rename would silently put a file in the place of a device or a symbolic link.
Status check_replaceable(const std::string& path) {
  std::error_code error;
  const fs::file_status found = fs::symlink_status(path, error);
  if (found.type() == fs::file_type::not_found || found.type() == fs::file_type::regular)
    return {};
  const char* what = found.type() == fs::file_type::directory ? "a folder"
                     : found.type() == fs::file_type::symlink ? "a symbolic link"
                     : found.type() == fs::file_type::none    ? "not accessible"
                                                              : "a device";
  return Status::error(StatusCode::kIo, path, ": is ", what,
                       ", not a file that can be replaced; choose another with -o");
}

} // namespace

FileSet::~FileSet() {
  remove_temporaries();
  if (made_folder_)
    ::rmdir(folder_.c_str()); // only if it is empty
}

void FileSet::remove_temporaries() {
  for (const File& file : files_)
    ::unlink(file.temporary.c_str()); // an fs::path would take memory, which may have run out
  files_.clear();
}

Status FileSet::begin(const std::string& folder) {
  folder_ = folder.empty() ? "." : folder;
  std::error_code created, error;
  made_folder_ = fs::create_directories(folder_, created);
  if (!fs::is_directory(folder_, error))
    return Status::error(StatusCode::kIo, folder_, ": cannot be created: ",
                         created ? created.message() : "a file of that name exists",
                         "; choose another with -o");
  FileWriter writer;
  if (!writer.open(path_for("probe"), folder_).ok())
    return Status::error(StatusCode::kIo, folder_,
                         ": no file can be written there; choose another with -o");
  writer.write("probe");
  const Status written = writer.close();
  remove_temporaries();
  return written;
}

Status FileSet::begin_file(const std::string& path, std::string* name) {
  const fs::path whole(path);
  *name = whole.filename().string();
  if (name->empty() || *name == "." || *name == "..")
    return Status::error(StatusCode::kIo, path,
                         ": names a folder, not a file; choose another with -o");
  HC_TRY(check_replaceable(path));
  return begin(whole.parent_path().string());
}

std::string FileSet::path_for(std::string_view name) {
  const std::string temporary = temporary_prefix() + std::string(name);
  files_.push_back({(fs::path(folder_) / temporary).string(), shown_path(name)});
  return files_.back().temporary;
}

std::string FileSet::shown_path(std::string_view name) const {
  return (fs::path(folder_) / name).string();
}

Status FileSet::check_name(std::string_view name) const {
  return check_replaceable(shown_path(name));
}

Status FileSet::add(std::string_view name, std::string_view bytes) {
  FileWriter writer;
  HC_TRY(writer.open(path_for(name), shown_path(name)));
  writer.write(bytes);
  return writer.close();
}

Status FileSet::commit() {
  for (const File& file : files_)
    HC_TRY(check_replaceable(file.final));
  std::size_t renamed = 0;
  for (const File& file : files_) {
    std::error_code error;
    fs::rename(file.temporary, file.final, error);
    if (error) {
      const std::string reason = error.message();
      const std::string path = file.final;
      const std::size_t count = files_.size();
      remove_temporaries();
      return Status::error(StatusCode::kIo, path, ": cannot be put in place: ", reason, "; ",
                           renamed, " of ", count, " files are new");
    }
    ++renamed;
    made_folder_ = false;
  }
  files_.clear();
  return {};
}

} // namespace hemicube::radiosity
