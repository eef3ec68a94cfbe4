// The kernels, written once over the operations of an ops_<isa>.h that the including file has
// pulled into the enclosing namespace. No algorithmic choice depends on the vector width.

#include "raster/simd/nodes.inl"

#include "raster/simd/polygons.inl"

#include "raster/simd/pixels.inl"
