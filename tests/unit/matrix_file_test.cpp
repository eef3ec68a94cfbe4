// Files of form factors: what is written is read bit for bit; whatever else is in a file is refused
// with its name, and never becomes a row.

#include "radiosity/form_factor/matrix_file.h"
#include "raster/hash.h"
#include "tests/support/memory_file.h"
#include "tests/support/polygon_lists.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace hemicube::test {
namespace {

using radiosity::FormFactorMatrix;
using radiosity::MatrixFileHead;
using radiosity::RowFacts;
using radiosity::RowStorage;
using radiosity::RowStore;
using radiosity::RowView;

/// 22 patches: the last block of rows is not full.
PatchSet mesh() {
  return patches_of(box_enclosure({1, 2, 3}, 1, 2, 3, 0.5, 1));
}

/// Row i of n, made up: some have no entries.
struct MadeRow {
  MadeRow(std::uint32_t i, std::uint32_t n) {
    Random random(i);
    for (std::uint32_t j = 0; j < n; ++j)
      if (i % 7 != 3 && j != i && random.index(3) != 0) {
        columns.push_back(j);
        values.push_back(static_cast<float>(random.between(0.001, 1)));
      }
    row.columns = columns;
    row.values = values;
    row.space = columns.empty() ? 0.75 : 0.25 * random.unit();
    row.back_side = 0.25;
    radiosity::fit_scale(1 - row.space - row.back_side, &row);
    facts = {i + 1, i * i, 0.9 + random.unit(), random.unit(), random.unit(), i * 1000, i * 17};
  }

  std::vector<std::uint32_t> columns;
  std::vector<float> values;
  RowView row;
  RowFacts facts;
};

MatrixFileHead head_of(const PatchSet& patches) {
  MatrixFileHead head;
  head.rung = static_cast<std::uint32_t>(radiosity::Rung::kAdaptive);
  head.resolution = 128;
  head.target = 0.03;
  head.row_count = head.column_count = patches.patch_count();
  head.geometry = radiosity::hash_geometry(patches);
  return head;
}

/// Appends the first rows that a mesh has.
void append_rows(std::uint32_t count, FormFactorMatrix* matrix) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const MadeRow made(i, matrix->column_count());
    require(matrix->append_row(i / FormFactorMatrix::kBlockRows, made.row, made.facts));
  }
}

void write_finished(const PatchSet& patches, MemoryFile* file) {
  RowStorage storage;
  require(radiosity::open_to_append(*file, head_of(patches), &storage));
  FormFactorMatrix matrix;
  require(matrix.init(patches.patch_count(), patches.patch_count(), storage));
  append_rows(patches.patch_count(), &matrix);
  require(radiosity::finish_file(&matrix));
}

Status open(MemoryFile* file, const PatchSet& patches, FormFactorMatrix* matrix,
            std::uint64_t most_bytes = RowStorage::kUnlimited) {
  MatrixFileHead head;
  return radiosity::open_finished({file, 0, most_bytes, 1}, patches, matrix, &head);
}

void expect_made_rows(const FormFactorMatrix& matrix) {
  std::uint32_t next = 0;
  require(matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i) {
      const MadeRow made(next++, matrix.column_count());
      EXPECT_EQ(radiosity::hash_row(matrix.row(i)), radiosity::hash_row(made.row)) << i;
      const RowFacts facts = matrix.facts(i);
      EXPECT_EQ(std::memcmp(&facts, &made.facts, sizeof facts), 0) << i;
    }
    return Status();
  }));
  EXPECT_EQ(next, matrix.row_count());
}

/// The file must be refused as a bad scene, in one line that names it and says `part`.
void expect_refused(MemoryFile* file, const PatchSet& patches, std::string_view part) {
  FormFactorMatrix matrix;
  const std::vector<std::byte> before = file->bytes;
  const Status status = open(file, patches, &matrix);
  EXPECT_EQ(status.code(), StatusCode::kBadScene);
  EXPECT_TRUE(status.message().starts_with("memory.hcf: ")) << status.message();
  EXPECT_NE(status.message().find(part), std::string_view::npos)
      << "expected '" << part << "' in: " << status.message();
  EXPECT_EQ(file->bytes, before);
}

class MatrixFileTest : public testing::Test {
protected:
  MatrixFileTest() { write_finished(patches_, &file_); }

  MatrixFileHead head() const {
    MatrixFileHead head;
    std::memcpy(&head, file_.bytes.data(), sizeof head);
    return head;
  }
  void set_head(MatrixFileHead head) {
    head.seal();
    std::memcpy(file_.bytes.data(), &head, sizeof head);
  }

  const PatchSet patches_ = mesh();
  MemoryFile file_;
};

// Catches: facts or shares that are not kept, a head that says something else than it was given.
// Catches: form factors below 0, and a search for a scale that never ends, where rounding leaves a
// row less than nothing beside space and back side.
TEST(FitScale, RowsWithoutAShareHaveNoEntries) {
  const std::uint32_t columns[] = {1, 2};
  const float values[] = {1e-17f, 3e-18f};
  for (const double share : {-1.9266563357968124e-17, 0.0}) {
    radiosity::RowView row;
    row.columns = columns;
    row.values = values;
    radiosity::fit_scale(share, &row);
    EXPECT_EQ(row.columns.size() + row.values.size(), 0u);
    EXPECT_EQ(radiosity::row_sum(row), 0.0);
  }
}

TEST_F(MatrixFileTest, WhatIsWrittenIsReadBitForBit) {
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{1}}) {
    FormFactorMatrix matrix;
    MatrixFileHead head;
    require(radiosity::open_finished({&file_, 0, most, 1}, patches_, &matrix, &head));
    EXPECT_EQ(matrix.is_in_memory(), most != 1);
    expect_made_rows(matrix);
    std::uint64_t nonzeros = 0;
    for (std::uint32_t i = 0; i < matrix.row_count(); ++i)
      nonzeros += MadeRow(i, patches_.patch_count()).columns.size();
    EXPECT_EQ(matrix.nonzero_count(), nonzeros);
    EXPECT_EQ(head.setting().rung, radiosity::Rung::kAdaptive);
    EXPECT_EQ(head.setting().resolution, 128u);
    EXPECT_EQ(head.setting().target, 0.03);
  }
}

TEST_F(MatrixFileTest, AFileOfTheSameKindIsGoneOnWithAnotherIsBegunAnew) {
  const MatrixFileHead same = head_of(patches_);
  const std::vector<std::byte> before = file_.bytes;
  RowStorage storage;
  require(radiosity::open_to_append(file_, same, &storage));
  EXPECT_EQ(file_.bytes, before);
  EXPECT_EQ(storage.begin, sizeof(MatrixFileHead));
  EXPECT_EQ(storage.file, &file_);
  for (int change = 0; change < 11; ++change) {
    MatrixFileHead other = same;
    std::uint32_t* const numbers[] = {&other.results, &other.rung, &other.resolution,
                                      &other.rounds};
    std::uint64_t* const words[] = {&other.row_count, &other.column_count, &other.geometry,
                                    &other.request};
    if (change < 4)
      ++*numbers[change];
    else if (change < 8)
      ++*words[change - 4];
    else if (change == 8)
      other.target = std::nextafter(other.target, 1);
    else if (change == 9)
      other.part = MatrixFileHead::Part::kPairs;
    else
      other.found[7] = 1e-300;
    file_.bytes = before;
    require(radiosity::open_to_append(file_, other, &storage));
    EXPECT_EQ(file_.size(), sizeof(MatrixFileHead)) << change;
    MatrixFileHead found;
    bool is_sound = false;
    require(radiosity::read_head(file_, &found, &is_sound));
    EXPECT_TRUE(is_sound) << change;
    other.seal();
    EXPECT_EQ(std::memcmp(&found, &other, sizeof found), 0) << change;
  }
}

TEST_F(MatrixFileTest, WhatIsNoFileOfFormFactorsIsRefused) {
  file_.bytes.clear();
  expect_refused(&file_, patches_, "is not a file of form factors (0 bytes)");
  file_.bytes.assign(5000, std::byte{'x'});
  expect_refused(&file_, patches_, "is not a file of form factors (5000 bytes)");
  file_.bytes.assign(5000, std::byte{0});
  expect_refused(&file_, patches_, "is not a file of form factors");
}

TEST_F(MatrixFileTest, HeadsThatMeanSomethingElseAreRefused) {
  const MatrixFileHead sound = head();
  const auto refuse = [&](std::string_view part, auto change) {
    MatrixFileHead other = sound;
    change(&other);
    set_head(other);
    expect_refused(&file_, patches_, part);
  };
  const char* const damaged = "is not a file of form factors";
  refuse("is of format 2, this program reads format 1", [](auto* head) { head->format = 2; });
  refuse("part of a run", [](auto* head) { head->part = MatrixFileHead::Part::kPairs; });
  refuse("part of a run", [](auto* head) { head->part = MatrixFileHead::Part::kBlackRows; });
  refuse("of 23 patches of another mesh", [](auto* head) { ++head->row_count; });
  refuse("another mesh", [](auto* head) { --head->column_count; });
  refuse("another mesh", [](auto* head) { head->row_count = ~std::uint64_t{0}; });
  refuse("another mesh", [](auto* head) { ++head->geometry; });
  refuse(damaged, [](auto* head) { ++head->magic; });
  refuse(damaged, [](auto* head) { head->rung = 5; });
  refuse(damaged, [](auto* head) { head->resolution = 0x10000; });
  refuse(damaged, [](auto* head) { head->rounds = 9; });
  refuse(damaged, [](auto* head) { head->rounds = ~std::uint32_t{0}; });
  for (const double target : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()})
    refuse(damaged, [&](auto* head) { head->target = target; });
  set_head(sound);
  FormFactorMatrix matrix;
  require(open(&file_, patches_, &matrix));
}

// Catches: rows of a mesh that looks the same.
TEST_F(MatrixFileTest, OtherMeshesAreRefused) {
  const char* const other_mesh = "holds the form factors of 22 patches of another mesh";
  for (int axis = 0; axis < 3; ++axis)
    for (const double towards : {-10.0, 10.0}) {
      PatchSet moved = mesh();
      Vec3& vertex = moved.vertices[moved.vertices.size() - 1];
      vertex[axis] = std::nextafter(vertex[axis], towards);
      expect_refused(&file_, moved, other_mesh);
    }
  PolygonList polygons = list_of(patches_);
  std::swap(polygons[3], polygons[4]);
  expect_refused(&file_, patches_of(polygons), other_mesh);
  polygons = list_of(patches_);
  std::rotate(polygons[5].begin(), polygons[5].begin() + 1, polygons[5].end());
  expect_refused(&file_, patches_of(polygons), other_mesh);
  polygons = list_of(patches_);
  polygons.pop_back();
  expect_refused(&file_, patches_of(polygons), other_mesh);
}

// Corners that are shared or not are the same mesh: nothing of a row depends on it.
TEST_F(MatrixFileTest, TheSameCornersAreTheSameMesh) {
  FormFactorMatrix matrix;
  require(open(&file_, patches_of(list_of(patches_)), &matrix));
  expect_made_rows(matrix);
}

// Catches: rows of a run that was interrupted taken for all of them.
TEST_F(MatrixFileTest, FilesThatAreNotFinishedAreRefused) {
  for (const std::uint32_t rows : {0u, 7u, 8u, 16u, 22u}) {
    MemoryFile file;
    RowStorage storage;
    require(radiosity::open_to_append(file, head_of(patches_), &storage));
    FormFactorMatrix matrix;
    require(matrix.init(patches_.patch_count(), patches_.patch_count(), storage));
    append_rows(rows, &matrix);
    expect_refused(&file, patches_, "cut off");
    require(radiosity::finish_file(&matrix)); // too early
    if (rows < 22)
      expect_refused(&file, patches_, "no sound rows");
    else
      require(open(&file, patches_, &matrix));
  }
}

TEST_F(MatrixFileTest, FilesThatAreCutAreRefusedAtEveryLength) {
  while (!file_.bytes.empty()) {
    file_.bytes.pop_back();
    expect_refused(&file_, patches_,
                   file_.size() < sizeof(MatrixFileHead) ? "is not a file" : "it is cut off");
  }
}

// Catches: bytes that nothing checks.
TEST_F(MatrixFileTest, FilesWithAnyByteChangedAreRefused) {
  for (const std::byte flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}})
    for (std::byte& byte : file_.bytes) {
      byte ^= flip;
      expect_refused(&file_, patches_, "");
      byte ^= flip;
    }
  FormFactorMatrix matrix;
  require(open(&file_, patches_, &matrix));
  expect_made_rows(matrix);
}

TEST_F(MatrixFileTest, NothingMayFollowTheEnd) {
  const std::vector<std::byte> original = file_.bytes;
  for (const std::size_t more : {1u, 8u, 24u, 144u}) {
    file_.bytes.resize(original.size() + more);
    expect_refused(&file_, patches_, "");
  }
  file_.bytes = original;
  file_.bytes.insert(file_.bytes.end(), original.end() - 24, original.end());
  expect_refused(&file_, patches_, "");
}

// Catches: bytes between the rows and the end, where nothing is looked for.
TEST_F(MatrixFileTest, NothingMayLieBetweenTheRowsAndTheEnd) {
  std::vector<std::byte> junk(8);
  const std::vector<std::byte> original = file_.bytes;
  for (const bool is_block : {false, true}) {
    if (is_block) // the first one once more
      junk.assign(original.begin() + sizeof(MatrixFileHead), original.end() - 24);
    file_.bytes.assign(original.begin(), original.end() - 24);
    FormFactorMatrix none;
    require(none.init(22, 22, {&file_, sizeof(MatrixFileHead)}));
    require(file_.append(junk));
    require(radiosity::finish_file(&none));
    expect_refused(&file_, patches_, "no sound rows");
  }
}

} // namespace
} // namespace hemicube::test
