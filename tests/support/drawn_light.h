#pragma once

#include "radiosity/mesh/patch_set.h"
#include "raster/memory.h"

#include <span>
#include <vector>

namespace hemicube::test {

/// The light of a solution as pictures show it: reconstructed between the corners of elements.
class DrawnLight {
public:
  /// @param elements   outlive this
  /// @param radiosity  [element][band]
  DrawnLight(const radiosity::PatchSet& elements, std::span<const double> radiosity,
             std::uint32_t bands);

  /// @param point   on a surface with about this unit normal; a little beside an element is on it
  /// @param values  receives [band]
  /// Throws std::runtime_error if there is no element.
  void at(const Vec3& point, const Vec3& normal, std::span<double> values);

private:
  bool contains(std::uint32_t element, const Vec3& point, const Vec3& normal) const;

  const radiosity::PatchSet& elements_;
  std::uint32_t bands_;
  Buffer<float> corner_radiosity_;
  Buffer<std::uint8_t> is_straight_;
  std::vector<Vec3> low_, high_;
  std::uint32_t last_ = 0; ///< where the last point was
};

} // namespace hemicube::test
