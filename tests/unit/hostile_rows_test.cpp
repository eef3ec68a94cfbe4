// Files of form factors whose checksums are right and whose rows are not: somebody meant it.

#include "radiosity/form_factor/matrix_file.h"
#include "tests/support/memory_file.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace hemicube::test {
namespace {

using radiosity::FormFactorMatrix;
using radiosity::MatrixFileHead;
using radiosity::RowStorage;
using radiosity::RowStore;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNanValue = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// The parts of a row as they lie in a file.
struct Row {
  std::uint64_t nonzeros = 3;
  double scale = 1, space = 0.25, back_side = 0.125;
  std::uint64_t facts[6] = {};
  std::vector<std::uint32_t> columns{0, 2, 5};
  std::vector<float> values{0.125f, 0.25f, 0.25f};

  std::vector<std::byte> bytes() const {
    std::vector<std::byte> all(80 + (4 * columns.size() + 4 * values.size() + 7) / 8 * 8);
    std::size_t at = 0;
    const auto add = [&](const void* data, std::size_t size) {
      if (size != 0)
        std::memcpy(all.data() + at, data, size);
      at += size;
    };
    const double shares[] = {scale, space, back_side};
    add(&nonzeros, 8);
    add(shares, sizeof shares);
    add(facts, sizeof facts);
    add(columns.data(), 4 * columns.size());
    add(values.data(), 4 * values.size());
    return all;
  }
};

/// A finished file of 6 rows, all of them sound but for one.
class HostileRowsTest : public testing::Test {
protected:
  void write(const std::vector<std::byte>& hostile, std::uint64_t place) {
    MatrixFileHead head;
    head.resolution = 64;
    head.target = 0.01;
    head.row_count = head.column_count = 6;
    head.geometry = radiosity::hash_geometry(patches_);
    file_.bytes.clear();
    RowStorage storage;
    require(radiosity::open_to_append(file_, head, &storage));
    RowStore rows;
    require(rows.init(6, storage));
    for (std::uint64_t i = 0; i < 6; ++i)
      require(rows.append(0, {std::span<const std::byte>(i == place ? hostile : Row().bytes())}));
    add_end(storage);
  }

  void add_end(const RowStorage& storage) {
    FormFactorMatrix none; // has nothing to bring to the file but its end
    require(none.init(6, 6, storage));
    require(radiosity::finish_file(&none));
  }

  Status open(std::uint64_t most_bytes = RowStorage::kUnlimited) {
    FormFactorMatrix matrix;
    MatrixFileHead head;
    return radiosity::open_finished({&file_, 0, most_bytes, 1}, patches_, &matrix, &head);
  }

  void expect_refused(const char* what) {
    for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{1}}) {
      const Status status = open(most);
      EXPECT_EQ(status.code(), StatusCode::kBadScene) << what;
      EXPECT_NE(status.message().find("memory.hcf"), std::string_view::npos) << status.message();
    }
  }

  template <typename Change> void expect_refused(const char* what, Change change) {
    for (std::uint64_t place = 0; place < 6; ++place) {
      Row row;
      change(&row);
      write(row.bytes(), place);
      expect_refused(what);
    }
  }

  const PatchSet patches_ = patches_of(box_enclosure({1, 1, 1}, 1, 1, 1, 0.5, 1));
  MemoryFile file_;
};

TEST_F(HostileRowsTest, SoundRowsAreTaken) {
  write(Row().bytes(), 2);
  EXPECT_EQ(open().code(), StatusCode::kOk) << open().message();
  Row whole;
  whole.scale = 1.6; // sums to 1
  whole.space = whole.back_side = 0;
  write(whole.bytes(), 2);
  EXPECT_EQ(open().code(), StatusCode::kOk) << open().message();
  Row none;
  none.nonzeros = 0;
  none.columns.clear();
  none.values.clear();
  write(none.bytes(), 2);
  EXPECT_EQ(open().code(), StatusCode::kOk) << open().message();
}

// Catches: columns that lead out of the light's arrays, or meet a patch twice.
TEST_F(HostileRowsTest, ColumnsMustAscendWithinTheMesh) {
  expect_refused("beyond the last patch", [](Row* row) { row->columns[2] = 6; });
  expect_refused("far beyond", [](Row* row) { row->columns[2] = 0xffffffff; });
  expect_refused("twice", [](Row* row) { row->columns[1] = 5; });
  expect_refused("descending", [](Row* row) { std::swap(row->columns[0], row->columns[1]); });
}

// Catches: light that is negative, endless or no number.
TEST_F(HostileRowsTest, ValuesMustBeAmounts) {
  for (const float value : {-0.25f, -1e-30f, kNanValue, kInfinite, -kInfinite})
    for (std::size_t k = 0; k < 3; ++k)
      expect_refused("value", [&](Row* row) { row->values[k] = value; });
}

TEST_F(HostileRowsTest, SharesMustBeShares) {
  for (const double scale : {-1.0, kNan, kInfinity, -kInfinity})
    expect_refused("scale", [&](Row* row) { row->scale = scale; });
  for (const double share : {-1e-9, 1 + 1e-9, kNan, kInfinity, -kInfinity}) {
    expect_refused("space", [&](Row* row) { row->space = share; });
    expect_refused("back side", [&](Row* row) { row->back_side = share; });
  }
}

// Catches: light from nothing.
TEST_F(HostileRowsTest, RowsMustNotSumToMoreThanOne) {
  expect_refused("scale", [](Row* row) { row->scale = 1.6 * (1 + 1e-9); });
  expect_refused("values", [](Row* row) { row->values[1] = 0.75f; });
  expect_refused("large scale", [](Row* row) { row->scale = 1e308; });
  expect_refused("beyond all numbers", [](Row* row) {
    row->scale = 1e308;
    row->values = {3e38f, 3e38f, 3e38f};
  });
}

// Catches: counts that lead out of the row.
TEST_F(HostileRowsTest, TheCountMustFitTheSize) {
  for (const std::uint64_t count :
       {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{4}, ~std::uint64_t{0},
        std::uint64_t{1} << 61, (std::uint64_t{1} << 61) + 3, (std::uint64_t{1} << 62) + 3})
    expect_refused("count", [&](Row* row) { row->nonzeros = count; });
  for (const std::size_t size : {0u, 8u, 40u, 72u}) {
    std::vector<std::byte> bytes = Row().bytes();
    bytes.resize(size);
    write(bytes, 3);
    expect_refused("too short for a row");
  }
}

// Catches: rows that are refused and counted all the same.
TEST_F(HostileRowsTest, WhatIsRefusedIsNotCounted) {
  Row negative;
  negative.values[0] = -1;
  write(negative.bytes(), 4);
  FormFactorMatrix matrix;
  std::uint64_t rest = 0;
  require(matrix.init(6, 6, {&file_, sizeof(MatrixFileHead)}));
  require(matrix.adopt(file_.size(), &rest));
  EXPECT_EQ(rest, sizeof(MatrixFileHead));
  EXPECT_EQ(matrix.nonzero_count(), 0u);
}

} // namespace
} // namespace hemicube::test
