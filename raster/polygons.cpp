#include "raster/polygons.h"

namespace hemicube::raster {
namespace {

bool precedes(const Vec3& a, const Vec3& b) {
  if (a.x != b.x)
    return a.x < b.x;
  if (a.y != b.y)
    return a.y < b.y;
  return a.z < b.z;
}

/// Walks a polygon from its lowest vertex towards the lower of that vertex's two neighbours,
/// whatever corner and direction it was given in.
class CanonicalWalk {
public:
  CanonicalWalk(const Polygons& polygons, std::uint32_t polygon)
      : vertices_(polygons.vertices),
        corners_(polygons.corners.subspan(polygons.corner_offsets[polygon],
                                          polygons.corner_offsets[polygon + 1] -
                                              polygons.corner_offsets[polygon])) {
    for (std::size_t k = 1; k < corners_.size(); ++k)
      if (precedes(at(k), at(start_)))
        start_ = k;
    const std::size_t last = corners_.size() - 1;
    reversed_ = precedes(at((start_ + last) % corners_.size()), at((start_ + 1) % corners_.size()));
  }

  std::size_t size() const { return corners_.size(); }
  bool reversed() const { return reversed_; }

  const Vec3& operator[](std::size_t step) const {
    const std::size_t n = corners_.size();
    return at(reversed_ ? (start_ + n - step % n) % n : (start_ + step) % n);
  }

private:
  const Vec3& at(std::size_t corner) const { return vertices_[corners_[corner]]; }

  std::span<const Vec3> vertices_;
  std::span<const std::uint32_t> corners_;
  std::size_t start_ = 0;
  bool reversed_ = false;
};

Plane plane_of(const CanonicalWalk& walk) {
  // Relative to the first vertex: a far-away polygon loses no digits.
  const Vec3 origin = walk[0];
  Plane plane;
  Vec3 sum(0, 0, 0);
  for (std::size_t k = 0; k < walk.size(); ++k) {
    const Vec3 a = walk[k] - origin;
    const Vec3 b = walk[k + 1] - origin;
    plane.normal += glm::cross(a, b);
    sum += a;
  }
  plane.point = origin + sum / static_cast<double>(walk.size());
  plane.reversed = walk.reversed();
  return plane;
}

} // namespace

Status compute_planes(const Polygons& polygons, Buffer<Plane>* planes) {
  if (polygons.count() > kMaxPolygonCount)
    return Status::error(StatusCode::kInvalidArgument, "too many polygons: ", polygons.count(),
                         ", at most ", kMaxPolygonCount);
  HC_TRY(planes->resize(polygons.count()));
  for (std::uint32_t p = 0; p < polygons.count(); ++p)
    (*planes)[p] = plane_of(CanonicalWalk(polygons, p));
  return {};
}

} // namespace hemicube::raster
