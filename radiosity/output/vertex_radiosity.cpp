#include "radiosity/output/vertex_radiosity.h"

#include "radiosity/output/shared_vertices.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr double kMinCosine = 0.99;
constexpr double kMaxStretch = 3;
/// Where more corners than this meet, each keeps its patch's own value: work stays linear.
constexpr std::size_t kMaxMeeting = 512;
constexpr std::uint32_t kNone = 0xffffffffu;

/// Light beyond float's range is shown as its largest value: an infinity would turn into NaN.
float to_float(double value) noexcept {
  constexpr double kLargest = 3.4e38;
  return static_cast<float>(value < kLargest ? value : kLargest);
}

/// Spreads a number over 64 bits, so that sums of spread numbers collide only by a rare accident.
std::uint64_t spread(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

class CornerValues {
public:
  CornerValues(const PatchSet& patches, std::span<const double> radiosity, std::uint32_t band_count)
      : patches_(patches), radiosity_(radiosity), band_count_(band_count) {}

  Status compute(Buffer<float>* out) {
    HC_TRY(find_shared_vertices(patches_, &shared_));
    const std::size_t corner_count = patches_.corners.size();
    HC_TRY(mean_.resize(corner_count * band_count_));
    HC_TRY(is_inside_.resize(corner_count));
    for (std::uint32_t corner = 0; corner < corner_count; ++corner)
      average(corner);
    out->clear();
    HC_TRY(out->resize(mean_.size()));
    for (std::size_t i = 0; i < mean_.size(); ++i)
      (*out)[i] = to_float(mean_[i]);
    for (std::uint32_t corner = 0; corner < corner_count; ++corner)
      if (!is_inside_[corner])
        extrapolate(corner, out->data() + std::size_t{corner} * band_count_);
    return {};
  }

private:
  std::uint32_t position_of(std::uint32_t corner) const {
    return shared_.position[patches_.corners[corner]];
  }
  Vec3 point_of(std::uint32_t corner) const { return patches_.vertices[patches_.corners[corner]]; }

  /// The corner `steps` further around the same patch.
  std::uint32_t along(std::uint32_t corner, std::uint32_t steps) const {
    const std::uint32_t patch = shared_.corner_patch[corner];
    const std::uint32_t begin = patches_.corner_offsets[patch];
    const std::uint32_t count = patches_.corner_offsets[patch + 1] - begin;
    return begin + (corner - begin + steps) % count;
  }
  std::uint32_t corner_count_of(std::uint32_t corner) const {
    const std::uint32_t patch = shared_.corner_patch[corner];
    return patches_.corner_offsets[patch + 1] - patches_.corner_offsets[patch];
  }

  /// Calls visit(corner, patch) for every corner at the same position on the same smooth surface.
  template <typename Visit> void for_each_meeting(std::uint32_t corner, Visit&& visit) const {
    const std::uint32_t own = shared_.corner_patch[corner];
    const auto meeting = shared_.corners_at(position_of(corner));
    if (meeting.size() > kMaxMeeting) {
      visit(corner, own);
      return;
    }
    for (const std::uint32_t other : meeting) {
      const std::uint32_t patch = shared_.corner_patch[other];
      if (patch == own || (patches_.material[patch] == patches_.material[own] &&
                           glm::dot(patches_.normal[patch], patches_.normal[own]) > kMinCosine))
        visit(other, patch);
    }
  }

  /// The mean of the patches around a corner; and whether they close around it: every edge that
  /// leaves the vertex in one of them then comes back in another.
  void average(std::uint32_t corner) {
    double* mean = mean_.data() + std::size_t{corner} * band_count_;
    double area = 0;
    std::uint64_t open_edges = 0;
    for_each_meeting(corner, [&](std::uint32_t other, std::uint32_t patch) {
      const double weight = patches_.area[patch];
      area += weight;
      for (std::uint32_t band = 0; band < band_count_; ++band)
        mean[band] += weight * value(patch, band);
      open_edges += spread(position_of(along(other, 1)));
      open_edges -= spread(position_of(along(other, corner_count_of(other) - 1)));
    });
    for (std::uint32_t band = 0; band < band_count_; ++band)
      mean[band] /= area;
    is_inside_[corner] = open_edges == 0;
  }

  /// The inside vertex to extrapolate from: the end of an edge at the border vertex, or else the
  /// opposite corner of a patch around it; kNone if there is none. Of several, the lowest corner.
  std::uint32_t inside_corner(std::uint32_t corner) const {
    std::uint32_t by_edge = kNone, opposite = kNone;
    for_each_meeting(corner, [&](std::uint32_t other, std::uint32_t) {
      const std::uint32_t count = corner_count_of(other);
      for (const std::uint32_t steps : {1u, count - 1})
        if (by_edge == kNone && is_inside_[along(other, steps)])
          by_edge = along(other, steps);
      if (opposite == kNone && is_inside_[along(other, count / 2)])
        opposite = along(other, count / 2);
    });
    return by_edge != kNone ? by_edge : opposite;
  }

  void extrapolate(std::uint32_t corner, float* out) const {
    const std::uint32_t inside = inside_corner(corner);
    if (inside == kNone)
      return;
    const Vec3 from = point_of(inside);
    Vec3 middle{0, 0, 0}; // relative to `from`: the place the mean belongs to
    double area = 0;
    for_each_meeting(corner, [&](std::uint32_t, std::uint32_t patch) {
      area += patches_.area[patch];
      middle += patches_.area[patch] * (patches_.centre[patch] - from);
    });
    middle /= area;
    const double ratio = glm::dot(point_of(corner) - from, middle) / glm::dot(middle, middle);
    if (!(ratio > 1)) // the vertex does not lie beyond the mean
      return;
    const double stretch = ratio < kMaxStretch ? ratio : kMaxStretch;
    for (std::uint32_t band = 0; band < band_count_; ++band) {
      double largest = 0;
      for_each_meeting(corner, [&](std::uint32_t, std::uint32_t patch) {
        largest = std::fmax(largest, value(patch, band));
      });
      const double start = mean_[std::size_t{inside} * band_count_ + band];
      const double mean = mean_[std::size_t{corner} * band_count_ + band];
      const double beyond = start + stretch * (mean - start);
      out[band] = to_float(std::fmin(std::fmax(beyond, 0), 2 * largest));
    }
  }

  double value(std::uint32_t patch, std::uint32_t band) const {
    return radiosity_[std::size_t{patch} * band_count_ + band];
  }

  const PatchSet& patches_;
  std::span<const double> radiosity_;
  std::uint32_t band_count_;
  SharedVertices shared_;
  Buffer<double> mean_;            ///< [corner][band]
  Buffer<std::uint8_t> is_inside_; ///< [corner]
};

} // namespace

Status vertex_radiosities(const PatchSet& patches, std::span<const double> radiosity,
                          std::uint32_t band_count, Buffer<float>* corner_radiosity) {
  return CornerValues(patches, radiosity, band_count).compute(corner_radiosity);
}

} // namespace hemicube::radiosity
