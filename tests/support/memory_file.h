#pragma once

#include "radiosity/form_factor/byte_file.h"

#include <atomic>
#include <string>
#include <vector>

namespace hemicube::test {

/// A file of bytes in memory that tests can look into, change, and let fail.
class MemoryFile final : public radiosity::ByteFile {
public:
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  explicit MemoryFile(std::string name = "memory.hcf") : name_(std::move(name)) {}

  std::string_view name() const noexcept override { return name_; }
  std::uint64_t size() const noexcept override { return bytes.size(); }
  Status append(std::span<const std::byte> added) noexcept override;
  Status read(std::uint64_t offset, std::span<std::byte> into) noexcept override;
  Status truncate(std::uint64_t size) noexcept override;
  bool is_due() noexcept override;

  std::vector<std::byte> bytes;
  std::uint64_t due_every = 1;           ///< every how many calls is_due() says yes; kNever
  std::uint64_t failing_append = kNever; ///< which append fails, from 0

  std::uint64_t appends = 0, reads = 0; ///< calls
  bool has_overlapped = false;          ///< two callers at a time

private:
  /// Notes that a call begins; the file is free again when it goes.
  class Call {
  public:
    explicit Call(MemoryFile* file) : file_(*file) {
      if (file_.callers_.fetch_add(1) != 0)
        file_.has_overlapped = true;
    }
    ~Call() { file_.callers_.fetch_sub(1); }

  private:
    MemoryFile& file_;
  };

  std::string name_;
  std::uint64_t due_calls_ = 0;
  std::atomic<int> callers_{0};
};

} // namespace hemicube::test
