#pragma once

#include "tests/support/looks.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hemicube::test {

/// Polygons and a look at them.
struct RasterFuzzCase {
  PolygonSet polygons;
  Look look;
};

/// Any bytes are a case: up to 64 polygons, among them slivers, polygons with an edge or a corner
/// in the plane of the eye, through the eye and around it, edge-on ones, repeated vertices, copies
/// a last bit apart, sizes from 2^-100 to 2^100, far from the origin or near it.
RasterFuzzCase decode_raster_case(std::span<const std::uint8_t> bytes);

/// Compares what every instruction set draws, with culling, with what the scalar kernels draw
/// without; small cases also with their polygons drawn alone.
/// @return what differs; empty if nothing does
std::string check_raster_case(const RasterFuzzCase& fuzz);

} // namespace hemicube::test
