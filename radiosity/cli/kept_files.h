#pragma once

#include "radiosity/output/row_file.h"
#include "radiosity/radiosity.h"

#include <string>

namespace hemicube::radiosity::cli {

/// The files a run keeps its rows in (RunFiles): found or planned before the run, put in place or
/// deleted after it. A run that was interrupted or killed leaves them, and the next one finds them.
class KeptFiles {
public:
  /// For a run that leaves no form factors.
  /// @param path  what is made: names of files that only an unfinished run leaves begin with it;
  ///              empty: none are left
  Status begin(const std::string& path);

  /// For a run that makes the .hcf at `path`.
  Status begin_hcf(const std::string& path);

  /// For a run that reads the .hcf at `path` if it exists, and makes it if not.
  Status begin_or_read_hcf(const std::string& path);

  /// Puts the .hcf in its place, or says what is kept of it; deletes what is of no more use.
  /// @param run  how the run ended
  /// @return that, or what went wrong here
  Status finish(const Status& run);

  RunFiles files;

private:
  std::string hcf_;
  RowFile rows_, pairs_, black_rows_;
};

} // namespace hemicube::radiosity::cli
