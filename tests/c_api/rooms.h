#pragma once

// A cube seen from inside as arrays for the C interface.
#include "radiosity/c_api/hemicube.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace hemicube::c_api_test {

struct Room {
  std::vector<double> vertices;
  std::vector<std::uint64_t> offsets{0};
  std::vector<std::uint32_t> indices, materials;
  std::vector<double> reflectance, exitance;
  hc_scene_desc desc = {};

  std::uint64_t polygon_count() const { return offsets.size() - 1; }

  /// After a change of the arrays.
  void point() {
    desc = {};
    desc.struct_size = sizeof desc;
    desc.vertices = vertices.data();
    desc.vertex_count = vertices.size() / 3;
    desc.polygon_offsets = offsets.data();
    desc.polygon_count = polygon_count();
    desc.indices = indices.data();
    desc.index_count = indices.size();
    desc.polygon_materials = materials.data();
    desc.material_count = static_cast<std::uint32_t>(reflectance.size());
    desc.band_count = 1;
    desc.reflectance = reflectance.data();
    desc.exitance = exitance.data();
  }
};

/// n x n squares a wall: those of x = 0, x = 1, y = 0 and so on. Walls have material 0, the patches
/// of the wall z = 1 material 1.
inline Room room(int n, const std::vector<double>& reflectance = {0.5, 0.5},
                 const std::vector<double>& exitance = {0, 1}) {
  Room made;
  for (int wall = 0; wall < 6; ++wall)
    for (int k = 0; k < n * n; ++k) {
      const std::size_t axis = static_cast<std::size_t>(wall) / 2;
      for (int c = 0; c < 4; ++c) {
        const int corner = wall % 2 == 0 ? c : 3 - c;
        double vertex[3];
        vertex[axis] = wall % 2;
        vertex[(axis + 1) % 3] = static_cast<double>(k / n + (corner == 1 || corner == 2)) / n;
        vertex[(axis + 2) % 3] = static_cast<double>(k % n + (corner >= 2)) / n;
        made.indices.push_back(static_cast<std::uint32_t>(made.vertices.size() / 3));
        made.vertices.insert(made.vertices.end(), vertex, vertex + 3);
      }
      made.offsets.push_back(made.indices.size());
      made.materials.push_back(wall == 5 ? 1 : 0);
    }
  made.reflectance = reflectance;
  made.exitance = exitance;
  made.point();
  return made;
}

/// A handle that is released at the end.
template <typename T, void (*release)(T*)> class Owned {
public:
  Owned() = default;
  ~Owned() { release(handle_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;

  T** to() {
    release(handle_);
    handle_ = nullptr;
    return &handle_;
  }
  operator T*() const { return handle_; }

private:
  T* handle_ = nullptr;
};
using OwnedScene = Owned<hc_scene, hc_scene_release>;
using OwnedFormFactors = Owned<hc_form_factors, hc_form_factors_release>;
using OwnedSolution = Owned<hc_solution, hc_solution_release>;

inline hc_options options_of(int rung, std::uint32_t resolution, std::uint32_t threads = 1) {
  hc_options options = {};
  options.struct_size = sizeof options;
  options.rung = rung;
  options.resolution = resolution;
  options.threads = threads;
  options.no_error_estimate = 1;
  return options;
}

inline hc_certificate certificate_of(const hc_solution* solution) {
  hc_certificate certificate = {};
  certificate.struct_size = sizeof certificate;
  EXPECT_EQ(hc_solution_get_certificate(solution, &certificate), HC_OK) << hc_error_text();
  return certificate;
}
inline hc_certificate certificate_of(const hc_form_factors* form_factors) {
  hc_certificate certificate = {};
  certificate.struct_size = sizeof certificate;
  EXPECT_EQ(hc_form_factors_get_certificate(form_factors, &certificate), HC_OK) << hc_error_text();
  return certificate;
}

inline std::vector<double> values_of(const hc_solution* solution, int quantity, std::size_t count) {
  std::vector<double> values(count);
  EXPECT_EQ(hc_solution_get_values(solution, quantity, count, values.data()), HC_OK)
      << hc_error_text();
  return values;
}

} // namespace hemicube::c_api_test
