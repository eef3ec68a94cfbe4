#pragma once

#include "radiosity/form_factor/row_store.h"
#include "tests/support/memory_file.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <algorithm>

/// Rows of bytes that tests of the store recognise.
namespace hemicube::test {

using radiosity::RowStorage;
using radiosity::RowStore;

constexpr std::size_t kHead = 24; ///< bytes of the file that are not the store's

inline std::vector<std::byte> row_bytes(std::uint64_t row) {
  std::vector<std::uint64_t> words((row * 7 + 3) % 13); // some are empty
  for (std::size_t k = 0; k < words.size(); ++k)
    words[k] = (row + 1) * 0x9e3779b97f4a7c15u + k;
  const std::span<const std::byte> bytes = std::as_bytes(std::span(words));
  return {bytes.begin(), bytes.end()};
}

inline bool is_row(std::span<const std::byte> bytes, std::uint64_t row) {
  const std::vector<std::byte> expected = row_bytes(row);
  return std::equal(bytes.begin(), bytes.end(), expected.begin(), expected.end());
}

/// Appends all rows of a block, each in two parts; the outcome of the last one.
inline Status append_block(RowStore* store, std::size_t block) {
  const std::uint64_t begin = block * RowStore::kBlockRows;
  const std::uint64_t end = std::min(begin + RowStore::kBlockRows, store->row_count());
  for (std::uint64_t row = begin; row < end; ++row) {
    const std::vector<std::byte> bytes = row_bytes(row);
    const std::span<const std::byte> all = bytes;
    const std::size_t half = all.size() / 16 * 8;
    HC_TRY(store->append(block, {all.first(half), all.subspan(half)}));
  }
  return {};
}

inline void append_all(RowStore* store) {
  for (std::size_t block = 0; block < store->block_count(); ++block)
    require(append_block(store, block));
}

/// Expects the rows of blocks 0 .. block_count-1 in a walk.
inline void expect_rows(const RowStore& store, std::size_t block_count) {
  std::uint64_t next = 0;
  require(store.for_each_range(0, block_count, [&](std::size_t first, std::size_t last) {
    for (std::uint64_t row = first * RowStore::kBlockRows;
         row < std::min(last * RowStore::kBlockRows, store.row_count()); ++row, ++next)
      EXPECT_TRUE(row == next && is_row(store.row(row), row)) << row;
    return Status();
  }));
  EXPECT_EQ(next, std::min<std::uint64_t>(block_count * RowStore::kBlockRows, store.row_count()));
}

/// A file with a foreign beginning.
inline void begin_file(MemoryFile* file) {
  file->bytes.assign(kHead, std::byte{0x5a});
}

/// All rows in a file, block after block.
struct Reference {
  explicit Reference(std::uint64_t rows) {
    begin_file(&file);
    RowStore store;
    require(store.init(rows, {&file, kHead}));
    ends.push_back(kHead);
    for (std::size_t block = 0; block < store.block_count(); ++block) {
      require(append_block(&store, block));
      ends.push_back(file.bytes.size());
    }
  }
  /// How many blocks end before a byte.
  std::size_t blocks_before(std::size_t byte) const {
    return static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), byte) -
                                    ends.begin()) -
           1;
  }

  MemoryFile file;
  std::vector<std::size_t> ends; ///< [block and one more] of what is before it
};

} // namespace hemicube::test
