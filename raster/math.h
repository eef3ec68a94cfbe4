#pragma once

// The only include of GLM. Its macros are pinned here: the intrinsics of GLM_FORCE_INTRINSICS
// change both the layout of a vector and the bits of its arithmetic.
#if defined(GLM_FORCE_INTRINSICS) || defined(GLM_FORCE_DEFAULT_ALIGNED_GENTYPES)
#error "hemicube needs GLM without intrinsics and without aligned types: results would differ"
#endif
#if defined(__FAST_MATH__)
#error "hemicube must not be compiled with -ffast-math: results would not be reproducible"
#endif

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace hemicube {

using Vec3 = glm::dvec3;
static_assert(sizeof(Vec3) == 24, "Vec3 must be three packed doubles");

/// The vector of length 1 along v; v must not be zero.
inline Vec3 unit(const Vec3& v) {
  return v / glm::length(v);
}

} // namespace hemicube
