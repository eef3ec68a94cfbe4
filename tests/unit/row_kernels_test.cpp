// The handwritten sums over rows: the same bits on every instruction set, and those of row_dot().
#include "radiosity/form_factor/matrix.h"
#include "radiosity/solve/row_gather.h"
#include "radiosity/solve/simd/dispatch.h"
#include "raster/simd/dispatch.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace hemicube::radiosity {
namespace {

class RowKernelsTest : public ::testing::TestWithParam<const char*> {
protected:
  void SetUp() override {
    if (raster::kernels_by_name(GetParam()) == nullptr)
      GTEST_SKIP() << "not on this machine";
  }
};

// Catches: a vector that folds in its own order, a remainder in the wrong partial sum, neighbours
// taken for such that are none, a band of a neighbouring patch.
TEST_P(RowKernelsTest, SumsAreThoseOfRowDot) {
  constexpr std::uint32_t kPatches = 700;
  std::mt19937 engine(5);
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.25; };
  for (std::uint32_t bands = 1; bands <= 9; ++bands) {
    std::vector<double> x(kPatches * bands);
    for (double& value : x)
      value = unit();
    RowGather gather;
    ASSERT_TRUE(gather.init(kPatches, bands, row_kernels(GetParam())).ok());
    gather.fill(x);
    for (int round = 0; round < 60; ++round) {
      std::vector<std::uint32_t> columns;
      std::vector<float> values;
      const std::uint32_t longest_run = 1 + random() % 40;
      for (std::uint32_t j = random() % 9; j < kPatches; j += 1 + random() % longest_run)
        for (std::uint32_t left = random() % longest_run; left > 0 && j < kPatches; --left) {
          columns.push_back(j++);
          values.push_back(static_cast<float>(unit()));
        }
      RowView row;
      row.columns = columns;
      row.values = values;
      row.scale = 1 + unit();
      for (const std::size_t last : {columns.size(), columns.size() / 2}) {
        const std::size_t first = last == 0 ? 0 : random() % last;
        std::vector<double> sums(bands);
        gather.sum(row, first, last, sums.data());
        for (std::uint32_t b = 0; b < bands; ++b)
          ASSERT_EQ(sums[b], row_dot(row, x.data() + b, bands, first, last))
              << bands << " bands, band " << b << ", entries " << first << " to " << last;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Isas, RowKernelsTest,
                         ::testing::Values("scalar", "sse41", "avx2", "avx512", "neon"),
                         [](const auto& test) { return std::string(test.param); });

} // namespace
} // namespace hemicube::radiosity
