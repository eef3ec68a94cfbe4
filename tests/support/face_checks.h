#pragma once

#include "radiosity/form_factor/occluder_faces.h"
#include "tests/support/polygon_lists.h"

namespace hemicube::test {

radiosity::OccluderFaces faces_of(const PatchSet& patches);

/// What OccluderFaces promises of any patches, as GoogleTest expectations: every patch in one face;
/// faces convex, planar, of at most 32 corners, with their normals; areas; patch corners within the
/// rounding of coordinates of their face. And by random points: of a face, that they lie in one of
/// its patches, and in no second; of a patch, that they lie in its face.
/// @param points  per face and per patch
void expect_faces_cover(const PatchSet& patches, const radiosity::OccluderFaces& faces,
                        int points = 20);

/// The number of faces, after those checks.
std::uint32_t checked_count(const PatchSet& patches);
/// The same; expects each polygon to be a patch.
std::uint32_t checked_count(const PolygonList& polygons);

} // namespace hemicube::test
