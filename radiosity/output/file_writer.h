#pragma once

#include "raster/status.h"

#include <cstdio>
#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// Writes one file front to back through a buffer of its own. Errors, a full disk among them,
/// stick: the first one is what close() returns.
class FileWriter {
public:
  FileWriter() = default;
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;
  ~FileWriter();

  /// Creates the file or empties an existing one.
  /// @param shown_as  the name messages use
  /// @return kIo
  Status open(const std::string& path, const std::string& shown_as);

  void write(std::string_view bytes);

  /// Text to append to; call flush_if_large() now and then, or just write() and close().
  std::string& text() { return buffer_; }
  void flush_if_large() {
    if (buffer_.size() >= kBufferSize)
      flush();
  }

  /// @return kIo if any byte did not reach the file
  Status close();

private:
  static constexpr std::size_t kBufferSize = std::size_t{1} << 20;

  void flush();

  std::FILE* file_ = nullptr;
  std::string shown_as_;
  std::string buffer_;
  int error_ = 0; ///< errno of the first failure
};

/// What an errno means, in words. It takes no memory, since that may be what failed.
const char* errno_text(int error) noexcept;

} // namespace hemicube::radiosity
