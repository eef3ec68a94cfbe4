// Progressive refinement without a matrix: by rows given to it, and on scenes.
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/radiosity.h"
#include "radiosity/solve/gauss_seidel.h"
#include "radiosity/solve/row_shooter.h"
#include "tests/support/memory_file.h"
#include "tests/support/solved.h"
#include "tests/unit/solver_systems.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Shoots the brightest until so much is unshot.
void shoot(const System& system, double share, std::uint64_t max_shots, RowShooter* shooter) {
  FormFactorMatrix matrix;
  system.fill(&matrix);
  for (std::uint64_t shots = 0; shooter->unshot().share() > share && shots < max_shots; ++shots) {
    std::uint32_t brightest;
    ASSERT_EQ(shooter->unshot().choose({&brightest, 1}), 1u);
    shooter->shoot(brightest, matrix.row(brightest));
    shooter->unshot().survey();
  }
}

std::vector<double> spaces(const System& system) {
  FormFactorMatrix matrix;
  system.fill(&matrix);
  std::vector<double> space;
  for (std::uint64_t i = 0; i < matrix.row_count(); ++i)
    space.push_back(matrix.row(i).space);
  return space;
}

/// Expects that what was emitted is somewhere.
void expect_conserved(RowShooter* shooter, std::uint32_t bands) {
  for (std::uint32_t b = 0; b < bands; ++b) {
    const ShotPower& power = shooter->power(b);
    EXPECT_NEAR(power.absorbed + power.escaped + power.back_side + power.cut +
                    shooter->unshot_power(b),
                shooter->emitted(b), 1e-12 * shooter->emitted(b))
        << "band " << b;
  }
}

// Catches: light lost or made on the way, space or black patches left out, a bound too small.
TEST(RowShooter, ConservesPowerAndComesToTheSolution) {
  const System s = random_room(200, 3);
  const LightProblem problem = s.problem();
  FormFactorMatrix matrix;
  s.fill(&matrix);
  SerialExecutor executor;
  Buffer<double> b, h;
  Convergence convergence;
  SolverOptions options;
  options.tolerance = 1e-13;
  ASSERT_TRUE(gauss_seidel(matrix, problem, options, executor, nullptr, &b, &h, &convergence).ok());
  for (const double share : {0.3, 0.01, 1e-7}) {
    RowShooter shooter;
    const std::vector<double> space = spaces(s);
    ASSERT_TRUE(shooter.init(problem, space).ok());
    shoot(s, share, 100000, &shooter);
    expect_conserved(&shooter, 3);
    for (std::uint32_t band = 0; band < 3; ++band) {
      double error = 0, total = 0;
      for (std::size_t i = 0; i < 200; ++i) {
        const std::size_t at = i * 3 + band;
        error += s.area[i] * std::fabs(shooter.radiosity()[at] - b[at]);
        total += s.area[i] * shooter.radiosity()[at];
      }
      EXPECT_LE(error / total, shooter.bound() + 1e-6) << share; // rows are floats
    }
  }
}

// Catches: a patch that receives more than reaches it.
TEST(RowShooter, WhatAPatchCannotReceiveIsCounted) {
  System s = equal_room(2, 0.5, 1);
  s.area = {0.997, 0.412};
  RowShooter shooter;
  const LightProblem problem = s.problem();
  ASSERT_TRUE(shooter.init(problem, {}).ok());
  shoot(s, 0, 1, &shooter);
  EXPECT_LE(shooter.irradiance()[1], 1.25);
  EXPECT_GT(shooter.power(0).cut, 0.5);
  expect_conserved(&shooter, 1);
}

// Catches: what the last run left behind.
TEST(RowShooter, BeginsAnew) {
  const System s = random_room(50, 2);
  const LightProblem problem = s.problem();
  const std::vector<double> space = spaces(s);
  RowShooter first, again;
  ASSERT_TRUE(again.init(problem, space).ok());
  shoot(s, 0.1, 1000, &again);
  for (RowShooter* shooter : {&first, &again}) {
    ASSERT_TRUE(shooter->init(problem, space).ok());
    shoot(s, 0.01, 1000, shooter);
    expect_conserved(shooter, 2);
  }
  EXPECT_TRUE(test::same_bits(again.radiosity().span(), first.radiosity().span()));
}

class ShootScene : public ::testing::Test {
protected:
  static Options options() {
    Options options;
    options.rung = Rung::kArea;
    options.resolution = 32;
    options.tolerance = 1e-10;
    options.solver = SolverKind::kProgressive;
    options.stop_unshot = 1e-6;
    return options;
  }
};

// Catches: rows chosen by the number of workers.
TEST_F(ShootScene, ThreadsGiveTheSameBits) {
  const Scene scene = test::cornell_like(4);
  const test::Solved first = test::solve(scene, options(), 1);
  EXPECT_TRUE(first.certificate.converged);
  EXPECT_LE(first.certificate.unshot, 1e-6);
  for (const std::uint32_t threads : {2u, 3u, 7u}) {
    const test::Solved got = test::solve(scene, options(), threads);
    EXPECT_TRUE(test::same_bits(got.solution.radiosity.span(), first.solution.radiosity.span()));
    EXPECT_EQ(got.certificate.shots, first.certificate.shots);
  }
}

// On rung area form factors between whole patches are exact where nothing is in between: rows and
// columns say the same.
TEST_F(ShootScene, AgreesWithGaussSeidelWhereFormFactorsAreReciprocal) {
  for (const bool keeps : {false, true}) {
    Options shooting = options(), sweeping = options();
    test::MemoryFile file;
    RunFiles files;
    files.rows = &file;
    files.keeps_black_rows = true;
    shooting.files = keeps ? &files : nullptr;
    shooting.stop_unshot = keeps ? 0 : 1e-8;
    sweeping.solver = SolverKind::kGaussSeidel;
    const test::Solved got = test::solve(test::t_vertex_room(), shooting);
    const test::Solved want = test::solve(test::t_vertex_room(), sweeping);
    EXPECT_EQ(got.certificate.has_residual, keeps);
    for (std::size_t at = 0; at < want.solution.radiosity.size(); ++at)
      ASSERT_NEAR(got.solution.radiosity[at], want.solution.radiosity[at],
                  (keeps ? 1e-8 : 1e-3) * want.solution.radiosity[at])
          << keeps;
  }
}

TEST_F(ShootScene, EnergyIsConserved) {
  const test::Solved got = test::solve(test::cornell_like(4), options());
  ASSERT_FALSE(got.certificate.energy.empty());
  for (const EnergyBalance& energy : got.certificate.energy) {
    EXPECT_GT(energy.escaped, 0);
    EXPECT_LE(std::fabs(energy.imbalance), 1e-12);
  }
}

TEST_F(ShootScene, AClosedWhiteRoomIsRefused) {
  const Scene scene = test::furnace_cube(2, 1, 1);
  const PatchSet patches = test::patches_of(scene);
  SerialExecutor executor;
  Solution solution;
  Certificate certificate;
  EXPECT_EQ(
      solve_scene(scene, patches, options(), executor, nullptr, &solution, &certificate).code(),
      StatusCode::kSingular);
}

TEST_F(ShootScene, WithoutAShotThereIsWhatIsEmitted) {
  Options none = options();
  none.max_shots = 0;
  const Scene scene = test::cornell_like(4);
  SerialExecutor executor;
  Solution solution;
  Certificate certificate;
  EXPECT_EQ(
      solve_scene(scene, test::patches_of(scene), none, executor, nullptr, &solution, &certificate)
          .code(),
      StatusCode::kNotConverged);
  EXPECT_TRUE(test::same_bits(solution.radiosity.span(), solution.exitance.span()));
  EXPECT_GT(solution.ambient.size(), 0u);
  EXPECT_EQ(certificate.unshot, 1);
}

} // namespace
} // namespace hemicube::radiosity
