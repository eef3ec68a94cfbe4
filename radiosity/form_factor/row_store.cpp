#include "radiosity/form_factor/row_store.h"

#include "raster/hash.h"

#include <cstring>

namespace hemicube::radiosity {
namespace {

std::uint64_t word(const std::byte* bytes, std::size_t index) {
  std::uint64_t value;
  std::memcpy(&value, bytes + 8 * index, 8);
  return value;
}

void set_word(std::byte* bytes, std::size_t index, std::uint64_t value) {
  std::memcpy(bytes + 8 * index, &value, 8);
}

/// Of all words of a block but the first, in four chains side by side: one alone would be waited
/// for.
std::uint64_t checksum(std::span<const std::byte> block) {
  Hash chains[4] = {Hash(0), Hash(1), Hash(2), Hash(3)};
  const std::size_t words = block.size() / 8;
  for (std::size_t k = 1; k < words; ++k)
    chains[k % 4].add(word(block.data(), k));
  Hash hash(words);
  for (const Hash& chain : chains)
    hash.add(chain.value());
  return hash.value();
}

} // namespace

Status RowStore::init(std::uint64_t row_count, const RowStorage& storage) noexcept {
  storage_ = storage;
  row_count_ = row_count;
  byte_count_ = 0;
  is_in_memory_ = true;
  loaded_first_ = loaded_last_ = 0;
  const std::size_t blocks = static_cast<std::size_t>((row_count + kBlockRows - 1) / kBlockRows);
  offsets_.clear();
  HC_TRY(offsets_.push_back(storage.begin));
  is_finished_.clear();
  HC_TRY(is_finished_.resize(blocks));
  return blocks_.init(blocks);
}

std::size_t RowStore::rows_in(std::size_t block) const noexcept {
  const std::uint64_t begin = std::uint64_t{block} * kBlockRows;
  return static_cast<std::size_t>(row_count_ - begin < kBlockRows ? row_count_ - begin
                                                                  : kBlockRows);
}

std::size_t RowStore::size_of(std::size_t block) const noexcept {
  return blocks_[block].empty() && block + 1 < offsets_.size()
             ? static_cast<std::size_t>(offsets_[block + 1] - offsets_[block])
             : blocks_[block].size();
}

Status RowStore::append(std::size_t index,
                        std::initializer_list<std::span<const std::byte>> parts) noexcept {
  HC_ASSERT(!is_finished(index));
  Buffer<std::byte>& block = blocks_[index];
  if (block.empty())
    HC_TRY(block.resize(kHeadBytes));
  std::size_t k = 0;
  while (word(block.data(), kEnds + k) != 0)
    ++k;
  for (const std::span<const std::byte> part : parts)
    HC_TRY(block.append(part));
  HC_ASSERT(block.size() % 8 == 0);
  set_word(block.data(), kEnds + k, block.size());
  if (k + 1 < rows_in(index))
    return {};
  HC_TRY(block.shrink_to_fit());
  set_word(block.data(), kSize, block.size());
  return finish(index);
}

Status RowStore::reserve(std::size_t index, std::size_t bytes) noexcept {
  return blocks_[index].reserve(kHeadBytes + bytes);
}

Status RowStore::finish(std::size_t block) noexcept {
  const MutexLock lock(mutex_);
  is_finished_[block] = 1;
  byte_count_ += blocks_[block].size();
  if (storage_.file == nullptr)
    return byte_count_ <= storage_.most_bytes
               ? Status()
               : Status::error(StatusCode::kOutOfMemory, "rows take more than the ",
                               storage_.most_bytes, " bytes they may, and have no file");
  if (byte_count_ > storage_.most_bytes)
    is_in_memory_ = false;
  return !is_in_memory_ || storage_.file->is_due() ? write_finished() : Status();
}

Status RowStore::flush() noexcept {
  const MutexLock lock(mutex_);
  return storage_.file == nullptr ? Status() : write_finished();
}

void RowStore::flush_if_due() noexcept {
  const MutexLock lock(mutex_);
  if (storage_.file != nullptr && storage_.file->is_due())
    static_cast<void>(write_finished());
}

Status RowStore::write_finished() noexcept {
  for (std::size_t block = offsets_.size() - 1; block < blocks_.size() && is_finished(block);
       ++block) {
    const std::span<std::byte> bytes = blocks_[block].span();
    set_word(bytes.data(), kChecksum, checksum(bytes));
    HC_TRY(offsets_.push_back(offsets_.back() + bytes.size()));
    const Status appended = storage_.file->append(bytes);
    if (!appended.ok()) {
      offsets_.pop_back();
      return appended;
    }
  }
  if (!is_in_memory_)
    leave_memory();
  return {};
}

void RowStore::leave_memory() noexcept {
  for (std::size_t block = offsets_.size() - 1; block-- > 0 && !blocks_[block].empty();) {
    Buffer<std::byte> freed;
    blocks_[block].swap(freed);
  }
}

bool RowStore::is_sound(std::size_t block, std::span<const std::byte> bytes) const noexcept {
  if (bytes.size() < kHeadBytes || bytes.size() % 8 != 0 ||
      word(bytes.data(), kSize) != bytes.size() || word(bytes.data(), kChecksum) != checksum(bytes))
    return false;
  std::uint64_t begin = kHeadBytes;
  for (std::size_t k = 0; k < rows_in(block); ++k) {
    const std::uint64_t end = word(bytes.data(), kEnds + k);
    if (end < begin || end % 8 != 0)
      return false;
    begin = end;
  }
  return begin == bytes.size();
}

/// @param bytes  receives the block, or nothing if what is there is not one
Status RowStore::read_block(std::size_t block, std::uint64_t begin, std::uint64_t end,
                            Buffer<std::byte>* bytes) noexcept {
  if (end < begin || end - begin < kHeadBytes)
    return {};
  std::byte head[kHeadBytes];
  HC_TRY(storage_.file->read(begin, head));
  const std::uint64_t size = word(head, kSize);
  if (size < kHeadBytes || size > end - begin)
    return {};
  HC_TRY(bytes->resize(static_cast<std::size_t>(size)));
  HC_TRY(storage_.file->read(begin, bytes->span()));
  if (!is_sound(block, bytes->span()))
    bytes->clear();
  return {};
}

Status RowStore::take_block(std::size_t block, std::uint64_t end,
                            Buffer<std::byte>* bytes) noexcept {
  HC_TRY(offsets_.push_back(end));
  byte_count_ += bytes->size();
  blocks_[block].swap(*bytes);
  is_finished_[block] = 1;
  is_in_memory_ = is_in_memory_ && byte_count_ <= storage_.most_bytes;
  if (!is_in_memory_)
    leave_memory();
  return {};
}

std::span<std::byte> RowStore::row(std::uint64_t index) noexcept {
  HC_ASSERT(is_in_memory_);
  const std::span<const std::byte> found = static_cast<const RowStore*>(this)->row(index);
  return {const_cast<std::byte*>(found.data()), found.size()};
}

/// Finds the end of the range that begins at a block, and reads it unless it is in memory.
Status RowStore::load(std::size_t first, std::size_t* last) const noexcept {
  std::size_t end = first;
  std::uint64_t bytes = 0;
  while (end < *last) {
    std::size_t next = (end / kRangeBlocks + 1) * kRangeBlocks;
    next = next < *last ? next : *last;
    for (std::size_t block = end; block < next; ++block)
      bytes += size_of(block);
    if (end != first && bytes > storage_.range_bytes)
      break;
    end = next;
  }
  *last = end;
  if (is_in_memory_ || (first >= loaded_first_ && end <= loaded_last_))
    return {};
  loaded_first_ = loaded_last_ = 0;
  const std::uint64_t size = offsets_[end] - offsets_[first];
  if (loaded_.size() < size)
    HC_TRY(loaded_.resize(static_cast<std::size_t>(size)));
  HC_TRY(storage_.file->read(offsets_[first], loaded_.span().first(size)));
  storage_.file->expect(offsets_[end], size);
  for (std::size_t block = first; block < end; ++block)
    if (!is_sound(block, loaded_.span().subspan(offsets_[block] - offsets_[first], size_of(block))))
      return Status::error(StatusCode::kIo, "rows from ", block * kBlockRows,
                           " on were changed in the file they are kept in while they were in use: "
                           "run again");
  loaded_first_ = first;
  loaded_last_ = end;
  return {};
}

Status RowStore::read_row(std::uint64_t index, Buffer<std::byte>* scratch,
                          std::span<const std::byte>* found) const noexcept {
  const std::size_t block = static_cast<std::size_t>(index / kBlockRows);
  if (is_in_memory_ || (block >= loaded_first_ && block < loaded_last_)) {
    *found = row(index);
    return {};
  }
  const std::size_t size = size_of(block);
  if (scratch->size() < size)
    HC_TRY(scratch->resize(size));
  const std::span<std::byte> bytes = scratch->span().first(size);
  HC_TRY(storage_.file->read(offsets_[block], bytes));
  if (!is_sound(block, bytes))
    return Status::error(StatusCode::kIo, "row ", index, " was changed in the file it is kept in ",
                         "while it was in use: run again");
  *found = row_of(bytes.data(), index % kBlockRows);
  return {};
}

void RowStore::swap(RowStore& other) noexcept {
  std::swap(storage_, other.storage_);
  std::swap(row_count_, other.row_count_);
  blocks_.swap(other.blocks_);
  is_finished_.swap(other.is_finished_);
  offsets_.swap(other.offsets_);
  byte_count_ = other.byte_count_.exchange(byte_count_);
  std::swap(is_in_memory_, other.is_in_memory_);
  loaded_.swap(other.loaded_);
  std::swap(loaded_first_, other.loaded_first_);
  std::swap(loaded_last_, other.loaded_last_);
}

} // namespace hemicube::radiosity
