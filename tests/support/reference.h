#pragma once

#include "radiosity/scene/scene.h"
#include "tests/support/npy.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// The data of tests/reference.
namespace hemicube::test {

/// Reads a JSON file; throws if it cannot. @param name  relative to tests/reference
nlohmann::json reference_json(const std::string& name);

/// Reads a scene through the program's own reader; throws with its message on any error.
radiosity::Scene reference_scene(const std::string& name);

/// Reads a matrix of form factors: row i, column j is F_ij. Throws if it cannot.
SquareMatrix reference_matrix(const std::string& name);

/// The case of enclosures.json or formfactors.json with this name.
nlohmann::json reference_case(const std::string& file, const std::string& name);

/// An array of [x, y, z].
std::vector<Vec3> points_of(const nlohmann::json& value);
Vec3 point_of(const nlohmann::json& value);

/// How far a [patch][band] table of values is from the true one.
struct Deviation {
  double rms = 0;     ///< root of the mean over patches of the squared relative error, worst band
  double largest = 0; ///< largest relative error
  std::uint32_t worst_patch = 0;
  double area_rms = 0; ///< sqrt(sum A (b - t)^2 / sum A t^2), worst band
};
Deviation deviation(std::span<const double> actual, const nlohmann::json& truth,
                    std::span<const double> area);

} // namespace hemicube::test
