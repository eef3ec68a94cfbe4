#include "radiosity/parallel/executor.h"
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/solve/gauss_seidel.h"
#include "raster/simd/dispatch.h"
#include "tests/unit/solver_systems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace hemicube::radiosity {
namespace {

struct Outcome {
  Status status;
  Buffer<double> b, h;
  Convergence convergence;
};

void solve(const System& system, Outcome* outcome, double tolerance = 1e-12,
           std::uint64_t max_sweeps = 100000) {
  FormFactorMatrix matrix;
  system.fill(&matrix);
  SerialExecutor executor;
  outcome->status = gauss_seidel(matrix, system.problem(), {tolerance, max_sweeps}, executor,
                                 nullptr, &outcome->b, &outcome->h, &outcome->convergence);
}

TEST(GaussSeidel, AgreesWithDenseElimination) {
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  System s;
  const std::size_t n = 300; // more than one sweep block
  s.bands = 2;
  s.space_exitance = {0.3, 0};
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> row(n);
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j)
      sum += row[j] = i == j || uniform() < 0.5 ? 0 : uniform();
    for (double& x : row)
      x = static_cast<double>(static_cast<float>(x * 0.9 / sum));
    s.f.push_back(row);
    s.area.push_back(0.5 + uniform());
    for (std::uint32_t b = 0; b < 2; ++b) {
      s.reflectance.push_back(i % 7 == 0 ? 0 : uniform());
      s.exitance.push_back(uniform() < 0.2 ? uniform() : 0);
    }
  }
  Outcome got;
  solve(s, &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  // B = E + rho (F B + s E_space) by elimination with partial pivoting, one band at a time.
  for (std::uint32_t band = 0; band < 2; ++band) {
    std::vector<std::vector<long double>> a(n, std::vector<long double>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
      const long double rho = s.reflectance[i * 2 + band];
      long double sum = 0;
      for (std::size_t j = 0; j < n; ++j) {
        a[i][j] = (i == j ? 1 : 0) - rho * s.f[i][j];
        sum += s.f[i][j];
      }
      a[i][n] = s.exitance[i * 2 + band] + rho * (1 - sum) * s.space_exitance[band];
    }
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k; i < n; ++i)
        if (std::fabs(a[i][k]) > std::fabs(a[pivot][k]))
          pivot = i;
      std::swap(a[k], a[pivot]);
      for (std::size_t i = k + 1; i < n; ++i) {
        const long double factor = a[i][k] / a[k][k];
        for (std::size_t j = k; j <= n; ++j)
          a[i][j] -= factor * a[k][j];
      }
    }
    std::vector<long double> b(n);
    for (std::size_t i = n; i-- > 0;) {
      b[i] = a[i][n];
      for (std::size_t j = i + 1; j < n; ++j)
        b[i] -= a[i][j] * b[j];
      b[i] /= a[i][i];
    }
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_NEAR(got.b[i * 2 + band], static_cast<double>(b[i]),
                  1e-10 * (1 + std::fabs(static_cast<double>(b[i]))))
          << "patch " << i << " band " << band;
  }
}

TEST(GaussSeidel, ReportsTheErrorItHas) {
  const System s = equal_room(40, 0.9, 1);
  Outcome got, exact;
  solve(s, &got, 1e-3);
  solve(s, &exact, 1e-14);
  ASSERT_TRUE(got.status.ok());
  double brightest = 0, error = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    brightest = std::max(brightest, got.b[i]);
    error = std::max(error, std::fabs(got.b[i] - exact.b[i]));
  }
  EXPECT_LE(error / brightest, got.convergence.estimated_error);
  EXPECT_LE(got.convergence.estimated_error, 1e-3);
}

// Catches: a residual that is 0 because the last bit of what is reflected is not known, and an
// error of 0 although 1 / (1 - rho) makes that bit 1e-7 of the light.
TEST(GaussSeidel, ReportsWhatRoundingHides) {
  for (std::size_t n = 2; n < 40; ++n) {
    const double rho = 1 - 0x1p-30;
    const System s = equal_room(n, rho, 1);
    FormFactorMatrix matrix;
    s.fill(&matrix);
    Outcome got;
    solve(s, &got, 1e-7);
    ASSERT_TRUE(got.status.ok()) << got.status.message();
    // All entries are f: the sum of B is 1 / (1 - (n - 1) rho f).
    const RowView row = matrix.row(0);
    const long double f = static_cast<long double>(row.scale) * row.values[0];
    const long double sum = 1 / (1 - static_cast<long double>(n - 1) * rho * f);
    for (std::size_t i = 0; i < n; ++i) {
      const long double b = ((i == 0 ? 1 : 0) + rho * f * sum) / (1 + rho * f);
      EXPECT_LE(std::fabs(got.b[i] - b), got.convergence.estimated_error * got.b[0])
          << n << " patches";
    }
  }
}

TEST(GaussSeidel, NearlyWhiteRoomNeedsFewSweeps) {
  // Plain sweeps need of the order of 1e7 here.
  const System s = equal_room(24, 0.999999, 1);
  Outcome got;
  solve(s, &got, 1e-7, 1000);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  double power = 0;
  for (std::size_t i = 0; i < 24; ++i)
    power += (1 - 0.999999) * got.h[i];
  EXPECT_NEAR(power, 1, 1e-7);
}

TEST(GaussSeidel, ClosedWhiteRoomWithLightIsSingular) {
  Outcome got;
  solve(equal_room(5, 1, 1), &got);
  EXPECT_EQ(got.status.code(), StatusCode::kSingular);
  EXPECT_NE(got.status.message().find("patch 0"), std::string_view::npos) << got.status.message();
}

TEST(GaussSeidel, ClosedWhiteRoomWithoutLightIsDark) {
  Outcome got;
  solve(equal_room(5, 1, 0), &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(got.b[i], 0);
  EXPECT_EQ(got.convergence.sweeps, 0u);
}

TEST(GaussSeidel, WhiteRoomWithABlackPatchHasASolution) {
  System s = equal_room(5, 1, 0);
  s.exitance[0] = 1;
  s.reflectance[4] = 0;
  Outcome got;
  solve(s, &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  double received = 0; // all light ends on the one patch that absorbs
  for (std::size_t j = 0; j < 4; ++j)
    received += got.b[j] / 4;
  EXPECT_NEAR(received, 1, 1e-11);
}

TEST(GaussSeidel, WhiteOpenSceneConvergesToTheRoundingFloor) {
  System s = equal_room(40, 1, 1);
  for (std::size_t i = 0; i < 40; ++i) // uneven, or the residual is exactly 0
    for (std::size_t j = 0; j < 40; ++j)
      s.f[i][j] *= (i == 0 ? 0.3 : 0.9) + 0.01 * static_cast<double>((7 * i + 3 * j) % 11);
  for (std::size_t i = 1; i < 40; ++i) // closed, but for patch 0
    s.f[i][0] += 1 - std::accumulate(s.f[i].begin(), s.f[i].end(), 0.0);
  Outcome got;
  solve(s, &got, 1e-12);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  EXPECT_TRUE(got.convergence.converged);
  EXPECT_TRUE(got.convergence.rounding_floor);
  EXPECT_EQ(got.convergence.estimated_error, std::numeric_limits<double>::infinity());
}

TEST(GaussSeidel, GivesUpHonestly) {
  Outcome got;
  solve(equal_room(10, 0.99, 1), &got, 1e-12, 1);
  EXPECT_EQ(got.status.code(), StatusCode::kNotConverged);
  EXPECT_FALSE(got.convergence.converged);
  EXPECT_EQ(got.b.size(), 10u);
}

/// Rows and areas as given; what is missing to 1 is space.
System small_system(std::vector<std::vector<double>> f, std::vector<double> area,
                    std::vector<double> reflectance, std::vector<double> exitance) {
  System s;
  s.f = std::move(f);
  s.area = std::move(area);
  s.reflectance = std::move(reflectance);
  s.exitance = std::move(exitance);
  return s;
}

// Two facing plates of unequal area, each of whose centres sees the other alone: far from
// reciprocal, so that balancing powers by area drives the brightness up and down for ever.
TEST(GaussSeidel, UnreciprocalRowsConverge) {
  Outcome got;
  solve(small_system({{0, 1}, {1, 0}}, {0.997, 0.412}, {0.95, 0.95}, {1, 0}), &got, 1e-9, 2000);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  EXPECT_NEAR(got.b[0], 1 / (1 - 0.95 * 0.95), 1e-7);
  EXPECT_NEAR(got.b[1], 0.95 / (1 - 0.95 * 0.95), 1e-7);
}

TEST(GaussSeidel, RandomUnreciprocalSystemsConverge) {
  std::mt19937 random(11);
  const auto uniform = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
  for (int round = 0; round < 500; ++round) {
    const std::size_t n = 2 + random() % 8;
    System s;
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<double> row(n);
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j)
        sum += row[j] = i == j ? 0 : uniform() * uniform();
      for (double& f : row)
        f /= sum;
      s.f.push_back(row);
      const double a = uniform();
      s.area.push_back(0.001 + a * a * a);
      s.reflectance.push_back(0.95 * uniform());
      s.exitance.push_back(uniform());
    }
    Outcome got;
    solve(s, &got, 1e-9, 3000);
    ASSERT_TRUE(got.status.ok()) << "round " << round << ": " << got.status.message();
  }
}

// Patch 2 sees the white pair, but the pair does not see it: nothing takes their light away.
TEST(GaussSeidel, WhitePairSeenFromOutsideIsSingular) {
  Outcome got;
  solve(small_system({{0, 1, 0}, {1, 0, 0}, {0.5, 0, 0}}, {1, 1, 1}, {1, 1, 0.5}, {1, 0, 0}), &got);
  EXPECT_EQ(got.status.code(), StatusCode::kSingular) << got.b[0];
}

// The pair is white and closed, but dark; the bound on the error is that of the lit patches.
TEST(GaussSeidel, DarkWhiteEnclosureDoesNotVoidTheBound) {
  Outcome got;
  solve(small_system({{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}}, {1, 1, 1, 1},
                     {1, 1, 0.5, 0.25}, {0, 0, 1, 0}),
        &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  EXPECT_EQ(got.b[0], 0);
  EXPECT_NEAR(got.b[2], 1 / (1 - 0.125), 1e-10);
  EXPECT_LE(got.convergence.estimated_error, 1e-12);
}

TEST(GaussSeidel, LightBeyondTheRangeOfNumbersIsRefused) {
  Outcome got;
  solve(equal_room(4, 0.9, 1.7e308), &got);
  EXPECT_EQ(got.status.code(), StatusCode::kBadScene) << got.status.message();
}

TEST(GaussSeidel, BandsDoNotTouch) {
  System one = equal_room(12, 0.7, 2), two = one;
  two.bands = 2;
  two.space_exitance = {0, 0};
  two.reflectance.clear();
  two.exitance.clear();
  for (std::size_t i = 0; i < 12; ++i) {
    two.reflectance.insert(two.reflectance.end(), {one.reflectance[i], 0.2});
    two.exitance.insert(two.exitance.end(), {one.exitance[i], 0});
  }
  Outcome a, b;
  solve(one, &a);
  solve(two, &b);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(a.b[i], b.b[2 * i]);
    EXPECT_EQ(b.b[2 * i + 1], 0);
  }
}

TEST(GaussSeidel, RefusesATolerance) {
  for (const double tolerance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    Outcome got;
    solve(equal_room(3, 0.5, 1), &got, tolerance);
    EXPECT_EQ(got.status.code(), StatusCode::kInvalidArgument);
  }
}

// Catches: work that is shared out by the number of workers, and kernels that differ.
TEST(GaussSeidel, ThreadsAndInstructionSetsGiveTheSameBits) {
  const System s = random_room(900, 3);
  FormFactorMatrix matrix;
  s.fill(&matrix);
  Buffer<double> first_b, first_h;
  for (const char* isa : {"scalar", "sse41", "avx2", "avx512", "neon"})
    for (const std::uint32_t threads : {1u, 2u, 3u, 7u}) {
      SolverOptions options;
      options.kernels = raster::kernels_by_name(isa);
      if (options.kernels == nullptr)
        continue;
      ThreadPool pool;
      ASSERT_TRUE(pool.init(threads).ok());
      Outcome got;
      ASSERT_TRUE(gauss_seidel(matrix, s.problem(), options, pool, nullptr, &got.b, &got.h,
                               &got.convergence)
                      .ok());
      if (first_b.empty()) {
        first_b.swap(got.b);
        first_h.swap(got.h);
        continue;
      }
      EXPECT_TRUE(same_bits(got.b, first_b)) << isa << ", " << threads << " threads";
      EXPECT_TRUE(same_bits(got.h, first_h)) << isa << ", " << threads << " threads";
    }
}

class StopAtOnce final : public SolverProgress {
public:
  bool swept(std::uint64_t, double) noexcept override { return false; }
};

TEST(GaussSeidel, CanBeStopped) {
  const System s = equal_room(50, 0.99, 1);
  FormFactorMatrix matrix;
  s.fill(&matrix);
  SerialExecutor executor;
  StopAtOnce stop;
  Buffer<double> b, h;
  Convergence convergence;
  EXPECT_EQ(gauss_seidel(matrix, s.problem(), {1e-12, 1000}, executor, &stop, &b, &h, &convergence)
                .code(),
            StatusCode::kCancelled);
}

} // namespace
} // namespace hemicube::radiosity
