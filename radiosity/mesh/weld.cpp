#include "radiosity/mesh/weld.h"

#include <algorithm>
#include <bit>
#include <compare>

namespace hemicube::radiosity {
namespace {

// Bits order every number, also NaN; adding 0 makes -0 a 0.
struct Key {
  std::uint64_t x, y, z;
  auto operator<=>(const Key&) const = default;
};

Key key_of(const Vec3& v) {
  return {std::bit_cast<std::uint64_t>(v.x + 0.0), std::bit_cast<std::uint64_t>(v.y + 0.0),
          std::bit_cast<std::uint64_t>(v.z + 0.0)};
}

} // namespace

Status weld_positions(std::span<const Vec3> vertices, Buffer<std::uint32_t>* first) {
  Buffer<std::uint32_t> order;
  HC_TRY(order.resize(vertices.size()));
  HC_TRY(first->resize(vertices.size()));
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<std::uint32_t>(i);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Key left = key_of(vertices[a]), right = key_of(vertices[b]);
    return left != right ? left < right : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key_of(vertices[order[i]]) == key_of(vertices[order[i - 1]]);
    (*first)[order[i]] = same ? (*first)[order[i - 1]] : order[i];
  }
  return {};
}

} // namespace hemicube::radiosity
