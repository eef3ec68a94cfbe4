#include "radiosity/output/corner_vertices.h"

#include "raster/hash.h"

#include <bit>
#include <cstring>

namespace hemicube::radiosity {

CornerVertices gather_corner_vertices(const PatchSet& patches,
                                      std::span<const float> corner_radiosity,
                                      std::uint32_t band_count) {
  constexpr std::uint32_t kFree = 0xffffffffu;
  CornerVertices out;
  out.width = 3 + std::size_t{band_count};
  const std::size_t corner_count = patches.corners.size();
  out.of_corner.reserve(corner_count);
  // Vertices by hash, at most half full; a vertex stands in the first free slot from its own.
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * corner_count + 1), kFree);
  std::vector<float> candidate(out.width);
  std::uint32_t count = 0;
  for (std::size_t corner = 0; corner < corner_count; ++corner) {
    const Vec3& v = patches.vertices[patches.corners[corner]];
    for (std::size_t axis = 0; axis < 3; ++axis)
      candidate[axis] = static_cast<float>(v[static_cast<int>(axis)]);
    for (std::size_t band = 0; band < band_count; ++band)
      candidate[3 + band] = corner_radiosity[corner * band_count + band];
    Hash hash;
    for (const float value : candidate)
      hash.add(value);
    std::size_t slot = hash.value() & (slots.size() - 1);
    while (slots[slot] != kFree &&
           std::memcmp(out.position(slots[slot]), candidate.data(), out.width * sizeof(float)) != 0)
      slot = (slot + 1) & (slots.size() - 1);
    if (slots[slot] == kFree) {
      slots[slot] = count++;
      out.values.insert(out.values.end(), candidate.begin(), candidate.end());
    }
    out.of_corner.push_back(slots[slot]);
  }
  return out;
}

} // namespace hemicube::radiosity
