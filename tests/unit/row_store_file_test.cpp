// The file of a store: a complete prefix of the rows at any time; of one that is cut or damaged
// exactly what is before the damage is taken; failures can be made up for.

#include "raster/hash.h"
#include "tests/unit/row_store_support.h"

#include <cstring>
#include <numeric>

namespace hemicube::test {
namespace {

bool any_row(std::span<const std::byte>) {
  return true;
}

/// Adopts what is in a file and expects exactly the first blocks.
void expect_adopted(MemoryFile* file, std::uint64_t rows, std::uint64_t most_bytes,
                    const Reference& reference, std::size_t blocks, RowStore* store) {
  require(store->init(rows, {file, kHead, most_bytes, 1}));
  std::uint64_t rest = 0;
  const std::vector<std::byte> before = file->bytes;
  require(store->adopt(file->size(), any_row, &rest));
  ASSERT_EQ(rest, reference.ends[blocks]);
  EXPECT_EQ(file->bytes, before) << "what follows is not to be touched";
  EXPECT_EQ(store->byte_count(), rest - kHead);
  EXPECT_EQ(store->is_in_memory(), store->byte_count() <= most_bytes);
  for (std::size_t block = 0; block < store->block_count(); ++block)
    ASSERT_EQ(store->is_finished(block), block < blocks) << block;
  expect_rows(*store, blocks);
}

// Catches: gaps in the file, blocks in the order they were finished, blocks kept back for ever.
TEST(RowStore, TheFileHoldsACompletePrefixOfTheBlocks) {
  constexpr std::uint64_t kRows = 301;
  const Reference reference(kRows);
  Random random(7);
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{2000}}) {
    MemoryFile file;
    begin_file(&file);
    RowStore store;
    require(store.init(kRows, {&file, kHead, most, 1}));
    std::vector<std::size_t> order(store.block_count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = order.size(); k > 1; --k)
      std::swap(order[k - 1], order[random.index(static_cast<std::uint32_t>(k))]);
    std::size_t prefix = 0;
    for (const std::size_t block : order) {
      require(append_block(&store, block));
      while (prefix < store.block_count() && store.is_finished(prefix))
        ++prefix;
      ASSERT_EQ(file.size(), reference.ends[prefix]);
      ASSERT_TRUE(std::equal(file.bytes.begin(), file.bytes.end(), reference.file.bytes.begin()));
    }
    expect_rows(store, store.block_count());
  }
}

// Catches: blocks read beyond the end, a row of a block that is not whole, a prefix that is too
// short.
TEST(RowStore, OfAFileThatIsCutWhatIsWholeIsTakenAndTheRestAddedAgain) {
  constexpr std::uint64_t kRows = 29;
  const Reference reference(kRows);
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{1}})
    for (std::size_t cut = kHead; cut <= reference.file.bytes.size(); ++cut) {
      MemoryFile file;
      file.bytes.assign(reference.file.bytes.begin(),
                        reference.file.bytes.begin() + static_cast<std::ptrdiff_t>(cut));
      const std::size_t blocks = reference.blocks_before(cut);
      RowStore store;
      expect_adopted(&file, kRows, most, reference, blocks, &store);
      require(file.truncate(reference.ends[blocks]));
      for (std::size_t block = blocks; block < store.block_count(); ++block)
        require(append_block(&store, block));
      expect_rows(store, store.block_count());
      ASSERT_EQ(file.bytes, reference.file.bytes) << cut;
    }
}

// The end that is given is the end, whatever else is in the file.
TEST(RowStore, NothingIsTakenFromBeyondTheEnd) {
  constexpr std::uint64_t kRows = 29;
  Reference reference(kRows);
  for (std::size_t end = 0; end <= reference.file.bytes.size(); ++end) {
    RowStore store;
    require(store.init(kRows, {&reference.file, kHead}));
    std::uint64_t rest = 0;
    require(store.adopt(end, any_row, &rest));
    ASSERT_EQ(rest, end < kHead ? kHead : reference.ends[reference.blocks_before(end)]) << end;
  }
}

// Catches: bytes that no checksum covers, sizes and ends of rows that are believed.
TEST(RowStore, NoByteCanChangeUnnoticed) {
  constexpr std::uint64_t kRows = 29;
  const Reference reference(kRows);
  MemoryFile file;
  for (const std::byte flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}})
    for (std::size_t at = kHead; at < reference.file.bytes.size(); ++at) {
      file.bytes = reference.file.bytes;
      file.bytes[at] ^= flip;
      RowStore store;
      expect_adopted(&file, kRows, RowStorage::kUnlimited, reference, reference.blocks_before(at),
                     &store);
    }
}

TEST(RowStore, WhatIsNoBlockIsNotTaken) {
  const Reference reference(100);
  MemoryFile file;
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    file.bytes.assign(kHead + random.index(2000), std::byte{0});
    if (round > 0)
      for (std::byte& byte : file.bytes)
        byte = static_cast<std::byte>(random.index(round % 2 == 0 ? 256 : 2));
    RowStore store;
    expect_adopted(&file, 100, RowStorage::kUnlimited, reference, 0, &store);
  }
}

/// Changes words of the only block of a file and makes its checksum right again.
template <typename Change> void change_block(MemoryFile* file, Change change) {
  std::vector<std::uint64_t> words((file->bytes.size() - kHead) / 8);
  std::memcpy(words.data(), file->bytes.data() + kHead, 8 * words.size());
  change(words.data());
  Hash chains[4] = {Hash(0), Hash(1), Hash(2), Hash(3)};
  for (std::size_t k = 1; k < words.size(); ++k)
    chains[k % 4].add(words[k]);
  Hash hash(words.size());
  for (const Hash& chain : chains)
    hash.add(chain.value());
  words[0] = hash.value();
  std::memcpy(file->bytes.data() + kHead, words.data(), 8 * words.size());
}

// Somebody meant it: all checksums are right. Catches: sizes and ends that lead out of the block.
TEST(RowStore, RowsMustFillTheirBlock) {
  constexpr std::uint64_t kRows = 6;
  constexpr std::size_t kSize = 1, kEnds = 2;
  const Reference reference(kRows);
  MemoryFile file;
  const auto expect_blocks = [&](std::size_t blocks, auto change) {
    file.bytes = reference.file.bytes;
    change_block(&file, change);
    RowStore store;
    expect_adopted(&file, kRows, RowStorage::kUnlimited, reference, blocks, &store);
  };
  expect_blocks(1, [](std::uint64_t*) {});
  for (std::size_t k = 0; k < kRows; ++k) {
    for (const std::uint64_t end :
         {std::uint64_t{0}, std::uint64_t{8}, std::uint64_t{72}, std::uint64_t{1} << 20,
          std::uint64_t{1} << 63, ~std::uint64_t{7}})
      expect_blocks(0, [&](std::uint64_t* words) { words[kEnds + k] = end; });
    expect_blocks(0, [&](std::uint64_t* words) { words[kEnds + k] += 4; });
  }
  expect_blocks(0, [](std::uint64_t* words) { words[kEnds + kRows - 1] += 8; });
  expect_blocks(0, [](std::uint64_t* words) { words[kEnds + kRows - 1] -= 8; });
  for (const std::uint64_t size :
       {std::uint64_t{0}, std::uint64_t{8}, std::uint64_t{72}, std::uint64_t{80}, std::uint64_t{88},
        std::uint64_t{1} << 20, std::uint64_t{1} << 63, ~std::uint64_t{0}, ~std::uint64_t{7}})
    expect_blocks(0, [&](std::uint64_t* words) { words[kSize] = size; });
}

// Catches: a row that its reader refuses taken all the same, the blocks before it lost.
TEST(RowStore, RowsThatTheReaderRefusesEndTheFile) {
  constexpr std::uint64_t kRows = 29;
  Reference reference(kRows);
  for (std::uint64_t bad = 0; bad < kRows; ++bad) {
    RowStore store;
    require(store.init(kRows, {&reference.file, kHead}));
    std::uint64_t rest = 0, seen = 0;
    const auto is_good = [&](std::span<const std::byte> bytes) {
      EXPECT_TRUE(is_row(bytes, seen));
      return seen++ != bad;
    };
    require(store.adopt(reference.file.size(), is_good, &rest));
    EXPECT_EQ(rest, reference.ends[bad / RowStore::kBlockRows]);
    EXPECT_EQ(seen, bad + 1);
  }
}

// Catches: a file that is said to hold what could not be appended, rows lost with it, rows twice.
TEST(RowStore, AnAppendThatFailsIsMadeUpFor) {
  constexpr std::uint64_t kRows = 61;
  const Reference reference(kRows);
  const std::size_t blocks = reference.ends.size() - 1;
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{1000}})
    for (std::size_t failing = 0; failing < blocks; ++failing) {
      MemoryFile file;
      begin_file(&file);
      file.failing_append = failing;
      RowStore store;
      require(store.init(kRows, {&file, kHead, most, 1}));
      for (std::size_t block = 0; block < blocks; ++block) {
        const Status status = append_block(&store, block);
        EXPECT_EQ(status.code(), block == failing ? StatusCode::kIo : StatusCode::kOk) << block;
        EXPECT_TRUE(store.is_finished(block));
        ASSERT_EQ(file.size(), reference.ends[block == failing ? block : block + 1]);
      }
      require(store.flush());
      EXPECT_EQ(file.bytes, reference.file.bytes);
      expect_rows(store, blocks);
    }
}

TEST(RowStore, AFlushThatFailsCanBeRepeated) {
  const Reference reference(61);
  MemoryFile file;
  begin_file(&file);
  file.due_every = MemoryFile::kNever;
  file.failing_append = 3;
  RowStore store;
  require(store.init(61, {&file, kHead}));
  append_all(&store);
  EXPECT_EQ(file.size(), kHead);
  store.flush_if_due();
  EXPECT_EQ(file.size(), kHead);
  file.due_every = 1;
  store.flush_if_due(); // says nothing
  EXPECT_EQ(file.size(), reference.ends[3]);
  file.failing_append = 5;
  EXPECT_EQ(store.flush().code(), StatusCode::kIo);
  EXPECT_EQ(file.size(), reference.ends[4]);
  require(store.flush());
  EXPECT_EQ(file.bytes, reference.file.bytes);
}

// Catches: rows of a file that somebody else writes to used as if they were ours.
TEST(RowStore, AFileChangedBehindOurBackIsNoticed) {
  constexpr std::uint64_t kRows = 1001;
  MemoryFile file;
  begin_file(&file);
  RowStore store;
  require(store.init(kRows, {&file, kHead, 1, 1}));
  append_all(&store);
  const std::vector<std::byte> original = file.bytes;
  const auto walk_and = [&](auto change) {
    return store.for_each_range(0, store.block_count(), [&](std::size_t first, std::size_t) {
      if (first == RowStore::kRangeBlocks)
        change();
      return Status();
    });
  };
  Buffer<std::byte> scratch;
  std::span<const std::byte> row;
  for (const std::size_t from_end : {1u, 500u, 900u}) {
    const Status status =
        walk_and([&] { file.bytes[file.bytes.size() - from_end] ^= std::byte{4}; });
    EXPECT_EQ(status.code(), StatusCode::kIo);
    EXPECT_NE(status.message().find("changed"), std::string_view::npos) << status.message();
    file.bytes = original;
    require(walk_and([] {}));
  }
  EXPECT_EQ(walk_and([&] { file.bytes.resize(file.bytes.size() - 8); }).code(), StatusCode::kIo);
  EXPECT_EQ(store.read_row(kRows - 1, &scratch, &row).code(), StatusCode::kIo);
  file.bytes = original;
  file.bytes.back() ^= std::byte{1};
  const Status status = store.read_row(kRows - 1, &scratch, &row);
  EXPECT_EQ(status.code(), StatusCode::kIo);
  EXPECT_NE(status.message().find("1000"), std::string_view::npos) << status.message();
  file.bytes = original;
  require(store.read_row(kRows - 1, &scratch, &row));
  EXPECT_TRUE(is_row(row, kRows - 1));
}

} // namespace
} // namespace hemicube::test
