#pragma once

#include "radiosity/cli/verify_scene.h"
#include "radiosity/radiosity.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace hemicube::radiosity::cli {

/// What is looked at in a case.
enum class VerifyKind {
  kPatchToPatch, ///< the form factor from patch 0 to patch 1
  kPointToPatch, ///< the form factor from a point to patch 0
  kRadiosity,    ///< the radiosity of the patch that is farthest from the exact one
  kImbalance,    ///< the certificate's energy.imbalance
  kSharedPower   ///< sum A_i F_ij over i of material 0 and j of material 1, over their area A_j
};

inline constexpr std::size_t kRungCount = 5;

/// For a rung that promises nothing of a case.
inline constexpr double kNoPromise = std::numeric_limits<double>::infinity();

/// A scene with one number that is known exactly.
struct VerifyCase {
  std::string name;
  VerifyKind kind = VerifyKind::kPatchToPatch;
  double exact = 0;
  /// [rung] largest relative error, absolute if the exact value is 0, at resolution 256 and with
  /// the target kVerifyError.
  std::array<double, kRungCount> bounds;
  VerifyScene scene;
  Receiver point{}; ///< of kPointToPatch
};

/// What rung adaptive is asked for, unless --error says otherwise.
inline constexpr double kVerifyError = 1e-3;

using Bounds = std::array<double, kRungCount>; ///< hemicube, analytic, area, adaptive, exact
/// Nothing is seen by any rung.
inline constexpr Bounds kHidden = {0, 0, 0, 0, 0};

using Polygon = std::vector<Vec3>;

Polygon rectangle(double width, double depth);

/// The rectangle above it that looks down.
Polygon ceiling(double width, double depth, double height);

Polygon turned_round(const Polygon& polygon);

/// @param blockers  hide from both sides
VerifyCase pair(const char* name, double exact, const Bounds& bounds, const Polygon& from,
                const Polygon& to, const std::vector<Polygon>& blockers = {});

/// From a point that looks up.
VerifyCase point(const char* name, double exact, const Bounds& bounds, const Vec3& position,
                 const Polygon& to);

} // namespace hemicube::radiosity::cli
