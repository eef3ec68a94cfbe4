#pragma once

#include "radiosity/form_factor/byte_file.h"
#include "radiosity/parallel/mutex.h"
#include "raster/memory.h"

#include <atomic>
#include <initializer_list>

namespace hemicube::radiosity {

/// Where rows are kept.
struct RowStorage {
  static constexpr std::uint64_t kUnlimited = ~std::uint64_t{0};
  static constexpr std::uint64_t kRangeBytes = std::uint64_t{64} << 20;

  ByteFile* file = nullptr;                ///< null: memory alone
  std::uint64_t begin = 0;                 ///< of the rows in the file; what is before is not ours
  std::uint64_t most_bytes = kUnlimited;   ///< of rows in memory; beyond it they stay in the file
  std::uint64_t range_bytes = kRangeBytes; ///< of rows read at once
};

/// Rows of bytes, in blocks of consecutive rows: one block, one writer. They stay in memory while
/// they may. With a file, finished blocks are also appended to it, in ascending order, from time to
/// time, so that a run that was killed finds them there; and where memory ends they stay only
/// there.
///
/// A block is the same bytes in memory and in a file, numbers little-endian: a checksum of all that
/// follows, the size of the block, the end of each of its 8 rows (bytes from the block's begin; 0
/// where there is no row), the rows. All sizes are multiples of 8.
class RowStore {
public:
  static constexpr std::uint32_t kBlockRows = 8;
  static constexpr std::size_t kRangeBlocks = 32;

  /// Forgets everything and makes room for row_count rows.
  Status init(std::uint64_t row_count, const RowStorage& storage = {}) noexcept;

  /// Takes the blocks that are in the file: as many as are whole and sound. What follows them is
  /// not touched. Call it once, after init.
  /// @param end      of the file's blocks, in bytes
  /// @param is_sound bool(bytes), whether bytes can be a row
  /// @param rest     receives the offset of what follows the last sound block
  template <typename IsRow>
  Status adopt(std::uint64_t end, IsRow is_row, std::uint64_t* rest) noexcept {
    *rest = storage_.begin;
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      Buffer<std::byte> bytes;
      HC_TRY(read_block(block, *rest, end, &bytes));
      if (bytes.empty())
        return {};
      for (std::uint64_t i = 0; i < rows_in(block); ++i)
        if (!is_row(row_of(bytes.data(), i)))
          return {};
      *rest += bytes.size();
      HC_TRY(take_block(block, *rest, &bytes));
    }
    return {};
  }

  std::uint64_t row_count() const noexcept { return row_count_; }
  std::size_t block_count() const noexcept { return blocks_.size(); }
  /// Bytes of all blocks that are finished.
  std::uint64_t byte_count() const noexcept { return byte_count_; }
  bool is_finished(std::size_t block) const noexcept { return is_finished_[block] != 0; }
  bool is_in_memory() const noexcept { return is_in_memory_; }
  const RowStorage& storage() const noexcept { return storage_; }

  /// Appends the next row of a block, its parts one after the other: rows come in ascending order,
  /// from one writer at a time. Sizes of all parts together: a multiple of 8.
  /// @return kOutOfMemory (also where rows are beyond most_bytes and there is no file), kIo
  Status append(std::size_t block,
                std::initializer_list<std::span<const std::byte>> parts) noexcept;

  /// Makes room for all rows of a block in one go.
  Status reserve(std::size_t block, std::size_t bytes) noexcept;

  /// Brings all finished blocks that follow each other from the first on to the file.
  Status flush() noexcept;
  /// The same if the file says that it is time: what a run that ends early leaves. What it cannot
  /// leave is lost, and nothing else.
  void flush_if_due() noexcept;

  /// Calls Status visit(first, last) for ranges of blocks that follow each other and make up
  /// first_block .. last_block - 1; all ranges but the last end at multiples of kRangeBlocks. While
  /// it runs, and only then, the rows of the range can be read. One walk at a time.
  template <typename Visit>
  Status for_each_range(std::size_t first_block, std::size_t last_block, Visit visit) const {
    for (std::size_t begin = first_block; begin < last_block;) {
      std::size_t end = last_block;
      HC_TRY(load(begin, &end));
      HC_TRY(visit(begin, end));
      begin = end;
    }
    return {};
  }

  /// A row that is in memory or in the range that is being walked; empty if it was not appended.
  std::span<const std::byte> row(std::uint64_t index) const noexcept {
    const std::byte* block = block_bytes(static_cast<std::size_t>(index / kBlockRows));
    if (block == nullptr)
      return {};
    return row_of(block, index % kBlockRows);
  }
  /// The same, to be changed in place. Rows must be in memory.
  std::span<std::byte> row(std::uint64_t index) noexcept;

  /// Any row, whether it is in memory or not.
  /// @param scratch  receives its block if it is not
  Status read_row(std::uint64_t index, Buffer<std::byte>* scratch,
                  std::span<const std::byte>* row) const noexcept;

  void swap(RowStore& other) noexcept;

private:
  static constexpr std::size_t kChecksum = 0, kSize = 1, kEnds = 2; ///< words of a block
  static constexpr std::size_t kHeadBytes = 8 * (kEnds + kBlockRows);

  const std::byte* block_bytes(std::size_t block) const noexcept {
    if (!blocks_[block].empty())
      return blocks_[block].data();
    if (block >= loaded_first_ && block < loaded_last_)
      return loaded_.data() + (offsets_[block] - offsets_[loaded_first_]);
    HC_ASSERT(!is_finished(block));
    return nullptr;
  }
  static std::span<const std::byte> row_of(const std::byte* block, std::size_t k) noexcept {
    const std::uint64_t* words = reinterpret_cast<const std::uint64_t*>(block);
    const std::uint64_t begin = k == 0 ? kHeadBytes : words[kEnds + k - 1];
    const std::uint64_t end = words[kEnds + k];
    return end == 0 ? std::span<const std::byte>() : std::span(block + begin, block + end);
  }
  bool is_sound(std::size_t block, std::span<const std::byte> bytes) const noexcept;
  Status read_block(std::size_t block, std::uint64_t begin, std::uint64_t end,
                    Buffer<std::byte>* bytes) noexcept;
  Status take_block(std::size_t block, std::uint64_t end, Buffer<std::byte>* bytes) noexcept;
  std::size_t size_of(std::size_t block) const noexcept;
  std::size_t rows_in(std::size_t block) const noexcept;
  Status load(std::size_t first, std::size_t* last) const noexcept;
  Status finish(std::size_t block) noexcept;
  Status write_finished() noexcept;
  void leave_memory() noexcept;

  RowStorage storage_;
  std::uint64_t row_count_ = 0;
  FixedArray<Buffer<std::byte>> blocks_; ///< empty: not begun, or in the file alone
  Buffer<std::uint8_t> is_finished_;     ///< [block]
  Buffer<std::uint64_t> offsets_;        ///< [block in the file, and one beyond] where it begins
  std::atomic<std::uint64_t> byte_count_{0};
  bool is_in_memory_ = true;
  Mutex mutex_; ///< of all above but the bytes of unfinished blocks

  mutable Buffer<std::byte> loaded_; ///< blocks loaded_first_ .. loaded_last_ - 1
  mutable std::size_t loaded_first_ = 0, loaded_last_ = 0;
};

} // namespace hemicube::radiosity
