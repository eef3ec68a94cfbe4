#pragma once

#include "radiosity/discontinuity/discontinuity_line.h"
#include "radiosity/discontinuity/occluder_edges.h"

namespace hemicube::radiosity {

/// The light that passes the end of something on its way from the end of an emitter: all of it lies
/// in one plane (Heckbert 1992; Lischinski, Tampieri, Greenberg 1992). Light starts at `apex` and
/// passes an edge of an occluder (vertex-edge), or starts at an edge of an emitter and passes
/// `apex` (edge-vertex). Points of the wedge are apex + t * ((1-u) first + u second).
struct Wedge {
  Vec3 apex{0, 0, 0};
  Vec3 first{0, 0, 0}, second{0, 0, 0};
  bool apex_emits = true; ///< light goes from t = 0 past t = 1; else from t = -1 past t = 0

  static Wedge vertex_edge(const Vec3& emitter, const Vec3& edge_begin, const Vec3& edge_end) {
    return {emitter, edge_begin - emitter, edge_end - emitter, true};
  }
  static Wedge edge_vertex(const Vec3& edge_begin, const Vec3& edge_end, const Vec3& corner) {
    return {corner, corner - edge_begin, corner - edge_end, false};
  }

  Vec3 direction(double u) const { return first + u * (second - first); }
  /// Where light starts, or where it has passed the border.
  double begin_t(bool before) const { return (apex_emits ? 1 : 0) - (before ? 1 : 0); }
};

/// Follows wedges of light to the surfaces where they end. One per worker.
class WedgeTracer {
public:
  explicit WedgeTracer(const OccluderEdges& edges) : edges_(edges) {}

  /// Where light of a wedge that passes all that is in its way up to the border ends.
  /// @param breaks     values of u between which is_border does not change
  /// @param is_border  (u, normal of the wedge's plane): whether light is cut off there
  /// @param lines      are appended; light = kBends
  /// @return false if the wedge has no width: nothing is appended
  template <typename IsBorder>
  bool trace(const Wedge& wedge, std::span<const double> breaks, IsBorder is_border,
             std::vector<DiscontinuityLine>* lines);

private:
  /// Where the wedge meets a face, by (t, t u).
  struct Hit {
    std::uint32_t face;
    double t[2], w[2];

    double u(int end) const { return w[end] / t[end]; }
    /// The t at which the face is met along u.
    double t_at(double at) const;
  };

  bool begin(const Wedge& wedge);
  void collect(bool before);
  bool hit(std::uint32_t face, bool before, Hit* hit) const;
  void find_breaks(std::span<const double> given);
  bool is_hidden(double u) const;
  const Hit* first_hit(double u) const;
  void append(const Hit& hit, double begin, double end, std::vector<DiscontinuityLine>* lines);

  const OccluderEdges& edges_;
  Wedge wedge_;
  Vec3 normal_{0, 0, 0}, dual_t_{0, 0, 0}, dual_w_{0, 0, 0};
  double t_doubt_ = 0; ///< of t, from the rounding of coordinates
  std::vector<Hit> before_, beyond_;
  std::vector<double> breaks_;
};

template <typename IsBorder>
bool WedgeTracer::trace(const Wedge& wedge, std::span<const double> breaks, IsBorder is_border,
                        std::vector<DiscontinuityLine>* lines) {
  constexpr double kLeastWidth = 1e-9; ///< of u
  if (!begin(wedge))
    return false;
  collect(false);
  if (beyond_.empty())
    return true;
  collect(true);
  find_breaks(breaks);
  // Between two breaks nothing changes: what holds in the middle holds for all.
  const Hit* current = nullptr;
  double from = 0;
  for (std::size_t k = 1; k < breaks_.size(); ++k) {
    const double begin = breaks_[k - 1], end = breaks_[k], middle = 0.5 * (begin + end);
    if (!(end - begin > kLeastWidth))
      continue;
    const Hit* next =
        is_hidden(middle) || !is_border(middle, normal_) ? nullptr : first_hit(middle);
    if (next == current)
      continue;
    if (current != nullptr)
      append(*current, from, begin, lines);
    current = next;
    from = begin;
  }
  if (current != nullptr)
    append(*current, from, 1, lines);
  return true;
}

} // namespace hemicube::radiosity
