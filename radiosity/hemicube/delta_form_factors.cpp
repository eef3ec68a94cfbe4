#include "radiosity/hemicube/delta_form_factors.h"

#include "radiosity/elementary.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Integral of the top's density 1 / (pi (1 + x^2 + y^2)^2) over the rectangle from (0,0) to (x,y).
double top_integral(double x, double y) {
  const double p = 1 / std::sqrt(1 + x * x);
  const double q = 1 / std::sqrt(1 + y * y);
  return (x * p * arctangent(y * p) + y * q * arctangent(x * q)) / (2 * kPi);
}

/// Integral of a side's density y / (pi (1 + x^2 + y^2)^2) over the rectangle from (0,0) to (x,y),
/// y the height above the horizon.
double side_integral(double x, double y) {
  const double q = 1 / std::sqrt(1 + y * y);
  return (arctangent(x) - q * arctangent(x * q)) / (2 * kPi);
}

/// Fills running sums over the rows of a face whose first row starts at y = bottom. `integral` is
/// odd in x: what lies left of x is integral(1, y) + integral(x, y).
template <typename Integral>
Status fill_sums(std::uint32_t columns, std::uint32_t rows, double bottom, Integral integral,
                 std::span<std::uint64_t> sums) {
  const double step = 2.0 / columns;
  Buffer<double> below; // [column edge] integral up to the lower edge of the row
  HC_TRY(below.resize(columns + 1));
  for (std::uint32_t i = 0; i <= columns; ++i)
    below[i] = integral(-1 + i * step, bottom);
  const double start = below[columns];
  std::size_t at = 0;
  for (std::uint32_t j = 0; j < rows; ++j) {
    const double top = bottom + (j + 1) * step;
    const double rows_before = 2 * (below[columns] - start);
    const double right_below = below[columns], right_above = integral(1, top);
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double in_row = (integral(-1 + i * step, top) + right_above) - (below[i] + right_below);
      const double before = (rows_before + in_row) * static_cast<double>(kFormFactorUnit);
      sums[at++] = static_cast<std::uint64_t>(before + 0.5);
    }
    for (std::uint32_t i = 0; i <= columns; ++i)
      below[i] = integral(-1 + i * step, top);
  }
  const double all = 2 * (below[columns] - start) * static_cast<double>(kFormFactorUnit);
  sums[at] = static_cast<std::uint64_t>(all + 0.5);
  return {};
}

} // namespace

Status DeltaFormFactors::init(std::uint32_t resolution) {
  if (resolution < kMinResolution || resolution > kMaxResolution || resolution % 2 != 0)
    return Status::error(StatusCode::kInvalidArgument, "resolution ", resolution,
                         " is not an even number from ", kMinResolution, " to ", kMaxResolution);
  resolution_ = resolution;
  const std::size_t pixels = std::size_t{resolution} * resolution;
  side_begin_ = pixels + 1;
  HC_TRY(sums_.reserve_huge(side_begin_ + pixels / 2 + 1));
  HC_TRY(sums_.resize(side_begin_ + pixels / 2 + 1));
  const std::span<std::uint64_t> top = sums_.span().first(side_begin_);
  const std::span<std::uint64_t> side = sums_.span().subspan(side_begin_);
  HC_TRY(fill_sums(resolution, resolution, -1, top_integral, top));
  HC_TRY(fill_sums(resolution, resolution / 2, 0, side_integral, side));
  // Four rounded sides leave the top, also rounded, at most three units off: its last pixel takes
  // them.
  top.back() = kFormFactorUnit - 4 * side.back();
  return {};
}

} // namespace hemicube::radiosity
