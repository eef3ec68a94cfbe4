#pragma once

#include "radiosity/form_factor/visible_part.h"

namespace hemicube::radiosity {

/// How much of what two polygons would exchange gets past what is between them.
struct VisibleShare {
  double share = 1; ///< 0..1
  double error = 0; ///< estimate of |share - exact|
  double doubt = 0; ///< what it might be wrong by if the estimate is
};

/// How hard to try.
struct Effort {
  double tolerance = 1;    ///< on the error, > 0
  double largest_part = 1; ///< no cell that carries more of the integral is taken as it is: what
                           ///< few points show alike may differ in between
  std::uint32_t max_points = 1; ///< about as many points are spent at most
};

/// Integrates exact visibility from points over a receiver. One per worker.
class ShareIntegrator {
public:
  /// @param face_count  of the scene
  /// @param tolerance   points closer than this to a plane lie in it, metres
  Status init(std::uint32_t face_count, double tolerance);

  /// Sets the facet whose points see. @param receiver  outlives its use
  void set_receiver(const Facet& receiver) noexcept;

  /// The ratio of two integrals over the receiver: of the form factor of what is visible of `to`,
  /// and of the whole of it. Four points a cell; cells are cut in four where two rules in a row
  /// disagree. Visible form factors are continuous with kinks, for which rules of low order on
  /// small cells are best; in the ratio the variation of the kernel itself all but cancels.
  /// @param to  it and the receiver see each other with their fronts
  /// @param whole  the integral of the form factor of all of `to` over the receiver, m^2, > 0
  Status find(const Facet& to, std::span<const Blocker> blockers, double whole,
              const Effort& effort, VisibleShare* share);

  /// The same for a receiver that is a single point.
  Status find_at_point(const Facet& to, std::span<const Blocker> blockers, VisibleShare* share);

  static constexpr int kCellPoints = 4;

  /// The points that stand for a facet where it is looked at as a whole.
  /// @return how many: kCellPoints for a quadrilateral or triangle, else 1, its centre
  static std::size_t points_on(const Facet& facet, Vec3 (&points)[kCellPoints]) noexcept;

  /// Points spent since this was made.
  std::uint64_t point_count() const noexcept { return point_count_; }

private:
  /// A part of a quadrilateral, in its own coordinates 0..1 x 0..1.
  struct Cell {
    const Vec3* corners; ///< four
    double u, v, size;
  };
  /// Weighted sums over the points of a cell.
  struct Sums {
    double whole = 0, visible = 0;
    double least = 1, most = 0; ///< visible share of a point
    /// About how far a kink of the integrand between the points moves the sum.
    double kink() const noexcept { return most > least ? 0.125 * (most - least) * whole : 0; }
  };
  static constexpr int kMaxCells = ConvexPolygon::kMaxCorners / 2;

  /// Shadows that were asked for at one of the receiver's own points.
  struct KeptShadows {
    Buffer<std::uint32_t> index_of_face; ///< into shadows, valid if it names the face
    Buffer<Shadow> shadows;
    Buffer<std::uint32_t> faces; ///< [shadow]
  };

  /// Integrals of `whole` over cells that are proven seen, proven hidden, and neither.
  struct Totals {
    double seen = 0, hidden = 0, open = 0, open_visible = 0;
    double share(double whole) const noexcept;
  };
  /// Which of blockers_ matter.
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  enum class Fate { kSeen, kHidden, kOpen };

  /// Points miss some of `whole`, as it is known or better sums say, near an edge that the receiver
  /// shares with what it sees. Whatever they say of the share, any of that may be seen or hidden.
  /// @param met  the sum over the points
  /// @return it over what all of the receiver sees, 0..1, per unit of what was met
  double missed_per_whole(double met, double whole) const noexcept;

  static int split(const ConvexPolygon& polygon, Vec3 (*cells)[4]) noexcept;
  Status sample(const Cell& cell, Range blockers, bool keeps, Sums* sums);
  Status find_shadows(const Vec3& eye, Range blockers, KeptShadows* kept);
  Status narrow(const Cell& cell, Range blockers, Range* narrowed, Fate* fate);
  Status refine(const Cell& cell, Range blockers, const Sums& sums, double missed, double tolerance,
                double budget, Totals* refined, double* error);

  const Facet* receiver_ = nullptr;
  const Facet* to_ = nullptr;
  KeptShadows kept_[kCellPoints]; ///< at the points of the receiver as a single cell

  Buffer<Blocker> blockers_; ///< of the pair, then of the cells being cut, level after level
  double plane_tolerance_ = 0;
  double largest_part_ = 1;
  double all_ = 0; ///< the integral of `whole` over the receiver
  std::uint64_t point_count_ = 0;
  Buffer<Shadow> shadows_;           ///< of a point that keeps none
  Buffer<const Shadow*> in_the_way_; ///< of the point at hand
  VisiblePart visible_;
};

} // namespace hemicube::radiosity
