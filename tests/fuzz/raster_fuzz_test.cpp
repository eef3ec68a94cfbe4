// The cases of the fuzzer, from seeded bytes: what it found in long runs stays found in short ones.

#include "tests/fuzz/raster_fuzz_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hemicube::test {
namespace {

std::vector<std::uint8_t> seeded_bytes(std::uint32_t seed) {
  Random random(seed);
  std::vector<std::uint8_t> bytes(8 + random.index(random.index(8) == 0 ? 1500 : 200));
  for (std::uint8_t& byte : bytes)
    byte = static_cast<std::uint8_t>(random.index(256));
  return bytes;
}

// Catches: whatever the fuzzer catches, in the first few hundred cases of every change.
TEST(RasterFuzz, SeededBytesAreDrawnTheSameByAll) {
  for (std::uint32_t seed = 0; seed < 600; ++seed) {
    const RasterFuzzCase fuzz = decode_raster_case(seeded_bytes(seed));
    ASSERT_EQ(check_raster_case(fuzz), "")
        << "seed " << seed << ", " << fuzz.polygons.count() << " polygons";
  }
}

// Catches: a crash, or a loop without end, on numbers that no reader lets through: they need not be
// drawn well, but must not take the program down.
TEST(RasterFuzz, ImpossibleNumbersDoNoHarm) {
  const double numbers[] = {1e200, -1e308, HUGE_VAL, -HUGE_VAL, NAN, 5e-324, 0x1p100, 0};
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    RasterFuzzCase fuzz = decode_raster_case(seeded_bytes(1000 + seed));
    Random random(seed);
    for (Vec3& vertex : fuzz.polygons.vertices)
      if (random.index(4) == 0)
        vertex[static_cast<int>(random.index(3))] = numbers[random.index(8)];
    if (seed % 4 == 0)
      fuzz.look.view.eye.x = numbers[random.index(8)];
    for (const std::string& isa : kernels_here()) {
      Drawer drawer(fuzz.polygons.view(), *raster::kernels_by_name(isa));
      draw_look(&drawer, fuzz.look);
    }
  }
}

} // namespace
} // namespace hemicube::test
