#pragma once

#include "radiosity/radiosity.h"

#include <ostream>

/// The rungs of the accuracy ladder as tests ask for them.
namespace hemicube::test {

struct LadderLevel {
  const char* name;
  radiosity::Rung rung;
  double error;

  radiosity::Options options(std::uint32_t resolution = 256) const {
    radiosity::Options options;
    options.rung = rung;
    options.error = error;
    options.resolution = resolution;
    return options;
  }
};
inline void PrintTo(const LadderLevel& level, std::ostream* out) { // for the names of tests
  *out << level.name;
}

inline constexpr LadderLevel kHemicubeRung = {"hemicube", radiosity::Rung::kHemicube, 0.01};
inline constexpr LadderLevel kAnalyticRung = {"analytic", radiosity::Rung::kAnalytic, 0.01};
inline constexpr LadderLevel kAreaRung = {"area", radiosity::Rung::kArea, 0.01};
inline constexpr LadderLevel kLooseRung = {"adaptive at 0.3", radiosity::Rung::kAdaptive, 0.3};
inline constexpr LadderLevel kAdaptiveRung = {"adaptive at 0.01", radiosity::Rung::kAdaptive, 0.01};
inline constexpr LadderLevel kTightRung = {"adaptive at 0.001", radiosity::Rung::kAdaptive, 0.001};
inline constexpr LadderLevel kExactRung = {"exact", radiosity::Rung::kExact, 0.01};

} // namespace hemicube::test
