// A libFuzzer target: bytes become polygons and a view; every instruction set, with and without
// culling, must draw the same bits. A difference stops the program with its place.

#include "tests/fuzz/raster_fuzz_case.h"

#include <cstdio>
#include <cstdlib>

/// Without the huge pages of the default, which cost more than a small drawing.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  hemicube::set_allocator(
      {[](std::size_t bytes) { return std::aligned_alloc(64, (bytes + 63) / 64 * 64); },
       [](void* memory, std::size_t) { std::free(memory); }});
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace test = hemicube::test;
  const test::RasterFuzzCase fuzz = test::decode_raster_case({data, size});
  const std::string what = test::check_raster_case(fuzz);
  if (!what.empty()) {
    std::fprintf(stderr, "%u polygons; %s\n", fuzz.polygons.count(), what.c_str());
    std::abort();
  }
  return 0;
}
