#pragma once

#include "radiosity/adaptive.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

namespace hemicube::test {

using radiosity::Options;
using radiosity::Refinement;
using radiosity::RefinementEnd;
using radiosity::Rung;

struct Adapted {
  PatchSet patches, elements;
  radiosity::ElementTree tree;
  radiosity::Solution solution;
  radiosity::Certificate certificate;
  radiosity::RefinementReport report;
  Status status;
};

/// Fills all of `result`, which keeps to its place: the tree refers to its patches, and to `scene`.
inline void adapt(const Scene& scene, const Refinement& refinement, const Options& options,
                  Adapted* result, std::uint32_t threads = 2) {
  radiosity::ThreadPool pool;
  require(pool.init(threads));
  result->patches = patches_of(scene);
  result->status = radiosity::solve_adaptive(
      scene, result->patches, refinement, options, pool, nullptr, &result->tree, &result->elements,
      &result->solution, &result->certificate, &result->report);
}

inline Options on_rung(Rung rung, std::uint32_t resolution = 64) {
  Options options;
  options.rung = rung;
  options.resolution = resolution;
  return options;
}

inline Refinement limits(double variation, double min_edge = 0,
                         std::uint64_t max_elements = 20000) {
  return {variation, min_edge, max_elements};
}

inline double shortest_edge(const PatchSet& mesh) {
  double shortest = 1e300;
  for (std::uint32_t e = 0; e < mesh.patch_count(); ++e) {
    const auto corners = mesh.corners_of(e);
    for (std::size_t k = 0; k < corners.size(); ++k)
      shortest = std::min(shortest, glm::length(mesh.vertices[corners[k]] -
                                                mesh.vertices[corners[(k + 1) % corners.size()]]));
  }
  return shortest;
}

/// A closed room 2 x 1 x 1 under a lamp of 8 patches, with a two-sided screen in it that throws a
/// shadow; scaled, then moved.
inline Scene shadow_room(double scale = 1, const Vec3& move = {0, 0, 0}) {
  SceneBuilder builder(1);
  const auto at = [&](double x, double y, double z) { return scale * Vec3(x, y, z) + move; };
  const std::uint32_t wall = builder.material("wall", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.2, 10);
  const std::uint32_t screen = builder.material("screen", 0.4, 0);
  builder.two_sided(screen);
  const auto box = [&](const Vec3& low, const Vec3& high) {
    builder.box({wall, wall, wall, wall, wall, lamp}, low, high, {4, 2, 2}, true);
  };
  box(at(0, 0, 0), at(2, 1, 1));
  builder.face(
      screen, {at(0.75, 0.25, 0.5), at(1.25, 0.25, 0.5), at(1.25, 0.75, 0.5), at(0.75, 0.75, 0.5)});
  return builder.finish();
}

} // namespace hemicube::test
