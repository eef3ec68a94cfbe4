#include "radiosity/output/vertex_radiosity.h"

#include "radiosity/elementary.h"
#include "radiosity/mesh/one_surface.h"
#include "radiosity/mesh/straight_corners.h"
#include "radiosity/output/balanced_weights.h"
#include "radiosity/output/shared_vertices.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr double kMaxStretch = 3;
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

/// The corners at a vertex whose patches form one smooth surface, and what of each patch counts.
struct Meeting {
  std::size_t count = 0;
  Vec3 normal;                        ///< of the surface there, unit
  std::uint32_t corners[kMaxMeeting]; ///< ascending
  Vec3 offset[kMaxMeeting];           ///< of the patch's centre from the vertex
  double weight[kMaxMeeting];         ///< of the patch
};

class CornerValues {
public:
  CornerValues(const PatchSet& patches, std::span<const double> radiosity, std::uint32_t band_count)
      : patches_(patches), radiosity_(radiosity), band_count_(band_count) {}

  Status compute(Buffer<float>* out) {
    HC_TRY(find_shared_vertices(patches_, &shared_));
    HC_TRY(find_straight_corners(patches_, &is_straight_));
    const auto corner_count = static_cast<std::uint32_t>(patches_.corners.size());
    HC_TRY(find_surfaces(EdgeLight::kSmooth, &surface_));
    HC_TRY(mean_.resize(std::size_t{corner_count} * band_count_));
    HC_TRY(is_inside_.resize(corner_count));
    for (std::uint32_t corner = 0; corner < corner_count; ++corner)
      average(corner);
    out->clear();
    HC_TRY(out->resize(mean_.size()));
    for (std::size_t i = 0; i < mean_.size(); ++i)
      (*out)[i] = to_float(mean_[i]);
    for (std::uint32_t corner = 0; corner < corner_count; ++corner)
      if (!is_inside_[corner])
        extrapolate(corner, out->data());
    for (std::uint32_t corner = 0; corner < corner_count; ++corner)
      if (is_straight_[corner] && is_alone(corner))
        put_on_side(corner, out->data());
    if (!patches_.edge_light.empty())
      HC_TRY(join_at_bends(out->data()));
    return {};
  }

private:
  std::uint32_t position_of(std::uint32_t corner) const {
    return shared_.position[patches_.corners[corner]];
  }
  Vec3 point_of(std::uint32_t corner) const { return patches_.vertices[patches_.corners[corner]]; }

  std::uint32_t corner_count_of(std::uint32_t corner) const {
    const std::uint32_t patch = shared_.corner_patch[corner];
    return patches_.corner_offsets[patch + 1] - patches_.corner_offsets[patch];
  }
  /// The corner `steps` further around the same patch.
  std::uint32_t along(std::uint32_t corner, std::uint32_t steps) const {
    const std::uint32_t begin = patches_.corner_offsets[shared_.corner_patch[corner]];
    return begin + (corner - begin + steps) % corner_count_of(corner);
  }

  /// Names the surfaces at every position by their lowest corner. Being one surface is handed on
  /// from patch to patch: on a finely bent surface the two sides of an edge would else take their
  /// means over different patches.
  /// @param across  the most that light may do across an edge within one surface
  Status find_surfaces(EdgeLight across, Buffer<std::uint32_t>* surface) const {
    HC_TRY(surface->resize(patches_.corners.size()));
    for (std::uint32_t corner = 0; corner < surface->size(); ++corner)
      (*surface)[corner] = corner;
    for (std::uint32_t at = 0; at + 1 < shared_.offsets.size(); ++at) {
      const auto meeting = shared_.corners_at(at);
      if (meeting.size() > kMaxMeeting)
        continue;
      const bool is_cut = has_edge_beyond(meeting, across);
      for (std::size_t i = 1; i < meeting.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if ((*surface)[meeting[j]] != (*surface)[meeting[i]] &&
              are_one_surface(patches_, shared_.corner_patch[meeting[j]],
                              shared_.corner_patch[meeting[i]]) &&
              (!is_cut || share_edge(meeting[i], meeting[j], across)))
            join_surfaces(meeting.first(i + 1), (*surface)[meeting[j]], (*surface)[meeting[i]],
                          surface);
    }
    return {};
  }
  static void join_surfaces(std::span<const std::uint32_t> corners, std::uint32_t a,
                            std::uint32_t b, Buffer<std::uint32_t>* surface) {
    for (const std::uint32_t corner : corners)
      if ((*surface)[corner] == a || (*surface)[corner] == b)
        (*surface)[corner] = a < b ? a : b;
  }

  std::uint32_t before(std::uint32_t corner) const {
    return along(corner, corner_count_of(corner) - 1);
  }
  bool has_edge_beyond(std::span<const std::uint32_t> corners, EdgeLight across) const {
    for (const std::uint32_t corner : corners)
      if (patches_.light_across(corner) > across || patches_.light_across(before(corner)) > across)
        return true;
    return false;
  }
  /// Whether two patches that meet at corners have an edge there in common, and light does no more
  /// across it than `across`.
  bool share_edge(std::uint32_t a, std::uint32_t b, EdgeLight across) const {
    return (position_of(along(a, 1)) == position_of(before(b)) &&
            patches_.light_across(a) <= across) ||
           (position_of(before(a)) == position_of(along(b, 1)) &&
            patches_.light_across(b) <= across);
  }

  /// Gives the surfaces on both sides of edges across which light bends one value at their ends:
  /// each has been led up to the edge from its own side.
  Status join_at_bends(float* out) const {
    Buffer<std::uint32_t> wide;
    HC_TRY(find_surfaces(EdgeLight::kBends, &wide));
    for (std::uint32_t at = 0; at + 1 < shared_.offsets.size(); ++at) {
      const auto meeting = shared_.corners_at(at);
      if (meeting.size() > kMaxMeeting || !has_edge_beyond(meeting, EdgeLight::kSmooth))
        continue;
      for (const std::uint32_t first : meeting)
        if (wide[first] == first)
          for (std::uint32_t band = 0; band < band_count_; ++band)
            join_surfaces_at(meeting, wide, first, out + band);
    }
    return {};
  }
  void join_surfaces_at(std::span<const std::uint32_t> meeting, const Buffer<std::uint32_t>& wide,
                        std::uint32_t first, float* out) const {
    double sum = 0, count = 0;
    for (const std::uint32_t corner : meeting)
      if (wide[corner] == first && surface_[corner] == corner) {
        sum += static_cast<double>(out[std::size_t{corner} * band_count_]);
        ++count;
      }
    for (const std::uint32_t corner : meeting)
      if (wide[corner] == first)
        out[std::size_t{corner} * band_count_] = to_float(sum / count);
  }

  /// Fills meeting_ for a surface, all weights areas over the largest.
  void gather(std::uint32_t surface) {
    const auto at_position = shared_.corners_at(position_of(surface));
    const Vec3 vertex = point_of(surface);
    meeting_.count = 0;
    Vec3 normal{0, 0, 0};
    double largest = 0;
    const auto add = [&](std::uint32_t corner) {
      const std::uint32_t patch = shared_.corner_patch[corner];
      meeting_.corners[meeting_.count] = corner;
      meeting_.offset[meeting_.count] = patches_.centre[patch] - vertex;
      meeting_.weight[meeting_.count++] = patches_.area[patch];
      largest = max_number(largest, patches_.area[patch]);
    };
    if (at_position.size() > kMaxMeeting)
      add(surface);
    else
      for (const std::uint32_t corner : at_position)
        if (surface_[corner] == surface)
          add(corner);
    for (std::size_t k = 0; k < meeting_.count; ++k) {
      meeting_.weight[k] /= largest;
      normal += meeting_.weight[k] * patches_.normal[patch_at(k)];
    }
    // On a closed tip the normals may cancel.
    meeting_.normal = glm::length(normal) > 0 ? unit(normal) : patches_.normal[patch_at(0)];
  }
  std::uint32_t patch_at(std::size_t k) const { return shared_.corner_patch[meeting_.corners[k]]; }

  /// Whether the patches close around the vertex: every edge that leaves it in one of them then
  /// comes back in another.
  bool closes() const {
    std::uint64_t open_edges = 0;
    for (std::size_t k = 0; k < meeting_.count; ++k) {
      const std::uint32_t corner = meeting_.corners[k];
      open_edges += spread(position_of(along(corner, 1)));
      open_edges -= spread(position_of(along(corner, corner_count_of(corner) - 1)));
    }
    return open_edges == 0;
  }

  double mean_in_band(std::uint32_t band) const {
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < meeting_.count; ++k) {
      sum += meeting_.weight[k] * value(patch_at(k), band);
      weights += meeting_.weight[k];
    }
    return sum / weights;
  }

  void average(std::uint32_t corner) {
    double* mean = mean_.data() + std::size_t{corner} * band_count_;
    const std::uint32_t surface = surface_[corner];
    if (surface != corner) { // done before
      for (std::uint32_t band = 0; band < band_count_; ++band)
        mean[band] = mean_[std::size_t{surface} * band_count_ + band];
      is_inside_[corner] = is_inside_[surface];
      return;
    }
    gather(surface);
    is_inside_[corner] = closes();
    if (is_inside_[corner])
      balance_about_point(offsets(), meeting_.normal, weights());
    for (std::uint32_t band = 0; band < band_count_; ++band)
      mean[band] = mean_in_band(band);
  }
  std::span<const Vec3> offsets() const { return {meeting_.offset, meeting_.count}; }
  std::span<double> weights() { return {meeting_.weight, meeting_.count}; }

  /// The weighted mean of the offsets: the place, seen from the vertex, that the mean belongs to.
  Vec3 middle() const {
    Vec3 sum{0, 0, 0};
    double weights = 0;
    for (std::size_t k = 0; k < meeting_.count; ++k) {
      sum += meeting_.weight[k] * meeting_.offset[k];
      weights += meeting_.weight[k];
    }
    return sum / weights;
  }

  /// The inside vertex of the patches of meeting_ from which the way through the middle leads most
  /// straight to the vertex; of several, the first one around the lowest corner. kNone if there is
  /// none.
  std::uint32_t inside_corner() const {
    const Vec3 vertex = point_of(meeting_.corners[0]);
    const Vec3 middle = this->middle();
    std::uint32_t best = kNone;
    double best_cosine = 0;
    for (std::size_t k = 0; k < meeting_.count; ++k) {
      const std::uint32_t count = corner_count_of(meeting_.corners[k]);
      for (std::uint32_t steps = 1; steps < count; ++steps) {
        const std::uint32_t candidate = along(meeting_.corners[k], steps);
        if (!is_inside_[candidate])
          continue;
        const Vec3 away = point_of(candidate) - vertex;
        const double cosine = glm::dot(away, middle) / glm::length(away);
        if (cosine > best_cosine * (1 + 1e-9)) { // rounding does not choose
          best = candidate;
          best_cosine = cosine;
        }
      }
    }
    return best;
  }

  void extrapolate(std::uint32_t corner, float* out) {
    float* mine = out + std::size_t{corner} * band_count_;
    const std::uint32_t surface = surface_[corner];
    if (surface != corner) { // done before
      for (std::uint32_t band = 0; band < band_count_; ++band)
        mine[band] = out[std::size_t{surface} * band_count_ + band];
      return;
    }
    if (shared_.corners_at(position_of(corner)).size() > kMaxMeeting)
      return;
    gather(surface);
    const std::uint32_t inside = inside_corner();
    if (inside == kNone)
      return;
    const Vec3 way = point_of(corner) - point_of(inside);
    balance_about_line(offsets(), meeting_.normal, way, weights());
    const Vec3 half_way = way + middle(); // seen from the inside vertex
    const double ratio = glm::dot(way, half_way) / glm::dot(half_way, half_way);
    if (!(ratio > 1)) // the vertex does not lie beyond the mean
      return;
    const double stretch = ratio < kMaxStretch ? ratio : kMaxStretch;
    for (std::uint32_t band = 0; band < band_count_; ++band) {
      double largest = 0;
      for (std::size_t k = 0; k < meeting_.count; ++k)
        largest = max_number(largest, value(patch_at(k), band));
      const double start = mean_[std::size_t{inside} * band_count_ + band];
      const double beyond = start + stretch * (mean_in_band(band) - start);
      mine[band] = to_float(min_number(max_number(beyond, 0), 2 * largest));
    }
  }

  /// Whether no other patch of its surface touches a corner.
  bool is_alone(std::uint32_t corner) const {
    if (surface_[corner] != corner)
      return false;
    const auto meeting = shared_.corners_at(position_of(corner));
    if (meeting.size() > kMaxMeeting)
      return false;
    for (const std::uint32_t other : meeting)
      if (other != corner && surface_[other] == corner)
        return false;
    return true;
  }

  /// Puts a straight corner between the corners at which its side begins and ends.
  void put_on_side(std::uint32_t corner, float* out) const {
    const std::uint32_t count = corner_count_of(corner);
    std::uint32_t before = count - 1, after = 1;
    while (is_straight_[along(corner, before)])
      --before;
    while (is_straight_[along(corner, after)])
      ++after;
    const std::uint32_t begin = along(corner, before), end = along(corner, after);
    const double to_begin = glm::length(point_of(corner) - point_of(begin));
    const double to_end = glm::length(point_of(end) - point_of(corner));
    const double share = to_begin / (to_begin + to_end);
    for (std::uint32_t band = 0; band < band_count_; ++band) {
      const auto from = static_cast<double>(out[std::size_t{begin} * band_count_ + band]);
      const auto to = static_cast<double>(out[std::size_t{end} * band_count_ + band]);
      out[std::size_t{corner} * band_count_ + band] = to_float(from + share * (to - from));
    }
  }

  double value(std::uint32_t patch, std::uint32_t band) const {
    return radiosity_[std::size_t{patch} * band_count_ + band];
  }

  const PatchSet& patches_;
  std::span<const double> radiosity_;
  std::uint32_t band_count_;
  SharedVertices shared_;
  Buffer<std::uint8_t> is_straight_; ///< [corner]
  Buffer<std::uint32_t> surface_;    ///< [corner] the lowest corner there on the same surface
  Buffer<double> mean_;              ///< [corner][band]
  Buffer<std::uint8_t> is_inside_;   ///< [corner]
  Meeting meeting_;                  ///< scratch
};

} // namespace

Status vertex_radiosities(const PatchSet& patches, std::span<const double> radiosity,
                          std::uint32_t band_count, Buffer<float>* corner_radiosity) {
  return CornerValues(patches, radiosity, band_count).compute(corner_radiosity);
}

} // namespace hemicube::radiosity
