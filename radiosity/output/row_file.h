#pragma once

#include "radiosity/form_factor/byte_file.h"
#include "raster/memory.h"

#include <chrono>
#include <string>

namespace hemicube::radiosity {

/// A file that a run keeps rows in. The first bytes wait in memory, so that a run that appends no
/// more than a head leaves no trace; the file belongs to one process at a time. Unless it is
/// renamed or removed it stays, also after a kill, and the next run finds it.
class RowFile final : public ByteFile {
public:
  RowFile() = default;
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;
  ~RowFile() { close(); }

  /// Opens a file to read and append, if it exists; else remembers the path.
  /// @return kIo (not a regular file, in use by another run, not accessible)
  Status open(const std::string& path);
  /// Opens an existing file to read alone. @return kIo
  Status open_to_read(const std::string& path);
  /// A file in the folder for temporary files, which vanishes with the process and is made only
  /// where memory ends.
  void use_temporary();

  /// Puts the file in its final place, with all bytes on the disk. @return kIo
  Status rename(const std::string& path);
  /// Deletes the file, if it was made. It can be used until it is destroyed.
  void remove() noexcept;

  /// Whether there is something that outlives the process.
  bool is_on_disk() const noexcept { return descriptor_ >= 0 && !is_temporary_; }

  std::string_view name() const noexcept override { return path_; }
  std::uint64_t size() const noexcept override { return size_; }
  Status append(std::span<const std::byte> bytes) noexcept override;
  Status read(std::uint64_t offset, std::span<std::byte> into) noexcept override;
  Status truncate(std::uint64_t size) noexcept override;
  void expect(std::uint64_t offset, std::uint64_t size) noexcept override;
  bool is_due() noexcept override;

private:
  using Clock = std::chrono::steady_clock;

  Status make() noexcept;
  Status write(std::uint64_t offset, std::span<const std::byte> bytes) noexcept;
  void close() noexcept;
  Status in_use() const noexcept;
  Status failed(const char* what, int error) const noexcept;

  std::string path_;
  int descriptor_ = -1;       ///< -1: not made yet
  Buffer<std::byte> waiting_; ///< all bytes, until the file is made
  std::uint64_t size_ = 0;
  bool is_temporary_ = false;
  Clock::time_point opened_ = Clock::now(), last_due_ = opened_;
};

} // namespace hemicube::radiosity
