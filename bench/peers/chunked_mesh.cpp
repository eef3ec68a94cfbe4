#include "bench/peers/chunked_mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

namespace hemicube::bench {
namespace {

using radiosity::PatchSet;

/// Within a chunk, too, patches come in groups of neighbours.
constexpr std::size_t kNeighbours = 16;

struct Box {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};

  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  int longest_axis() const {
    const Vec3 d = high - low;
    return d.x >= d.y && d.x >= d.z ? 0 : (d.y >= d.z ? 1 : 2);
  }
};

/// Orders patches so that every `leaf` consecutive ones are neighbours: median splits.
void sort_spatially(const PatchSet& patches, std::span<std::uint32_t> order, std::size_t leaf) {
  if (order.size() <= leaf)
    return;
  Box box;
  for (const std::uint32_t patch : order)
    box.add(patches.centre[patch]);
  const int axis = box.longest_axis();
  const std::size_t leaves = (order.size() + leaf - 1) / leaf;
  const std::size_t middle = leaves / 2 * leaf;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(middle), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double at_a = patches.centre[a][axis], at_b = patches.centre[b][axis];
                     return at_a < at_b || (at_a == at_b && a < b);
                   });
  sort_spatially(patches, order.first(middle), leaf);
  sort_spatially(patches, order.subspan(middle), leaf);
}

/// Appends chunks to a mesh.
class ChunkBuilder {
public:
  ChunkBuilder(const PatchSet& patches, ChunkedMesh* mesh)
      : patches_(patches), mesh_(*mesh), slots_(patches.vertices.size(), kNone) {}

  void append(std::span<const std::uint32_t> chunk_patches) {
    begin_ = mesh_.vertices.size();
    taken_.clear();
    Chunk chunk;
    chunk.first_index = static_cast<std::uint32_t>(mesh_.indices.size());
    Box box;
    for (const std::uint32_t patch : chunk_patches) {
      mesh_.chunk_of[patch] = static_cast<std::uint32_t>(mesh_.chunks.size());
      append_patch(patch);
      for (const std::uint32_t corner : patches_.corners_of(patch))
        box.add(patches_.vertices[corner] - mesh_.centre);
    }
    for (const std::uint32_t patch : chunk_patches)
      for (const std::uint32_t corner : patches_.corners_of(patch))
        slots_[corner] = kNone;
    chunk.end_index = static_cast<std::uint32_t>(mesh_.indices.size());
    chunk.centre = (box.low + box.high) * 0.5;
    chunk.half = (box.high - box.low) * 0.5;
    mesh_.chunks.push_back(chunk);
  }

private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::uint32_t append_vertex(std::uint32_t corner) {
    const Vec3 p = patches_.vertices[corner] - mesh_.centre;
    mesh_.vertices.push_back(
        {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0});
    taken_.push_back(false);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  std::uint32_t slot_of(std::uint32_t corner) {
    if (slots_[corner] == kNone)
      slots_[corner] = append_vertex(corner);
    return slots_[corner];
  }

  void append_patch(std::uint32_t patch) {
    const auto corners = patches_.corners_of(patch);
    // The fan starts at a corner that no other patch starts at, or else at a copy of the first.
    std::size_t start = 0;
    while (start < corners.size() && taken_[slot_of(corners[start]) - begin_])
      ++start;
    const bool copied = start == corners.size();
    start = copied ? 0 : start;
    const std::uint32_t first = copied ? append_vertex(corners[0]) : slots_[corners[start]];
    taken_[first - begin_] = true;
    mesh_.vertices[first].id = patch;
    mesh_.first_index[patch] = static_cast<std::uint32_t>(mesh_.indices.size());
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const std::uint32_t second = slot_of(corners[(start + k) % corners.size()]);
      const std::uint32_t third = slot_of(corners[(start + k + 1) % corners.size()]);
      mesh_.indices.insert(mesh_.indices.end(), {first, second, third});
    }
  }

  const PatchSet& patches_;
  ChunkedMesh& mesh_;
  std::vector<std::uint32_t> slots_; ///< [vertex of the patches] its vertex in this chunk
  std::vector<bool> taken_;          ///< [vertex of this chunk] holds the number of a patch
  std::size_t begin_ = 0;            ///< first vertex of this chunk
};

} // namespace

ChunkedMesh build_chunks(const PatchSet& patches, std::uint32_t chunk_size) {
  ChunkedMesh mesh;
  Box box;
  for (const Vec3& vertex : patches.vertices)
    box.add(vertex);
  mesh.centre = (box.low + box.high) * 0.5;
  mesh.size = glm::length(box.high - box.low);
  mesh.chunk_of.resize(patches.patch_count());
  mesh.first_index.resize(patches.patch_count());
  std::vector<std::uint32_t> order(patches.patch_count());
  std::iota(order.begin(), order.end(), 0u);
  sort_spatially(patches, order, chunk_size);
  ChunkBuilder builder(patches, &mesh);
  for (std::size_t first = 0; first < order.size(); first += chunk_size) {
    const std::span<std::uint32_t> chunk = std::span<std::uint32_t>(order).subspan(
        first, std::min<std::size_t>(chunk_size, order.size() - first));
    sort_spatially(patches, chunk, kNeighbours);
    builder.append(chunk);
  }
  return mesh;
}

} // namespace hemicube::bench
