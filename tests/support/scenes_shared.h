#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/scene/scene.h"
#include "raster/polygons.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

/// Scenes built in code, shared by tests and benchmarks: no files, the same bits on every machine.
namespace hemicube::test {

using radiosity::PatchSet;
using radiosity::Scene;

/// Throws std::runtime_error with the status' message unless it is ok.
void require(const Status& status);

/// Numbers from std::mt19937 with a named seed, made by integer scaling alone: the standard fixes
/// what the engine yields, but not what the standard distributions make of it.
class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// A multiple of 2^-24 in [0, 1).
  double unit();
  double between(double low, double high) { return low + (high - low) * unit(); }
  Vec3 point(double low, double high);
  /// 0 .. count-1
  std::uint32_t index(std::uint32_t count);

private:
  std::mt19937 engine_;
};

/// Collects faces into a Scene; corners at bit-equal positions become one vertex.
class SceneBuilder {
public:
  /// @param bands  number of bands: 3 = r,g,b, else b0,b1,...
  explicit SceneBuilder(std::uint32_t bands = 3);

  /// Adds a material with one value for all bands. @return its number
  std::uint32_t material(std::string_view name, double reflectance, double exitance);
  /// The same with a value per band.
  std::uint32_t material(std::string_view name, std::span<const double> reflectance,
                         std::span<const double> exitance);
  void two_sided(std::uint32_t material);

  /// Adds a face, corners counter-clockwise seen from its front.
  void face(std::uint32_t material, std::span<const Vec3> corners);
  void face(std::uint32_t material, std::initializer_list<Vec3> corners);

  /// Adds the grid of nu x nv quads that fills the parallelogram a, b, c, d (in this order around
  /// it); nu cells along a-b. Points on a side depend on the two corners of that side alone, so
  /// grids with equal counts along a common side share its vertices.
  void grid(std::uint32_t material, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
            int nu, int nv);
  /// The same with a material per cell (i along a-b, j along a-d).
  void grid(const std::function<std::uint32_t(int, int)>& material_of, const Vec3& a, const Vec3& b,
            const Vec3& c, const Vec3& d, int nu, int nv);

  /// Adds the six walls of an axis-parallel box, seen from inside (or from outside), with
  /// cells[axis] cells along each axis. @param materials  of x low, x high, y low, y high, z low, z
  /// high
  void box(const std::array<std::uint32_t, 6>& materials, const Vec3& low, const Vec3& high,
           const std::array<int, 3>& cells, bool from_inside);

  Scene finish();

private:
  Scene scene_;
  std::map<std::tuple<double, double, double>, std::uint32_t> vertex_of_;
};

/// The inside of the box (0,0,0)..size with nx, ny, nz cells along the axes, one material.
Scene box_enclosure(const Vec3& size, int nx, int ny, int nz, double reflectance, double exitance);

/// The inside of the unit cube with n x n patches a face; its radiosity is E / (1 - rho)
/// everywhere.
Scene furnace_cube(int n, double reflectance, double exitance);

/// The inside of the unit cube, 8 x 8 patches a face: 384 patches, white walls, an emitting
/// ceiling.
Scene cube8();

/// A Cornell-like room, open at the front, with a light in the ceiling and two turned blocks on the
/// floor. @param cells  cells along a wall; a multiple of 4;
/// cells = 40 gives 10,016 patches, cells = 8 gives 376
Scene cornell_like(int cells);

/// A closed room whose floor (7 x 7), ceiling (4 x 6) and walls (5 x 5) do not match at the edges:
/// full of T-vertices. @param scale  of all coordinates; @param origin  added to all coordinates
Scene t_vertex_room(double scale = 1, const Vec3& origin = {0, 0, 0});

/// A closed L-shaped room, one material: not convex. @param cells_per_metre  a power of two, so
/// that walls and floor meet bit for bit
Scene l_room(int cells_per_metre, double reflectance, double exitance);

/// The patches of a scene, one per face. Throws if meshing fails.
PatchSet patches_of(const Scene& scene);

/// Convex polygons that own their arrays.
struct PolygonSet {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> corner_offsets{0};
  std::vector<std::uint32_t> corners;

  void add(std::span<const Vec3> polygon);
  void add(std::initializer_list<Vec3> polygon);
  std::uint32_t count() const { return static_cast<std::uint32_t>(corner_offsets.size() - 1); }
  std::vector<Vec3> polygon(std::uint32_t id) const;
  raster::Polygons view() const { return {vertices, corner_offsets, corners}; }
};

PolygonSet polygons_of(const Scene& scene);

/// Triangles, parallelograms and hexagons of any orientation, of sizes size_low .. size_high,
/// around points of the cube of half side `spread` about `centre`.
PolygonSet polygon_soup(std::uint32_t seed, int count, double spread, double size_low,
                        double size_high, const Vec3& centre = {0, 0, 0});

/// Triangles and parallelograms of the given aspect, length 0.5 .. 2, around points of the unit
/// cube.
PolygonSet sliver_soup(std::uint32_t seed, int count, double aspect);

/// Every coordinate times factor, then plus offset.
PolygonSet transformed(const PolygonSet& polygons, double factor, const Vec3& offset);

/// A right-handed orthonormal frame (x, y, z) from a random rotation (a quaternion of mt19937
/// numbers).
std::array<Vec3, 3> random_frame(Random& random);

} // namespace hemicube::test
