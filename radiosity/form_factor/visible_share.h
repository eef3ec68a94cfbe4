#pragma once

#include "radiosity/form_factor/visible_part.h"

namespace hemicube::radiosity {

/// How much of what two polygons would exchange gets past what is between them.
struct VisibleShare {
  double share = 1; ///< 0..1
  double error = 0; ///< estimate of |share - exact|
};

/// Integrates exact visibility from points over a polygon. One per worker.
class ShareIntegrator {
public:
  /// The ratio of two integrals over `from`: of the form factor of what is visible of `to`, and of
  /// the whole of it. By tensor Gauss rules on cells that are cut in four where two rules in a row
  /// disagree. Visible form factors are continuous with kinks, for which rules of low order on
  /// small cells are best; in the ratio the variation of the kernel itself all but cancels.
  /// @param from, to    facets with at least three corners that see each other with their fronts
  /// @param blockers    as for VisiblePart
  /// @param tolerance   on the error, > 0
  /// @param max_points  about as many points are spent at most
  Status find(const Facet& from, const Facet& to, std::span<const Blocker> blockers,
              double tolerance, std::uint32_t max_points, VisibleShare* share);

  /// Points spent since the integrator was made.
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
  };

  Status sample(const Cell& cell, Sums* sums);
  Status refine(const Cell& cell, const Sums& sums, double tolerance, Sums* refined,
                double* error);

  Vec3 normal_, to_normal_;
  const Facet* to_ = nullptr;
  std::span<const Blocker> blockers_;
  double all_ = 0; ///< the sum of `whole` over the first cells
  std::uint64_t point_count_ = 0, point_limit_ = 0;
  VisiblePart visible_;
};

} // namespace hemicube::radiosity
