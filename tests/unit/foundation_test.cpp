#include "radiosity/form_factor/matrix.h"
#include "radiosity/form_factor/reciprocity.h"
#include "radiosity/form_factor/row_accumulator.h"
#include "raster/decimal.h"
#include "raster/fp_environment.h"
#include "raster/hash.h"
#include "raster/kernels.h"
#include "raster/memory.h"
#include "raster/simd/dispatch.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfenv>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace hemicube {
namespace {

TEST(Status, MessagesJoinTextAndNumbers) {
  const Status status =
      Status::error(StatusCode::kBadScene, "a.obj", ":", 12, ": bad ", 0.1, "f ", -3);
  EXPECT_EQ(status.message(), "a.obj:12: bad 0.1f -3");
  EXPECT_EQ(status.code(), StatusCode::kBadScene);
}

TEST(Decimal, IsThatOfTheStandardLibrary) {
  std::mt19937_64 random(1);
  const auto check = [](double value) {
    char text[kMaxDecimal], expected[64];
    const std::string_view written(text, shortest_decimal(value, text));
    EXPECT_EQ(written,
              std::string_view(expected,
                               static_cast<std::size_t>(
                                   std::to_chars(expected, expected + 64, value).ptr - expected)));
  };
  for (const double value : {0.0, -0.0, HUGE_VAL, -HUGE_VAL, 0.1, 5e-324, 0x1p-1022, 0x1p-1021,
                             0x1.fffffffffffffp1023, 1e22, 1e23, 9007199254740993.0, 1e5, 123456.0})
    check(value);
  check(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 5000; ++k) {
    const std::uint64_t bits = random();
    check(std::bit_cast<double>(bits));                                         // any double
    check(static_cast<double>(static_cast<std::int64_t>(bits) >> (bits % 64))); // whole numbers
    check(static_cast<double>(bits % 2000001) / 1000 - 1000);                   // few digits
    check(std::ldexp(1.0, static_cast<int>(bits % 2098) - 1074));               // uneven neighbours
  }
}

TEST(Status, LongMessagesAreCut) {
  const std::string text(2000, 'x');
  EXPECT_EQ(Status::error(StatusCode::kIo, text).message().size(), Status::kCapacity - 1);
}

// Catches: files and file names that steer the terminal of whoever reads about them.
TEST(Status, MessagesHoldNoControlBytes) {
  EXPECT_EQ(Status::error(StatusCode::kIo, "a\x1b[2J\x7f", "b\n\t\xc3\xa4").message(),
            "a?[2J?b??\xc3\xa4");
}

TEST(Buffer, OutOfMemoryIsAStatusAndKeepsTheContent) {
  Buffer<int> buffer;
  ASSERT_TRUE(buffer.push_back(42).ok());
  EXPECT_EQ(buffer.reserve(std::size_t{1} << 62).code(), StatusCode::kOutOfMemory);
  EXPECT_EQ(buffer.size(), 1u);
  EXPECT_EQ(buffer[0], 42);
}

TEST(Buffer, ShrinksToItsContent) {
  Buffer<int> buffer;
  for (int i = 0; i < 17; ++i)
    ASSERT_TRUE(buffer.push_back(i).ok());
  ASSERT_TRUE(buffer.shrink_to_fit().ok());
  for (int i = 0; i < 17; ++i)
    EXPECT_EQ(buffer[static_cast<std::size_t>(i)], i);
  buffer.clear();
  ASSERT_TRUE(buffer.shrink_to_fit().ok());
  EXPECT_EQ(buffer.data(), nullptr);
}

TEST(Buffer, ElementMayBeItsOwnSource) {
  Buffer<int> buffer;
  for (int i = 0; i < 100; ++i)
    ASSERT_TRUE(buffer.push_back(i == 0 ? 7 : buffer[0]).ok());
  EXPECT_EQ(buffer.back(), 7);
}

TEST(FloatEnvironment, RestoresRoundingAndDetectsHonestArithmetic) {
  EXPECT_TRUE(check_float_environment().ok());
  const auto rounds_up = [] {
    volatile double one = 1, little = 0x1p-60;
    return one + little > 1;
  };
  std::fesetround(FE_UPWARD);
  {
    const FloatEnvironment environment;
    EXPECT_FALSE(rounds_up());
  }
  EXPECT_TRUE(rounds_up());
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  std::fesetround(FE_TONEAREST);
}

/// What a host program may do to its threads.
void flush_denormals() {
#if defined(__x86_64__)
  _mm_setcsr(_mm_getcsr() | 0x8040);
#elif defined(__aarch64__)
  asm volatile("msr fpcr, %0" : : "r"(std::uint64_t{1} << 24));
#endif
}

TEST(FloatEnvironment, KeepsDenormals) {
  const FloatEnvironment restored;
  flush_denormals();
  volatile float small = 0x1p-100f, tiny = 0;
  {
    const FloatEnvironment environment;
    tiny = small * 0x1p-40f;
    EXPECT_NE(tiny, 0.0f);
  }
#if defined(__x86_64__) || defined(__aarch64__)
  tiny = small * 0x1p-40f;
  EXPECT_EQ(tiny, 0.0f); // as the host had it
#endif
}

TEST(Hash, DependsOnOrderAndEveryBit) {
  Hash a, b, c;
  a.add(std::uint64_t{1});
  a.add(std::uint64_t{2});
  b.add(std::uint64_t{2});
  b.add(std::uint64_t{1});
  c.add(std::uint64_t{1});
  c.add(std::uint64_t{2} ^ (std::uint64_t{1} << 63));
  EXPECT_NE(a.value(), b.value());
  EXPECT_NE(a.value(), c.value());
}

TEST(Dispatch, FindsKernelsByName) {
  ASSERT_NE(raster::kernels_by_name("scalar"), nullptr);
  EXPECT_STREQ(raster::kernels_by_name("scalar")->name, "scalar");
  EXPECT_EQ(raster::kernels_by_name("doesnotexist"), nullptr);
}

TEST(Dispatch, EnvironmentForcesKernels) {
  ASSERT_EQ(setenv("HEMICUBE_ISA", "scalar", 1), 0);
  EXPECT_STREQ(raster::best_kernels().name, "scalar");
  unsetenv("HEMICUBE_ISA");
}

/// Ids are multiples of `step` below 100 * step.
void sum_like_a_map(std::uint64_t id_count, std::uint32_t step) {
  radiosity::RowAccumulator accumulator;
  ASSERT_TRUE(accumulator.init(id_count, 100).ok());
  std::mt19937 random(3);
  std::vector<std::uint32_t> ids(101);
  std::vector<float> values(101);
  for (int round = 0; round < 20; ++round) {
    std::map<std::uint32_t, std::uint64_t> expected;
    for (int k = 0; k < 40 + 50 * round; ++k) {
      const auto id = static_cast<std::uint32_t>(random() % 100 * step);
      const auto weight = static_cast<std::uint64_t>(random() % 1000 + 1);
      expected[id] += weight;
      accumulator.add(id, weight);
    }
    const std::size_t count = accumulator.take(0.5, ids.data(), values.data());
    ASSERT_EQ(count, expected.size());
    std::size_t at = 0;
    for (const auto& [id, weight] : expected) {
      EXPECT_EQ(ids[at], id);
      EXPECT_EQ(values[at], 0.5f * static_cast<float>(weight));
      ++at;
    }
  }
  EXPECT_EQ(accumulator.take(1, ids.data(), values.data()), 0u);
}

TEST(RowAccumulator, SumsLikeAMapInOrder) {
  sum_like_a_map(100 * 7, 7);
  sum_like_a_map(100 * 997, 997);
}

TEST(RowAccumulator, SumsLikeAMapThroughCollisions) {
  sum_like_a_map(std::uint64_t{1} << 31, 1u << 20); // more ids than slots, all in the same slot
}

TEST(FormFactorMatrix, GivesRowsBack) {
  radiosity::FormFactorMatrix matrix;
  ASSERT_TRUE(matrix.init(70, 5).ok());
  for (std::uint32_t i = 0; i < 70; ++i) {
    const std::vector<std::uint32_t> columns = {i % 5};
    const std::vector<float> values = {static_cast<float>(i)};
    radiosity::RowView row;
    if (i % 3 != 0) {
      row.columns = columns;
      row.values = values;
      row.scale = 0.5;
      row.space = i;
    }
    ASSERT_TRUE(matrix.append_row(i / radiosity::FormFactorMatrix::kBlockRows, row).ok());
  }
  EXPECT_EQ(matrix.nonzero_count(), 70u - 24u);
  for (std::uint32_t i = 0; i < 70; ++i) {
    const radiosity::RowView row = matrix.row(i);
    ASSERT_EQ(row.columns.size(), i % 3 != 0 ? 1u : 0u);
    EXPECT_EQ(radiosity::row_sum(row), i % 3 != 0 ? 0.5 * i : 0);
  }
}

TEST(Reciprocity, MeasuresEveryPairOnce) {
  // Areas 1, 2, 4. Pair 0-1 is reciprocal, 0-2 is off by 0.1, 1-2 is seen from 2 alone, as 0.05.
  const double area[] = {1, 2, 4};
  const double f[3][3] = {{0, 0.5, 0.5}, {0.25, 0, 0}, {0.1, 0.0125, 0}};
  radiosity::FormFactorMatrix matrix;
  ASSERT_TRUE(matrix.init(3, 3).ok());
  for (std::uint32_t i = 0; i < 3; ++i) {
    std::vector<std::uint32_t> columns;
    std::vector<float> values;
    for (std::uint32_t j = 0; j < 3; ++j)
      if (f[i][j] > 0) {
        columns.push_back(j);
        values.push_back(static_cast<float>(f[i][j]));
      }
    radiosity::RowView row;
    row.columns = columns;
    row.values = values;
    ASSERT_TRUE(matrix.append_row(0, row).ok());
  }
  radiosity::SerialExecutor executor;
  radiosity::Reciprocity reciprocity;
  ASSERT_TRUE(radiosity::measure_reciprocity(matrix, area, executor, &reciprocity).ok());
  EXPECT_NEAR(reciprocity.max, 0.1, 1e-7);
  const double off = 0.1 * 0.1 + 0.05 * 0.05, all = 0.5 * 0.5 + 0.5 * 0.5 + 0.05 * 0.05;
  EXPECT_NEAR(reciprocity.rms, std::sqrt(off / all), 1e-7);
}

TEST(RowDot, OrderIsTheDocumentedOne) {
  // 2^53 + 1 is lost unless the ones meet first: eight partial sums, each its own lane.
  std::vector<std::uint32_t> columns(17);
  std::vector<float> values(17, 1.0f);
  std::vector<double> x(17, 1);
  for (std::uint32_t k = 0; k < 17; ++k)
    columns[k] = k;
  x[0] = 0x1p53;
  radiosity::RowView row;
  row.columns = columns;
  row.values = values;
  // Lane 0: 2^53 + 1 + 1 = 2^53 (ties to even); lanes 1..7: 2 each; the tree adds 14.
  EXPECT_EQ(radiosity::row_dot(row, x.data()), 0x1p53 + 14);
}

} // namespace
} // namespace hemicube
