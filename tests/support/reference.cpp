#include "tests/support/reference.h"

#include "radiosity/scene/read_scene.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace hemicube::test {

namespace {

std::string path_of(const std::string& name) {
  return HC_SOURCE_DIR "/tests/reference/" + name;
}

} // namespace

nlohmann::json reference_json(const std::string& name) {
  std::ifstream file(path_of(name));
  if (!file)
    throw std::runtime_error("cannot read " + path_of(name));
  return nlohmann::json::parse(file);
}

radiosity::Scene reference_scene(const std::string& name) {
  radiosity::Scene scene;
  radiosity::ReadReport report;
  require(radiosity::read_scene(path_of(name), &scene, &report));
  return scene;
}

SquareMatrix reference_matrix(const std::string& name) {
  return read_npy(path_of(name));
}

nlohmann::json reference_case(const std::string& file, const std::string& name) {
  const nlohmann::json all = reference_json(file);
  for (const nlohmann::json& one : all["cases"])
    if (one["name"] == name)
      return one;
  throw std::runtime_error(file + " has no case " + name);
}

Vec3 point_of(const nlohmann::json& value) {
  return {value[0], value[1], value[2]};
}

std::vector<Vec3> points_of(const nlohmann::json& value) {
  std::vector<Vec3> points;
  for (const nlohmann::json& point : value)
    points.push_back(point_of(point));
  return points;
}

Deviation deviation(std::span<const double> actual, const nlohmann::json& truth,
                    std::span<const double> area) {
  Deviation result;
  const std::size_t bands = truth[0].size();
  if (actual.size() != truth.size() * bands || area.size() != truth.size())
    throw std::runtime_error("the truth is for another number of patches or bands");
  for (std::size_t band = 0; band < bands; ++band) {
    double squares = 0, weighted = 0, total = 0;
    for (std::size_t patch = 0; patch < truth.size(); ++patch) {
      const double expected = truth[patch][band];
      const double difference = actual[patch * bands + band] - expected;
      const double relative = expected != 0 ? std::fabs(difference / expected) : 0;
      squares += relative * relative;
      weighted += area[patch] * difference * difference;
      total += area[patch] * expected * expected;
      if (relative > result.largest) {
        result.largest = relative;
        result.worst_patch = static_cast<std::uint32_t>(patch);
      }
    }
    result.rms = std::max(result.rms, std::sqrt(squares / static_cast<double>(truth.size())));
    result.area_rms = std::max(result.area_rms, total > 0 ? std::sqrt(weighted / total) : 0.0);
  }
  return result;
}

} // namespace hemicube::test
