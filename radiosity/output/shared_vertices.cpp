#include "radiosity/output/shared_vertices.h"

#include "radiosity/mesh/weld.h"

namespace hemicube::radiosity {

Status find_shared_vertices(const PatchSet& patches, SharedVertices* shared) {
  *shared = SharedVertices{};
  HC_TRY(weld_positions(patches.vertices.span(), &shared->position));

  const std::size_t corner_count = patches.corners.size();
  HC_TRY(shared->offsets.resize(patches.vertices.size() + 1));
  HC_TRY(shared->corners.resize(corner_count));
  HC_TRY(shared->corner_patch.resize(corner_count));
  Buffer<std::uint32_t>& offsets = shared->offsets;
  for (const std::uint32_t vertex : patches.corners)
    ++offsets[shared->position[vertex]];
  std::uint32_t end = 0;
  for (std::uint32_t& offset : offsets) {
    end += offset;
    offset = end;
  }
  for (std::size_t corner = corner_count; corner-- > 0;) // backwards: ascending within a position
    shared->corners[--offsets[shared->position[patches.corners[corner]]]] =
        static_cast<std::uint32_t>(corner);
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    for (std::uint32_t c = patches.corner_offsets[patch]; c < patches.corner_offsets[patch + 1];
         ++c)
      shared->corner_patch[c] = patch;
  return {};
}

} // namespace hemicube::radiosity
