#pragma once

#include "raster/face_view.h"
#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

inline constexpr std::uint32_t kMinResolution = 16;
inline constexpr std::uint32_t kMaxResolution = 2048;

/// Form factors are summed in units of 2^-48: integers, so that no order of summation matters.
inline constexpr std::uint64_t kFormFactorUnit = std::uint64_t{1} << 48;

/// Delta form factors of a hemicube: the share of each pixel in the form factor of what it shows,
/// as running sums over the pixels of a face, row after row, so that a run of pixels costs one
/// difference. Each running sum is the exact integral over its cells, rounded: a run is good to one
/// unit, whatever its length, and the five faces sum to exactly kFormFactorUnit. Source: Cohen and
/// Greenberg 1985, "The hemi-cube"; integrals over pixels instead of their centres.
class DeltaFormFactors {
public:
  /// @param resolution  pixels along the full cube edge; even, kMinResolution..kMaxResolution
  /// @return kInvalidArgument, naming the value; kOutOfMemory
  Status init(std::uint32_t resolution);

  std::uint32_t resolution() const noexcept { return resolution_; }

  /// Sums before each pixel of a face, row-major over raster::hemicube_grid, and one past the last:
  /// the run of pixels [a, b) weighs sums[b] - sums[a].
  std::span<const std::uint64_t> sums(raster::Face face) const noexcept {
    return face == raster::Face::kTop ? sums_.span().first(side_begin_)
                                      : sums_.span().subspan(side_begin_);
  }

  /// The weight of one pixel, in units of 2^-48.
  std::uint64_t weight(raster::Face face, std::int32_t x, std::int32_t y) const noexcept {
    const std::size_t at = static_cast<std::size_t>(y) * resolution_ + static_cast<std::size_t>(x);
    return sums(face)[at + 1] - sums(face)[at];
  }

private:
  std::uint32_t resolution_ = 0;
  std::size_t side_begin_ = 0;
  Buffer<std::uint64_t> sums_; ///< the top's, then a side's
};

} // namespace hemicube::radiosity
