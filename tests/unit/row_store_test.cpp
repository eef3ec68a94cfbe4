// Rows of bytes in memory, in a file and beyond memory: always the same ones, whoever fills them in
// and however they are walked.

#include "radiosity/parallel/thread_pool.h"
#include "tests/unit/row_store_support.h"

#include <utility>

namespace hemicube::test {
namespace {

constexpr std::uint64_t kCounts[] = {0, 1, 7, 8, 9, 64, 257, 1001};

// Catches: a file that holds other bytes than memory, rows that are lost on the way there.
TEST(RowStore, RowsAreTheSameWhereverTheyAreKept) {
  for (const std::uint64_t rows : kCounts) {
    SCOPED_TRACE(rows);
    const Reference reference(rows);
    RowStore memory;
    require(memory.init(rows));
    append_all(&memory);
    EXPECT_TRUE(memory.is_in_memory());
    expect_rows(memory, memory.block_count());
    EXPECT_EQ(memory.byte_count(), reference.file.size() - kHead);
    for (const std::uint64_t due_every : {std::uint64_t{1}, std::uint64_t{5}, MemoryFile::kNever})
      for (const std::uint64_t most :
           {RowStorage::kUnlimited, std::uint64_t{3000}, std::uint64_t{1}, std::uint64_t{0}}) {
        MemoryFile file;
        begin_file(&file);
        file.due_every = due_every;
        RowStore store;
        require(store.init(rows, {&file, kHead, most, 1000}));
        append_all(&store);
        EXPECT_EQ(store.is_in_memory(), store.byte_count() <= most);
        EXPECT_EQ(store.byte_count(), memory.byte_count());
        expect_rows(store, store.block_count());
        EXPECT_TRUE(store.is_in_memory() || file.bytes == reference.file.bytes);
        require(store.flush());
        EXPECT_EQ(file.bytes, reference.file.bytes);
        expect_rows(store, store.block_count());
      }
  }
}

TEST(RowStore, BeyondMemoryWithoutAFileIsOutOfMemory) {
  const Reference reference(61);
  for (std::size_t fitting = 0; fitting < reference.ends.size() - 1; ++fitting) {
    RowStore store;
    require(store.init(61, {nullptr, 0, reference.ends[fitting + 1] - kHead - 1}));
    for (std::size_t block = 0; block < fitting; ++block)
      require(append_block(&store, block));
    const Status status = append_block(&store, fitting);
    EXPECT_EQ(status.code(), StatusCode::kOutOfMemory);
    EXPECT_NE(status.message().find(std::to_string(reference.ends[fitting + 1] - kHead - 1)),
              std::string_view::npos)
        << status.message();
    require(store.flush());
  }
}

// Catches: ranges that overlap, leave something out, or hold more than may be read at once.
TEST(RowStore, RangesBeginAtMultiplesAndCoverEverythingOnce) {
  constexpr std::uint64_t kRows = 3001;
  constexpr std::size_t kStep = RowStore::kRangeBlocks;
  const Reference reference(kRows);
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{1}})
    for (const std::uint64_t range_bytes : {0, 1, 6000, 12000, 20000, 50000, 100000000}) {
      MemoryFile file;
      begin_file(&file);
      RowStore store;
      require(store.init(kRows, {&file, kHead, most, range_bytes}));
      append_all(&store);
      const std::size_t blocks = store.block_count();
      for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, blocks},
                                     {0, 33},
                                     {64, 65},
                                     {3 * kStep, blocks - 1},
                                     {5, 5},
                                     {5, 40}}) {
        std::size_t next = from, ranges = 0;
        require(store.for_each_range(from, to, [&](std::size_t first, std::size_t last) {
          EXPECT_EQ(first, next);
          EXPECT_TRUE(first == from || first % kStep == 0) << first;
          EXPECT_TRUE(last == to || last % kStep == 0) << last;
          EXPECT_GT(last, first);
          const std::size_t bytes = reference.ends[last] - reference.ends[first];
          EXPECT_TRUE(bytes <= range_bytes || last <= (first / kStep + 1) * kStep) << bytes;
          for (std::uint64_t row = first * RowStore::kBlockRows;
               row < std::min(last * RowStore::kBlockRows, kRows); ++row)
            EXPECT_TRUE(is_row(std::as_const(store).row(row), row)) << row;
          next = last;
          ++ranges;
          return Status();
        }));
        EXPECT_EQ(next, to);
        if (range_bytes == 0) {
          EXPECT_EQ(ranges, (to + kStep - 1) / kStep - from / kStep - (from == to ? 1 : 0));
        }
        if (range_bytes == 100000000) {
          EXPECT_EQ(ranges, from == to ? 0u : 1u);
        }
      }
    }
}

// Catches: a walk that goes on after its visitor failed.
TEST(RowStore, AWalkEndsWhereItsVisitorFails) {
  MemoryFile file;
  RowStore store;
  require(store.init(1000, {&file, 0, 1, 1}));
  append_all(&store);
  int visits = 0;
  const Status status = store.for_each_range(0, store.block_count(), [&](std::size_t, std::size_t) {
    return ++visits == 2 ? Status::error(StatusCode::kCancelled, "enough") : Status();
  });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_EQ(visits, 2);
}

TEST(RowStore, WhatWasReadLastIsNotReadAgain) {
  MemoryFile file;
  RowStore store;
  require(store.init(1000, {&file, 0, 1, 1 << 20}));
  append_all(&store);
  expect_rows(store, store.block_count());
  const std::uint64_t reads = file.reads;
  EXPECT_GT(reads, 0u);
  expect_rows(store, store.block_count());
  EXPECT_EQ(file.reads, reads);
}

// Catches: rows of the walked range that a look at another one moves away.
TEST(RowStore, AnyRowCanBeReadAlsoDuringAWalk) {
  constexpr std::uint64_t kRows = 1001;
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{1}}) {
    MemoryFile file;
    begin_file(&file);
    RowStore store;
    require(store.init(kRows, {&file, kHead, most, 1}));
    append_all(&store);
    Random random(5);
    Buffer<std::byte> scratch;
    const auto expect_any = [&] {
      const std::uint64_t row = random.index(kRows);
      std::span<const std::byte> bytes;
      require(store.read_row(row, &scratch, &bytes));
      EXPECT_TRUE(is_row(bytes, row)) << row;
    };
    for (int k = 0; k < 300; ++k)
      expect_any();
    require(store.for_each_range(0, store.block_count(), [&](std::size_t first, std::size_t last) {
      for (std::uint64_t row = first * 8; row < std::min<std::uint64_t>(last * 8, kRows); ++row) {
        expect_any();
        EXPECT_TRUE(is_row(std::as_const(store).row(row), row)) << row;
      }
      return Status();
    }));
  }
}

// Catches: two workers in the file at once, rows that get lost between them.
TEST(RowStore, ManyWorkersFillTheSameFile) {
  constexpr std::uint64_t kRows = 4003;
  const Reference reference(kRows);
  radiosity::ThreadPool pool;
  require(pool.init(4));
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{20000}, std::uint64_t{0}})
    for (const std::uint64_t due_every : {1, 7, 1000000}) {
      MemoryFile file;
      begin_file(&file);
      file.due_every = due_every;
      RowStore store;
      require(store.init(kRows, {&file, kHead, most, 10000}));
      require(pool.for_each(store.block_count(), [&](std::size_t block, std::size_t) {
        return append_block(&store, block);
      }));
      require(store.flush());
      EXPECT_FALSE(file.has_overlapped);
      EXPECT_EQ(file.bytes, reference.file.bytes);
      EXPECT_EQ(store.is_in_memory(), store.byte_count() <= most);
      expect_rows(store, store.block_count());
    }
}

TEST(RowStore, SwapTakesTheRowsWithTheirFile) {
  MemoryFile file;
  RowStore filled, other;
  require(filled.init(300, {&file, 0, 1, 1}));
  append_all(&filled);
  require(other.init(5));
  filled.swap(other);
  EXPECT_EQ(filled.row_count(), 5u);
  EXPECT_TRUE(filled.is_in_memory());
  EXPECT_FALSE(other.is_in_memory());
  expect_rows(other, other.block_count());
  append_all(&filled);
  expect_rows(filled, 1);
}

} // namespace
} // namespace hemicube::test
