#pragma once

#include "radiosity/mesh/patch_set.h"

#include <nlohmann/json.hpp>

#include <span>
#include <vector>

namespace hemicube::bench {

/// Patches whose radiosity is known, to compare any other mesh of the same surfaces with.
class TruthPatches {
public:
  /// @param truth  [patch][band]
  TruthPatches(radiosity::PatchSet patches, nlohmann::json truth)
      : patches_(std::move(patches)), truth_(std::move(truth)) {}

  /// The RMS error over its RMS, area-weighted, worst band, of elements averaged to these patches
  /// by the area they have in common.
  /// @param radiosity  [element][band]
  double error(const radiosity::PatchSet& elements, std::span<const double> radiosity,
               std::size_t bands) const;

  /// The same of light on the floor as it is drawn: its means over these patches, by 4 x 4 points
  /// each. @param up  the axis that is 0 on the floor
  double drawn_error(const radiosity::PatchSet& elements, std::span<const double> radiosity,
                     std::size_t bands, int up) const;

private:
  struct Errors;
  radiosity::PatchSet patches_;
  nlohmann::json truth_;
};

} // namespace hemicube::bench
