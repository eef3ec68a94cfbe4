#pragma once

#include "radiosity/scene/scene.h"

#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <tuple>

namespace hemicube::radiosity::cli {

/// Scenes of one band built in code: no files, the same bits on every machine. Throws
/// std::bad_alloc.
class VerifyScene {
public:
  VerifyScene();

  /// Adds a material. @return its number
  std::uint32_t material(double reflectance, double exitance);

  /// Adds a face, corners counter-clockwise seen from its front; corners at bit-equal positions are
  /// one vertex.
  void face(std::uint32_t material, std::span<const Vec3> corners);
  void face(std::uint32_t material, std::initializer_list<Vec3> corners) {
    face(material, std::span<const Vec3>(corners.begin(), corners.size()));
  }

  /// Adds the sides of an axis-parallel box, cells x cells faces each, seen from inside or from
  /// outside.
  void box(std::uint32_t material, const Vec3& low, const Vec3& high, int cells, bool from_inside);

  /// Adds the inside of a polyhedron with all its corners on the unit sphere: an icosahedron whose
  /// edges are halved `level` times, 20 * 4^level triangles.
  void sphere(const std::function<std::uint32_t(const Vec3& centre)>& material_of, int level);

  const Scene& scene() const { return scene_; }

private:
  Scene scene_;
  std::map<std::tuple<double, double, double>, std::uint32_t> vertex_of_;
};

} // namespace hemicube::radiosity::cli
