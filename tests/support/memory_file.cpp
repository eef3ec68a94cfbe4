#include "tests/support/memory_file.h"

#include <algorithm>
#include <thread>

namespace hemicube::test {

Status MemoryFile::append(std::span<const std::byte> added) noexcept {
  const Call call(this);
  std::this_thread::yield(); // who has no business here had better come now
  if (appends++ == failing_append)
    return Status::error(StatusCode::kIo, std::string_view(name_), ": is full");
  bytes.insert(bytes.end(), added.begin(), added.end());
  return {};
}

Status MemoryFile::read(std::uint64_t offset, std::span<std::byte> into) noexcept {
  const Call call(this);
  ++reads;
  if (offset > bytes.size() || into.size() > bytes.size() - offset)
    return Status::error(StatusCode::kIo, std::string_view(name_), ": ends too early");
  std::copy_n(bytes.data() + offset, into.size(), into.data());
  return {};
}

Status MemoryFile::truncate(std::uint64_t size) noexcept {
  const Call call(this);
  if (size < bytes.size())
    bytes.resize(static_cast<std::size_t>(size));
  return {};
}

bool MemoryFile::is_due() noexcept {
  const Call call(this);
  return ++due_calls_ % due_every == 0;
}

} // namespace hemicube::test
