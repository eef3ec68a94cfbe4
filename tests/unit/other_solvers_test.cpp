// Jacobi and progressive refinement on a stored matrix, judged by Gauss-Seidel.
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/solve/gauss_seidel.h"
#include "radiosity/solve/jacobi.h"
#include "radiosity/solve/progressive.h"
#include "tests/unit/solver_systems.h"

#include <cmath>
#include <limits>

namespace hemicube::radiosity {
namespace {

struct Outcome {
  Status status;
  Buffer<double> b, h;
  Convergence convergence;
};
using Solver = decltype(gauss_seidel)*;

void solve(Solver solver, const System& system, const SolverOptions& options, Outcome* outcome,
           std::uint32_t threads = 1) {
  FormFactorMatrix matrix;
  system.fill(&matrix);
  ThreadPool pool;
  ASSERT_TRUE(pool.init(threads).ok());
  outcome->status = solver(matrix, system.problem(), options, pool, nullptr, &outcome->b,
                           &outcome->h, &outcome->convergence);
}

SolverOptions to_tolerance(double tolerance) {
  SolverOptions options;
  options.tolerance = tolerance;
  return options;
}

class OtherSolvers : public ::testing::TestWithParam<Solver> {};

TEST_P(OtherSolvers, AgreeWithGaussSeidel) {
  for (const System& s :
       {random_room(300, 3), random_room(40, 1), equal_room(60, 0.97, 2), equal_room(2, 0.5, 1)}) {
    Outcome want, got;
    solve(gauss_seidel, s, to_tolerance(1e-13), &want);
    solve(GetParam(), s, to_tolerance(1e-10), &got);
    ASSERT_TRUE(got.status.ok()) << got.status.message();
    EXPECT_TRUE(got.convergence.converged);
    double brightest = 0;
    for (const double b : want.b)
      brightest = std::max(brightest, b);
    for (std::size_t at = 0; at < want.b.size(); ++at) {
      ASSERT_NEAR(got.b[at], want.b[at], 1e-9 * brightest);
      ASSERT_NEAR(got.h[at], want.h[at], 1e-9 * brightest);
    }
  }
}

TEST_P(OtherSolvers, ThreadsGiveTheSameBits) {
  const System s = random_room(600, 3);
  Outcome first;
  solve(GetParam(), s, to_tolerance(1e-4), &first);
  for (const std::uint32_t threads : {2u, 3u, 7u}) {
    Outcome got;
    solve(GetParam(), s, to_tolerance(1e-4), &got, threads);
    EXPECT_TRUE(same_bits(got.b, first.b)) << threads << " threads";
    EXPECT_EQ(got.convergence.shots, first.convergence.shots);
  }
}

TEST_P(OtherSolvers, RefuseWhatHasNoSolution) {
  Outcome got;
  solve(GetParam(), equal_room(5, 1, 1), to_tolerance(1e-6), &got);
  EXPECT_EQ(got.status.code(), StatusCode::kSingular);
  solve(GetParam(), equal_room(5, 0.5, 1), to_tolerance(0), &got);
  EXPECT_EQ(got.status.code(), StatusCode::kInvalidArgument);
}

TEST_P(OtherSolvers, LeaveTheDarkDark) {
  Outcome got;
  solve(GetParam(), equal_room(5, 1, 0), to_tolerance(1e-6), &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  for (const double b : got.b)
    EXPECT_EQ(b, 0);
}

INSTANTIATE_TEST_SUITE_P(Solvers, OtherSolvers, ::testing::Values(&jacobi, &progressive),
                         [](const auto& test) {
                           return test.param == &jacobi ? "jacobi" : "progressive";
                         });

TEST(Jacobi, TakesMoreSweepsThanGaussSeidel) {
  Outcome gs, j;
  solve(gauss_seidel, equal_room(60, 0.9, 1), to_tolerance(1e-10), &gs);
  solve(jacobi, equal_room(60, 0.9, 1), to_tolerance(1e-10), &j);
  EXPECT_GT(j.convergence.sweeps, gs.convergence.sweeps);
}

TEST(Progressive, NearlyWhiteRoomIsSolved) {
  Outcome got;
  solve(progressive, equal_room(24, 0.999999, 1), to_tolerance(1e-7), &got);
  ASSERT_TRUE(got.status.ok()) << got.status.message();
  double power = 0;
  for (std::size_t i = 0; i < 24; ++i)
    power += (1 - 0.999999) * got.h[i];
  EXPECT_NEAR(power, 1, 1e-7);
}

// Catches: a bound that forgets how often unshot light will still be reflected.
TEST(Progressive, UnshotLightBoundsTheError) {
  const System s = random_room(200, 3);
  Outcome truth;
  solve(gauss_seidel, s, to_tolerance(1e-13), &truth);
  for (const double share : {0.5, 0.1, 0.01, 1e-4}) {
    SolverOptions options;
    options.stop_unshot = share;
    Outcome got;
    solve(progressive, s, options, &got);
    ASSERT_TRUE(got.status.ok()) << got.status.message();
    EXPECT_LE(got.convergence.unshot, share);
    double worst = 0;
    for (std::size_t b = 0; b < 3; ++b) {
      double error = 0, total = 0;
      for (std::size_t i = 0; i < 200; ++i) {
        error += s.area[i] * std::fabs(got.b[i * 3 + b] - truth.b[i * 3 + b]);
        total += s.area[i] * got.b[i * 3 + b];
      }
      worst = std::max(worst, error / total);
    }
    EXPECT_LE(worst, got.convergence.unshot_bound) << share;
    EXPECT_GT(worst, 0.001 * got.convergence.unshot_bound) << "a bound of no use";
  }
}

TEST(Progressive, StopsAfterSoManyShots) {
  for (const std::uint64_t shots : {0, 1, 7}) {
    SolverOptions options;
    options.max_shots = shots;
    Outcome got;
    solve(progressive, equal_room(30, 0.9, 1), options, &got);
    EXPECT_EQ(got.status.code(), StatusCode::kNotConverged);
    EXPECT_EQ(got.convergence.shots, shots);
    ASSERT_EQ(got.b.size(), 30u);
    EXPECT_GE(got.b[0], 1);
  }
}

TEST(Progressive, RefusesAShare) {
  for (const double share : {-0.1, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    SolverOptions options;
    options.stop_unshot = share;
    Outcome got;
    solve(progressive, equal_room(3, 0.5, 1), options, &got);
    EXPECT_EQ(got.status.code(), StatusCode::kInvalidArgument);
  }
}

} // namespace
} // namespace hemicube::radiosity
