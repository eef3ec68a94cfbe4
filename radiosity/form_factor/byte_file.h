#pragma once

#include "raster/status.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace hemicube::radiosity {

/// A file as the core sees it: bytes that are appended and read back. Implemented by whoever has
/// files (output/row_file.h), so that the core need not. One caller at a time.
class ByteFile {
public:
  /// What messages call it.
  virtual std::string_view name() const noexcept = 0;
  virtual std::uint64_t size() const noexcept = 0;
  /// Errors: kIo, and the file is then as if nothing was appended.
  virtual Status append(std::span<const std::byte> bytes) noexcept = 0;
  /// Fills all of `into`. Errors: kIo, also where the file ends too early.
  virtual Status read(std::uint64_t offset, std::span<std::byte> into) noexcept = 0;
  /// Forgets all bytes from `size` on.
  virtual Status truncate(std::uint64_t size) noexcept = 0;
  /// A hint that these bytes are read next.
  virtual void expect(std::uint64_t offset, std::uint64_t size) noexcept {
    static_cast<void>(offset);
    static_cast<void>(size);
  }
  /// True from time to time: what is finished had better be appended now, lest a kill loses it.
  virtual bool is_due() noexcept { return true; }

protected:
  ~ByteFile() = default;
};

} // namespace hemicube::radiosity
