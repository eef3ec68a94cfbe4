#include "radiosity/mesh/triangulate.h"

namespace hemicube::radiosity {
namespace {

double squared_length(const Vec3& v) {
  return glm::dot(v, v);
}

// The corners not yet clipped form a ring. What a corner is changes only when a neighbour is
// clipped: if any point lies inside an ear then so does a corner that is not convex, and those are
// never clipped.
class EarClipper {
public:
  EarClipper(std::span<const Vec3> points, const PolygonShape& shape)
      : points_(points), normal_(shape.area_vector / shape.area), resolution_(shape.resolution) {}

  Status run(Buffer<std::uint32_t>* triangles) {
    HC_TRY(start());
    drop_needless();
    for (std::uint32_t i = first_, k = 0; k < count_; ++k, i = corners_[i].next)
      find_ear(i);
    while (count_ >= 3) {
      const std::uint32_t tip = choose();
      if (tip == kNone)
        break;
      if (corners_[tip].kind != Kind::kNeedless)
        HC_TRY(emit(tip, triangles));
      clip(tip);
    }
    return {};
  }

private:
  enum class Kind : std::uint8_t {
    kFlat,     // straight or reflex: never clipped, and the only kind that can be in an ear's way
    kNeedless, // the tip of a spike without area, or a repeated point: clipped without a triangle
    kBlocked,  // convex, but another corner lies in its triangle
    kEar
  };
  struct Corner {
    std::uint32_t previous, next;
    Kind kind;
    double shape; // of the triangle with both neighbours; larger is better
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Status start() {
    const std::uint32_t count = static_cast<std::uint32_t>(points_.size());
    HC_TRY(corners_.resize(count));
    for (std::uint32_t i = 0; i < count; ++i) {
      corners_[i].previous = (i + count - 1) % count;
      corners_[i].next = (i + 1) % count;
    }
    count_ = count;
    for (std::uint32_t i = 0; i < count; ++i)
      judge(i);
    return {};
  }

  // Before any ear is looked for: a needless corner must not be in the way of one.
  void drop_needless() {
    std::uint32_t corner = first_;
    for (std::uint32_t unchanged = 0; unchanged < count_ && count_ >= 3;) {
      if (corners_[corner].kind != Kind::kNeedless) {
        corner = corners_[corner].next;
        ++unchanged;
        continue;
      }
      unlink(corner);
      corner = corners_[corner].previous;
      judge(corner);
      judge(corners_[corner].next);
      unchanged = 0;
    }
  }

  // Sets everything about a corner that its neighbours decide.
  void judge(std::uint32_t i) {
    Corner& corner = corners_[i];
    const Vec3 u = points_[i] - points_[corner.previous];
    const Vec3 v = points_[corner.next] - points_[i];
    const int side = turn_side(normal_, resolution_, u, v);
    if (side > 0) {
      corner.kind = Kind::kBlocked;
      corner.shape = glm::dot(normal_, glm::cross(u, v)) /
                     (squared_length(u) + squared_length(v) + squared_length(u + v));
    } else {
      corner.kind = side == 0 && glm::dot(u, v) <= 0 ? Kind::kNeedless : Kind::kFlat;
    }
  }

  // Tells the ears among the convex corners.
  void find_ear(std::uint32_t i) {
    Corner& corner = corners_[i];
    if (corner.kind != Kind::kBlocked && corner.kind != Kind::kEar)
      return;
    corner.kind = Kind::kEar;
    const std::uint32_t end = corner.previous;
    for (std::uint32_t k = corners_[corner.next].next; k != end; k = corners_[k].next)
      if (corners_[k].kind == Kind::kFlat && blocks(points_[k], i)) {
        corner.kind = Kind::kBlocked;
        return;
      }
  }

  // A point on the new edge is in the way: it would end up as a corner in the middle of that edge.
  // A point on the outer edges is not, nor is one at the place of a corner: the polygon may touch
  // itself there.
  bool blocks(const Vec3& point, std::uint32_t tip) const {
    const Vec3& a = points_[corners_[tip].previous];
    const Vec3& b = points_[tip];
    const Vec3& c = points_[corners_[tip].next];
    const auto side = [&](const Vec3& u, const Vec3& v) {
      return turn_side(normal_, resolution_, u, v);
    };
    return side(b - a, point - a) > 0 && side(c - b, point - b) > 0 && side(a - c, point - c) >= 0;
  }

  std::uint32_t choose() const {
    std::uint32_t best = kNone;
    for (std::uint32_t i = first_, k = 0; k < count_; ++k, i = corners_[i].next) {
      const Corner& corner = corners_[i];
      if (corner.kind == Kind::kNeedless)
        return i;
      if (corner.kind != Kind::kFlat && (best == kNone || better(i, best)))
        best = i;
    }
    return best;
  }

  bool better(std::uint32_t i, std::uint32_t k) const {
    const Corner& a = corners_[i];
    const Corner& b = corners_[k];
    if (a.kind != b.kind)
      return a.kind == Kind::kEar;
    return a.shape > b.shape || (a.shape == b.shape && i < k);
  }

  Status emit(std::uint32_t tip, Buffer<std::uint32_t>* triangles) {
    std::uint32_t corner[3] = {corners_[tip].previous, tip, corners_[tip].next};
    while (corner[0] > corner[1] || corner[0] > corner[2]) {
      const std::uint32_t front = corner[0];
      corner[0] = corner[1];
      corner[1] = corner[2];
      corner[2] = front;
    }
    return triangles->append(corner);
  }

  void clip(std::uint32_t tip) {
    unlink(tip);
    const std::uint32_t before = corners_[tip].previous;
    const std::uint32_t after = corners_[tip].next;
    judge(before);
    judge(after);
    find_ear(before);
    find_ear(after);
  }

  void unlink(std::uint32_t i) {
    const Corner& corner = corners_[i];
    corners_[corner.previous].next = corner.next;
    corners_[corner.next].previous = corner.previous;
    if (first_ == i)
      first_ = corner.next;
    --count_;
  }

  std::span<const Vec3> points_;
  Vec3 normal_;
  double resolution_;
  Buffer<Corner> corners_;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
};

} // namespace

Status cut_quad(std::span<const Vec3> points, Buffer<std::uint32_t>* triangles) {
  static constexpr std::uint32_t kFrom0[] = {0, 1, 2, 0, 2, 3};
  static constexpr std::uint32_t kFrom1[] = {0, 1, 3, 1, 2, 3};
  const bool from_0 =
      squared_length(points[2] - points[0]) <= squared_length(points[3] - points[1]);
  return triangles->append(from_0 ? kFrom0 : kFrom1);
}

Status clip_ears(std::span<const Vec3> points, const PolygonShape& shape,
                 Buffer<std::uint32_t>* triangles) {
  return EarClipper(points, shape).run(triangles);
}

} // namespace hemicube::radiosity
