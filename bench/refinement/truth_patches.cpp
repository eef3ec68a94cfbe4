#include "bench/refinement/truth_patches.h"

#include "radiosity/form_factor/convex_polygon.h"
#include "tests/support/drawn_light.h"

#include <algorithm>
#include <cmath>

namespace hemicube::bench {
namespace {

using radiosity::ConvexPolygon;
using radiosity::PatchSet;

constexpr double kSameNormal = 0.999, kSamePlane = 1e-3; ///< the latter of a patch's size

ConvexPolygon polygon(const PatchSet& patches, std::uint32_t patch) {
  ConvexPolygon corners;
  for (const std::uint32_t corner : patches.corners_of(patch))
    corners.append(patches.vertices[corner]);
  return corners;
}

struct Box {
  Vec3 low, high;
};

Box box_of(const ConvexPolygon& corners) {
  Box box{corners.corners[0], corners.corners[0]};
  for (const Vec3& corner : corners.span()) {
    box.low = glm::min(box.low, corner);
    box.high = glm::max(box.high, corner);
  }
  return box;
}

/// The area of an element that lies in a patch of nearly the same plane.
double common_area(const ConvexPolygon& element, const ConvexPolygon& patch, const Vec3& normal) {
  ConvexPolygon common = element;
  for (int k = 0; k < patch.count && !common.empty(); ++k) {
    const Vec3 edge = patch.corners[(k + 1) % patch.count] - patch.corners[k];
    common = clip(common, {patch.corners[k], glm::cross(normal, edge)}, 0);
  }
  return common.empty() ? 0 : glm::length(radiosity::area_vector(common.span()));
}

} // namespace

/// Sums up over patches, band by band.
struct TruthPatches::Errors {
  std::vector<double> difference, squares;

  explicit Errors(std::size_t bands) : difference(bands), squares(bands) {}

  void add(std::size_t band, double area, double value, double truth) {
    difference[band] += area * (value - truth) * (value - truth);
    squares[band] += area * truth * truth;
  }
  double worst() const {
    double worst = 0;
    for (std::size_t b = 0; b < squares.size(); ++b)
      worst = std::max(worst, std::sqrt(difference[b] / squares[b]));
    return worst;
  }
};

double TruthPatches::error(const PatchSet& elements, std::span<const double> radiosity,
                           std::size_t bands) const {
  std::vector<ConvexPolygon> polygons;
  std::vector<Box> boxes;
  for (std::uint32_t e = 0; e < elements.patch_count(); ++e) {
    polygons.push_back(polygon(elements, e));
    boxes.push_back(box_of(polygons.back()));
  }
  Errors errors(bands);
  for (std::uint32_t p = 0; p < patches_.patch_count(); ++p) {
    const ConvexPolygon patch = polygon(patches_, p);
    const Box box = box_of(patch);
    const double margin = kSamePlane * glm::length(box.high - box.low);
    std::vector<double> power(bands);
    double area = 0;
    for (std::uint32_t e = 0; e < elements.patch_count(); ++e) {
      bool is_apart = glm::dot(elements.normal[e], patches_.normal[p]) < kSameNormal;
      for (int axis = 0; axis < 3 && !is_apart; ++axis)
        is_apart = boxes[e].low[axis] > box.high[axis] + margin ||
                   boxes[e].high[axis] < box.low[axis] - margin;
      if (is_apart ||
          std::fabs(glm::dot(patches_.normal[p], elements.centre[e] - patches_.centre[p])) >
              5 * margin + kSamePlane * glm::length(boxes[e].high - boxes[e].low))
        continue;
      const double common = common_area(polygons[e], patch, patches_.normal[p]);
      area += common;
      for (std::size_t b = 0; b < bands; ++b)
        power[b] += common * radiosity[e * bands + b];
    }
    if (std::fabs(area / patches_.area[p] - 1) > 1e-2)
      throw std::runtime_error("elements do not cover patch " + std::to_string(p) + ": " +
                               std::to_string(area / patches_.area[p]));
    for (std::size_t b = 0; b < bands; ++b)
      errors.add(b, patches_.area[p], power[b] / area, truth_[p][b].get<double>());
  }
  return errors.worst();
}

double TruthPatches::drawn_error(const PatchSet& elements, std::span<const double> radiosity,
                                 std::size_t bands, int up) const {
  constexpr int kPoints = 4;
  test::DrawnLight light(elements, radiosity, static_cast<std::uint32_t>(bands));
  Errors errors(bands);
  std::vector<double> values(bands), mean(bands);
  for (std::uint32_t p = 0; p < patches_.patch_count(); ++p) {
    const auto corners = patches_.corners_of(p);
    if (patches_.normal[p][up] < kSameNormal || std::fabs(patches_.centre[p][up]) > kSamePlane)
      continue;
    const auto corner = [&](std::size_t k) {
      return patches_.vertices[corners[k % corners.size()]];
    };
    std::fill(mean.begin(), mean.end(), 0.0);
    for (int i = 0; i < kPoints * kPoints; ++i) {
      const double u = (i % kPoints + 0.5) / kPoints, v = (i / kPoints + 0.5) / kPoints;
      // Points that stand for equal areas, of a triangle, too.
      const double across = corners.size() == 3 ? std::sqrt(u) : u;
      const Vec3 point = corners.size() == 3
                             ? corner(0) + across * ((1 - v) * (corner(1) - corner(0)) +
                                                     v * (corner(2) - corner(0)))
                             : (1 - v) * ((1 - u) * corner(0) + u * corner(1)) +
                                   v * ((1 - u) * corner(3) + u * corner(2));
      light.at(point, patches_.normal[p], values);
      for (std::size_t b = 0; b < bands; ++b)
        mean[b] += values[b] / (kPoints * kPoints);
    }
    for (std::size_t b = 0; b < bands; ++b)
      errors.add(b, patches_.area[p], mean[b], truth_[p][b].get<double>());
  }
  return errors.worst();
}

} // namespace hemicube::bench
