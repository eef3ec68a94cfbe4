#include "radiosity/form_factor/balance.h"
#include "radiosity/form_factor/reciprocity.h"
#include "radiosity/parallel/thread_pool.h"
#include "raster/memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace hemicube::radiosity {
namespace {

/// A matrix as dense rows, with areas; what rows and back sides leave to 1 is space.
struct Patches {
  std::vector<std::vector<double>> f;
  std::vector<double> area, back_side;

  explicit Patches(std::size_t n) : f(n, std::vector<double>(n)), area(n, 1), back_side(n) {}
  std::size_t count() const { return area.size(); }

  void fill(FormFactorMatrix* matrix) const {
    ASSERT_TRUE(matrix->init(count(), static_cast<std::uint32_t>(count())).ok());
    for (std::size_t i = 0; i < count(); ++i) {
      std::vector<std::uint32_t> columns;
      std::vector<float> values;
      double sum = 0;
      for (std::size_t j = 0; j < count(); ++j)
        if (f[i][j] > 0) {
          columns.push_back(static_cast<std::uint32_t>(j));
          values.push_back(static_cast<float>(f[i][j]));
          sum += f[i][j];
        }
      RowView row;
      row.columns = columns;
      row.values = values;
      row.back_side = back_side[i];
      row.space = sum > 1 - 1e-12 - back_side[i] ? 0 : 1 - back_side[i] - sum;
      row.scale = columns.empty() ? 1 : (1 - row.space - row.back_side) / row_sum(row);
      ASSERT_TRUE(matrix->append_row(i / FormFactorMatrix::kBlockRows, row).ok());
    }
  }
};

/// Exchange areas of a random pattern, seen from both sides with errors of up to `error` of
/// themselves; one entry of 20 is missed. @param open  whether rows see space
Patches random_patches(std::uint32_t seed, std::size_t n, double density, double error, bool open) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
  Patches p(n);
  std::vector<std::vector<double>> s(n, std::vector<double>(n));
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      s[i][j] = s[j][i] = uniform() < density || j + 1 == i ? 0.01 + std::pow(uniform(), 4) : 0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    p.area[i] = 0;
    for (const double value : s[i])
      p.area[i] += value;
    largest = std::max(largest, p.area[i]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    p.area[i] *= open ? 1 + uniform() : 1;
    double seen = 0, was = 0;
    for (std::size_t j = 0; j < n; ++j) {
      was += s[i][j];
      if (s[i][j] < 0.2 && uniform() < 0.05)
        s[i][j] *= -1; // missed by this row, not by the other
    }
    for (std::size_t j = 0; j < n; ++j)
      seen += p.f[i][j] = std::max(0.0, s[i][j]) * (1 + error * (2 * uniform() - 1));
    for (std::size_t j = 0; j < n; ++j) {
      p.f[i][j] *= was / seen / p.area[i];
      s[i][j] = std::fabs(s[i][j]);
    }
  }
  return p;
}

struct Outcome {
  Status status;
  FormFactorMatrix matrix;
  BalanceReport report;
  Reciprocity before, after;
};

void run(const Patches& patches, Outcome* outcome, std::uint32_t workers = 1) {
  ThreadPool pool;
  ASSERT_TRUE(pool.init(workers).ok());
  patches.fill(&outcome->matrix);
  const std::span<const double> area = patches.area;
  ASSERT_TRUE(measure_reciprocity(outcome->matrix, area, pool, &outcome->before).ok());
  outcome->status = balance(&outcome->matrix, area, pool, nullptr, &outcome->report);
  ASSERT_TRUE(measure_reciprocity(outcome->matrix, area, pool, &outcome->after).ok());
}

void expect_closed(const FormFactorMatrix& matrix) {
  for (std::uint64_t i = 0; i < matrix.row_count(); ++i) {
    const RowView row = matrix.row(i);
    const double share = 1 - row.space - row.back_side;
    EXPECT_LE(row_sum(row), share) << i;
    EXPECT_NEAR(row_sum(row), share, 1e-15) << i;
    EXPECT_GE(row.space, 0) << i;
    EXPECT_GE(row.back_side, 0) << i;
    EXPECT_TRUE(std::is_sorted(row.columns.begin(), row.columns.end())) << i;
    for (const float value : row.values)
      EXPECT_GT(value, 0) << i;
  }
}

// Catches: multipliers without end for what no multiplier changes: of two patches that see each
// other alone, the difference of their sums.
TEST(Balance, PairsThatOneOfThemMissesStayNumbers) {
  std::mt19937 random(5);
  const auto uniform = [&] { return (static_cast<double>(random() >> 8) + 0.5) / 16777216.0; };
  for (int round = 0; round < 3000; ++round) {
    Patches pair(2);
    pair.area = {uniform(), uniform()};
    pair.f[0][1] = uniform() * std::min(1.0, pair.area[1] / pair.area[0]);
    pair.f[1][0] = round % 2 == 0 ? 0 : pair.f[0][1] * pair.area[0] / pair.area[1] * uniform();
    Outcome got;
    run(pair, &got);
    EXPECT_TRUE(std::isfinite(got.report.rms_change)) << round;
    if (got.status.ok())
      expect_closed(got.matrix);
  }
}

struct Kind {
  std::size_t n;
  double density;
  bool open;
};

// Dense and sparse, so that tiles of columns are one block and many; closed and open.
const Kind kKinds[] = {{2, 1, false},     {33, 1, false},      {150, 0.5, false}, {700, 0.3, true},
                       {700, 0.02, true}, {1500, 0.01, false}, {1000, 0.2, false}};

// Catches: pairs averaged with the wrong partner, entries that one row misses left out or entered
// twice, rows closed above 1, space or back sides that change although the problem has a solution.
TEST(Balance, RandomMatricesBecomeReciprocalAndStayClosed) {
  for (const Kind& kind : kKinds) {
    SCOPED_TRACE(kind.n);
    const Patches patches = random_patches(3, kind.n, kind.density, 0.3, kind.open);
    FormFactorMatrix raw;
    patches.fill(&raw);
    Outcome got;
    run(patches, &got);
    ASSERT_TRUE(got.status.ok()) << got.status.message();
    EXPECT_LE(got.report.closure_residual, 1e-7);
    EXPECT_LE(got.after.max, 1e-7);
    EXPECT_LE(got.after.rms, 1e-7);
    EXPECT_TRUE(kind.n == 2 || got.report.rms_change > 1e-3);
    expect_closed(got.matrix);
    for (std::size_t i = 0; i < kind.n; ++i) {
      EXPECT_EQ(got.matrix.row(i).space, raw.row(i).space) << i;
      std::vector<std::uint32_t> expected;
      for (std::uint32_t j = 0; j < kind.n; ++j)
        if (patches.f[i][j] > 0 || patches.f[j][i] > 0)
          expected.push_back(j);
      const std::span<const std::uint32_t> columns = got.matrix.row(i).columns;
      EXPECT_TRUE(std::equal(columns.begin(), columns.end(), expected.begin(), expected.end()))
          << i;
    }
  }
}

// Catches: sums whose shape depends on who computes them, entries written by two workers.
TEST(Balance, AnyNumberOfWorkersGivesTheSameBits) {
  const Patches patches = random_patches(5, 900, 0.2, 0.3, true);
  Outcome one;
  run(patches, &one);
  for (const std::uint32_t workers : {2u, 3u, 7u}) {
    Outcome other;
    run(patches, &other, workers);
    EXPECT_EQ(other.report.iterations, one.report.iterations);
    EXPECT_EQ(other.report.rms_change, one.report.rms_change);
    EXPECT_EQ(other.report.max_change, one.report.max_change);
    EXPECT_EQ(other.report.closure_residual, one.report.closure_residual);
    EXPECT_EQ(other.before.rms, one.before.rms);
    EXPECT_EQ(other.after.max, one.after.max);
    for (std::uint64_t i = 0; i < one.matrix.row_count(); ++i)
      ASSERT_EQ(hash_row(other.matrix.row(i)), hash_row(one.matrix.row(i))) << i;
  }
}

// Catches: a correction that is no fixed point, such as one that weighs pairs by direction.
TEST(Balance, WhatIsBalancedStays) {
  const Patches patches = random_patches(7, 400, 0.3, 0.3, false);
  Outcome got;
  run(patches, &got);
  SerialExecutor executor;
  BalanceReport again;
  ASSERT_TRUE(balance(&got.matrix, patches.area, executor, nullptr, &again).ok());
  EXPECT_LT(again.max_change, 1e-6);
  EXPECT_LT(again.rms_change, 1e-6);
  EXPECT_LE(again.iterations, 40u);
}

// Two plates that see nothing but each other, of different area: S_12 would have to be both areas.
// Catches: loops without end, rows that no longer sum to 1.
TEST(Balance, PlatesThatCannotCloseAreClosedAndSayHowFarTheyAreOff) {
  Patches patches(2);
  patches.area = {1, 2};
  patches.f = {{0, 1}, {1, 0}};
  Outcome got;
  run(patches, &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  EXPECT_NEAR(got.report.closure_residual, 0.5, 0.2);
  EXPECT_LT(got.report.iterations, 100u);
  expect_closed(got.matrix);
  EXPECT_EQ(row_sum(got.matrix.row(0)), 1);
  EXPECT_GT(got.after.max, 0.1);
}

// The same with space around: it takes what is left. Catches: reciprocity or closure given up
// although there is somewhere to put the rest.
TEST(Balance, SpaceTakesWhatPlatesCannotExchange) {
  Patches patches(2);
  patches.area = {1, 1.2};
  patches.f = {{0, 0.3}, {0.3, 0}};
  Outcome got;
  run(patches, &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  expect_closed(got.matrix);
  EXPECT_LE(got.after.max, 1e-7);
  EXPECT_NE(got.matrix.row(0).space, 0.7);
  EXPECT_GT(got.report.closure_residual, 1e-3) << "says that space had to give way";
}

// A floor patch whose centre lies under a block, where it sees back sides only, though others see
// its rim. Catches: entries pressed to nothing, hundreds of iterations for one such row.
TEST(Balance, ARowOutOfReachGivesUpItsBackSides) {
  Patches patches = random_patches(9, 100, 0.5, 0.1, false);
  patches.f[40].assign(100, 0.0);
  patches.back_side[40] = 1;
  Outcome got;
  run(patches, &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  expect_closed(got.matrix);
  EXPECT_LE(got.after.max, 1e-6);
  EXPECT_GT(row_sum(got.matrix.row(40)), 0.2);
  EXPECT_LT(got.matrix.row(40).back_side, 0.8);
}

// Catches: a matrix that is no small correction of the other passed off as one.
TEST(Balance, FormFactorsFarFromReciprocalAreRefused) {
  Patches patches(2);
  patches.f = {{0, 0.9}, {0.05, 0}};
  Outcome got;
  run(patches, &got);
  EXPECT_EQ(got.status.code(), StatusCode::kBadScene);
  EXPECT_NE(got.status.message().find("do not balance"), std::string_view::npos)
      << got.status.message();
  EXPECT_GT(got.report.rms_change, kMostBalanceChange);
}

// Catches: divisions by an area or a weight that does not exist.
TEST(Balance, NothingToDoIsDone) {
  Outcome none;
  run(Patches(0), &none);
  EXPECT_TRUE(none.status.ok());
  Outcome alone; // one patch in space
  run(Patches(1), &alone);
  EXPECT_TRUE(alone.status.ok());
  EXPECT_EQ(alone.matrix.row(0).space, 1);
  EXPECT_EQ(alone.report.rms_change, 0);
  Patches pair(4); // the first two see each other, the last two nothing
  pair.f[0][1] = pair.f[1][0] = 0.25;
  pair.back_side[3] = 1;
  Outcome isolated;
  run(pair, &isolated);
  ASSERT_TRUE(isolated.status.ok());
  expect_closed(isolated.matrix);
  EXPECT_EQ(row_sum(isolated.matrix.row(0)), 0.25);
  EXPECT_EQ(isolated.matrix.row(2).space, 1);
  EXPECT_EQ(isolated.matrix.row(3).back_side, 1);
}

// Catches: rows that a solve leaves out (of black patches) balanced as if they saw nothing.
TEST(Balance, AMatrixWithoutAllRowsIsRefused) {
  FormFactorMatrix matrix;
  ASSERT_TRUE(matrix.init(2, 2).ok());
  RowView row;
  row.space = 1;
  ASSERT_TRUE(matrix.append_row(0, row).ok());
  SerialExecutor executor;
  BalanceReport report;
  const Status status = balance(&matrix, std::vector<double>{1, 1}, executor, nullptr, &report);
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_NE(status.message().find("row 1"), std::string_view::npos) << status.message();
}

class StopAtOnce final : public BalanceProgress {
public:
  bool iterated(std::uint64_t, double) noexcept override { return false; }
};

// Catches: an interrupt that has to wait for the last of hundreds of iterations.
TEST(Balance, CanBeStopped) {
  const Patches patches = random_patches(11, 50, 0.5, 0.3, false);
  FormFactorMatrix matrix;
  patches.fill(&matrix);
  SerialExecutor executor;
  StopAtOnce stop;
  BalanceReport report;
  EXPECT_EQ(balance(&matrix, patches.area, executor, &stop, &report).code(),
            StatusCode::kCancelled);
  EXPECT_EQ(report.iterations, 1u);
}

std::atomic<int> allocations_left{0};

void* allocate(std::size_t bytes) {
  return allocations_left-- > 0 ? std::aligned_alloc(64, (bytes + 63) / 64 * 64) : nullptr;
}

// Catches: a failed allocation that is not reported, or leaves something half made.
TEST(Balance, OutOfMemoryIsAStatus) {
  const Patches patches = random_patches(13, 80, 0.5, 0.3, false);
  int failures = 0;
  for (bool done = false; !done; ++failures) {
    ASSERT_LT(failures, 1000);
    allocations_left = 1000000;
    // Everything is made and released under this allocator.
    set_allocator({allocate, [](void* memory, std::size_t) { std::free(memory); }});
    {
      FormFactorMatrix matrix;
      patches.fill(&matrix);
      SerialExecutor executor;
      BalanceReport report;
      allocations_left = failures;
      const Status status = balance(&matrix, patches.area, executor, nullptr, &report);
      done = status.ok();
      EXPECT_TRUE(done || status.code() == StatusCode::kOutOfMemory) << status.message();
    }
  }
  EXPECT_GT(failures, 10);
  allocations_left = std::numeric_limits<int>::max(); // for what other tests do under it
}

// Catches: pairs counted twice or not at all, and rows read as columns of the wrong tile.
TEST(MeasureReciprocity, IsThatOfAllPairs) {
  for (const Kind& kind : kKinds) {
    const Patches p = random_patches(17, kind.n, kind.density, 0.3, kind.open);
    FormFactorMatrix matrix;
    p.fill(&matrix);
    double squares = 0, all = 0, max = 0;
    for (std::size_t i = 0; i < kind.n; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double a = p.area[i] * p.f[i][j], b = p.area[j] * p.f[j][i];
        squares += (a - b) * (a - b);
        all += std::max(a, b) * std::max(a, b);
        max = std::max(max, std::fabs(a - b) / std::min(p.area[i], p.area[j]));
      }
    SerialExecutor executor;
    Reciprocity got;
    ASSERT_TRUE(measure_reciprocity(matrix, p.area, executor, &got).ok());
    EXPECT_NEAR(got.rms, std::sqrt(squares / all), 1e-6) << kind.n;
    EXPECT_NEAR(got.max, max, 1e-6) << kind.n;
  }
}

} // namespace
} // namespace hemicube::radiosity
