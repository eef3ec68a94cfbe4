#pragma once

#include "raster/status.h"

#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

/// The files of one run: they appear whole or not at all. Each is written aside, under a temporary
/// name in its own folder, and takes its name in commit(); until then files of those names stay as
/// they were. Without a commit the destructor removes everything written, and the folder if it was
/// made for it.
class FileSet {
public:
  FileSet() = default;
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;
  ~FileSet();

  /// Chooses the folder of all files, creates it and its parents, and proves that it can be
  /// written. Call it before the work: nobody wants to hear of a full disk after an hour.
  /// @return kIo
  Status begin(const std::string& folder);

  /// The same for the folder of one file, `PATH` of `-o PATH`, which must not be a folder or a
  /// device.
  /// @param name  receives the file's name within that folder
  Status begin_file(const std::string& path, std::string* name);

  /// Refuses a name that commit() could not give a file: it is a folder, a device or a link there.
  Status check_name(std::string_view name) const;

  /// Writes a whole file aside.
  Status add(std::string_view name, std::string_view bytes);

  /// The temporary path of a file, for a writer that wants a path: same extension, same folder. The
  /// file belongs to the set from now on.
  std::string path_for(std::string_view name);

  /// The path a file will have, for messages.
  std::string shown_path(std::string_view name) const;

  /// Gives all files their names.
  /// @return kIo, naming the file; files renamed before it keep their new content
  Status commit();

private:
  struct File {
    std::string temporary, final;
  };

  void remove_temporaries();

  std::string folder_;
  bool made_folder_ = false; ///< and nothing was committed into it yet
  std::vector<File> files_;
};

} // namespace hemicube::radiosity
