#pragma once

#include "radiosity/mesh/patch_set.h"
#include "raster/face_view.h"
#include "raster/polygons.h"

namespace hemicube::radiosity {

/// The patches as the rasterizer takes them: patch ids are polygon ids.
raster::Polygons polygons_of(const PatchSet& patches) noexcept;

/// The view of a patch's hemicube: eye at its centre, axis_z its normal, axis_x its first edge
/// turned by 22.5 degrees, the same for all, so that pixel rows do not run along the edges of
/// rooms. It depends on the patch's own vertices only; the patch itself is not drawn.
raster::View hemicube_view(const PatchSet& patches, std::uint32_t patch) noexcept;

/// The same for a part of a patch: eye at its centre, axis_x from its own first edge.
/// @param part  convex, in the patch's plane
raster::View hemicube_view(const PatchSet& patches, std::uint32_t patch,
                           std::span<const Vec3> part) noexcept;

/// The same at a point: axis_x starts from the coordinate axis least aligned with the normal (x
/// before y before z among equals).
raster::View hemicube_view(const Vec3& point, const Vec3& normal) noexcept;

} // namespace hemicube::radiosity
