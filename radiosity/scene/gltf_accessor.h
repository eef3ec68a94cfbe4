#pragma once

#include "radiosity/scene/gltf_file.h"
#include "raster/math.h"
#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Appends the positions that an accessor (VEC3) gives. Floats, and integers, normalised or not, as
/// extension KHR_mesh_quantization has them.
/// @return kBadScene for a reference that leads nowhere, bytes outside their buffer view, a
///         coordinate that is not a finite number, a sparse accessor; also as GltfFile
Status read_positions(GltfFile* file, const GltfFile::Item& accessor, Buffer<Vec3>* positions);

/// Fills the vertex indices that an accessor (SCALAR, an unsigned integer type) gives.
/// @param vertex_count  all must be below
Status read_indices(GltfFile* file, const GltfFile::Item& accessor, std::uint64_t vertex_count,
                    Buffer<std::uint32_t>* indices);

} // namespace hemicube::radiosity
