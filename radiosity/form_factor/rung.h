#pragma once

#include <cstdint>

namespace hemicube::radiosity {

/// How exact form factors are: each rung takes over what the one before it finds, but for pairs it
/// knows better.
enum class Rung : std::uint8_t {
  kHemicube, ///< one item buffer at the patch's centre
  kAnalytic, ///< what the centre provably sees whole by Lambert's formula
  kArea,     ///< what the whole patch provably sees whole by integrals over both areas
  kAdaptive, ///< partial visibility integrated over the patch until the target is met
  kExact     ///< the same to 1e-6, for small scenes and as the oracle of the others
};

/// A rung and what it leaves open.
struct RungSetting {
  Rung rung = Rung::kHemicube;
  std::uint32_t resolution = 256; ///< of the item buffer
  double target = 0.01;           ///< of rung adaptive: relative error of partly visible pairs
};

/// "hemicube", "analytic", ...
const char* rung_name(Rung rung) noexcept;

} // namespace hemicube::radiosity
