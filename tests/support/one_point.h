#pragma once

#include "radiosity/mesh/patch_set.h"
#include "tests/support/scenes_shared.h"

#include <vector>

/// What a hemicube of infinite resolution would give: exact form factors from the centre of each
/// patch. The difference to area form factors is the proximity error that one hemicube a patch
/// makes, and the difference of a program's result to this is its aliasing alone.
namespace hemicube::test {

std::vector<Vec3> corners_of(const PatchSet& patches, std::uint32_t patch);

/// Row-major n x n; for scenes in which nothing stands between two patches (convex enclosures).
std::vector<double> one_point_form_factors(const PatchSet& patches);

/// Solves B = E + rho F B for a dense F to rounding. @return [patch][band]
std::vector<double> solve_dense(const Scene& scene, const PatchSet& patches,
                                const std::vector<double>& form_factors);

/// sqrt(sum A (a - b)^2 / sum A b^2) of [patch][band] tables, worst band.
double area_rms(const PatchSet& patches, std::span<const double> a, std::span<const double> b);

/// max |a - b| / b over all entries with b > 0.
double largest_relative(std::span<const double> a, std::span<const double> b);

} // namespace hemicube::test
