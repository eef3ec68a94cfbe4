#pragma once

#include "tests/support/form_factor_cases.h"
#include "tests/support/ladder_levels.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

/// The lines of README.md as tests: each figure is held to the bound of its line.
namespace hemicube::test {

/// The bounds are for this resolution, unless a line says otherwise.
inline constexpr std::uint32_t kHardResolution = 512;

inline constexpr LadderLevel kAllRungs[] = {kHemicubeRung, kAnalyticRung, kAreaRung, kAdaptiveRung,
                                            kExactRung};
/// Those that know of the areas of patches.
inline constexpr LadderLevel kAreaRungs[] = {kAreaRung, kAdaptiveRung, kExactRung};

/// Expects a figure within its bound, and prints both if HEMICUBE_HARD_CASES is set: the rows of
/// README.md.
inline void expect_within(const std::string& what, double got, double bound) {
  if (std::getenv("HEMICUBE_HARD_CASES") != nullptr)
    std::printf("| %s | %s | %.1e | %.1e |\n",
                testing::UnitTest::GetInstance()->current_test_info()->name(), what.c_str(), bound,
                got);
  EXPECT_LE(got, bound) << what;
}

/// F12 and F21 of a case of formfactors.json, as they are and as they should be.
struct PairOfFactors {
  double got[2], exact[2];

  double absolute() const {
    return std::max(std::fabs(got[0] - exact[0]), std::fabs(got[1] - exact[1]));
  }
  double relative() const {
    return std::max(std::fabs(got[0] / exact[0] - 1), std::fabs(got[1] / exact[1] - 1));
  }
};
inline PairOfFactors pair_of(const std::string& name, const LadderLevel& level,
                             std::uint32_t resolution = kHardResolution) {
  const nlohmann::json one = reference_case("formfactors.json", name);
  FormFactors factors;
  compute_all(CasePatches(one).patches, level.options(resolution), 1, &factors);
  return {{entry(factors.matrix.row(0), 1), entry(factors.matrix.row(1), 0)},
          {one["F12"], one["F21"]}};
}

} // namespace hemicube::test
