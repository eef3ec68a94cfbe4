#pragma once

#include "tests/support/scenes_shared.h"

/// A floor [0,4]^2 at z = 0 under a square lamp [1.5,2.5]^2 at z = 2.2, and between them, at z = 1,
/// a half-plane x <= 1.8 that throws a shadow; everything but the floor reflects nothing. Its
/// irradiance is known everywhere.
namespace hemicube::test {

inline constexpr double kHalfPlaneEdge = 1.8, kHalfPlaneHeight = 1, kHalfPlaneLamp = 2.2;
inline constexpr double kHalfPlaneExitance = 100, kHalfPlaneReflectance = 0.5;

/// One band. @param cells  of the floor, along each side
Scene half_plane_shadow(int cells);

/// Radiosity of a point of the floor, W/m^2: what it sees of the lamp is the part beyond the plane
/// through the point and the edge of the half-plane, a polygon, for which Lambert's formula holds.
double half_plane_radiosity(double x, double y);

/// How far light on the floor, as it is drawn, is from what it should be: at the middles of the
/// cells of a grid of 200 x 200.
struct ShadowError {
  double rms = 0;     ///< relative to the RMS of what it should be
  double largest = 0; ///< W/m^2
};
/// @param radiosity  [patch of elements]
ShadowError half_plane_error(const PatchSet& elements, std::span<const double> radiosity);

} // namespace hemicube::test
