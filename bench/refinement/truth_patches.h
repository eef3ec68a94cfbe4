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

private:
  radiosity::PatchSet patches_;
  nlohmann::json truth_;
};

} // namespace hemicube::bench
