#include "tests/support/half_plane_shadow.h"

#include "tests/support/drawn_light.h"
#include "tests/support/lambert.h"

#include <algorithm>
#include <cmath>

namespace hemicube::test {
namespace {

constexpr double kSide = 4, kLampLow = 1.5, kLampHigh = 2.5;

} // namespace

Scene half_plane_shadow(int cells) {
  SceneBuilder builder(1);
  const std::uint32_t floor = builder.material("floor", kHalfPlaneReflectance, 0);
  const std::uint32_t lamp = builder.material("lamp", 0, kHalfPlaneExitance);
  const std::uint32_t black = builder.material("black", 0, 0);
  builder.grid(floor, {0, 0, 0}, {kSide, 0, 0}, {kSide, kSide, 0}, {0, kSide, 0}, cells, cells);
  builder.face(lamp, {{kLampLow, kLampLow, kHalfPlaneLamp},
                      {kLampLow, kLampHigh, kHalfPlaneLamp},
                      {kLampHigh, kLampHigh, kHalfPlaneLamp},
                      {kLampHigh, kLampLow, kHalfPlaneLamp}});
  // As far as any light from the lamp to the floor goes.
  builder.face(black, {{-1, -1, kHalfPlaneHeight},
                       {kHalfPlaneEdge, -1, kHalfPlaneHeight},
                       {kHalfPlaneEdge, 5, kHalfPlaneHeight},
                       {-1, 5, kHalfPlaneHeight}});
  return builder.finish();
}

double half_plane_radiosity(double x, double y) {
  const Vec3 lamp[4] = {{kLampLow, kLampLow, kHalfPlaneLamp},
                        {kLampLow, kLampHigh, kHalfPlaneLamp},
                        {kLampHigh, kLampHigh, kHalfPlaneLamp},
                        {kLampHigh, kLampLow, kHalfPlaneLamp}};
  const Vec3 point(x, y, 0);
  // Through the point and the edge, which runs along y; its positive side has the larger x.
  const Vec3 to_edge(kHalfPlaneEdge - x, 0, kHalfPlaneHeight);
  const Vec3 beyond(to_edge.z, 0, -to_edge.x);
  const std::vector<Vec3> seen = clipped(lamp, point, beyond);
  if (seen.size() < 3)
    return 0;
  return kHalfPlaneReflectance * kHalfPlaneExitance *
         lambert_form_factor(point, Vec3(0, 0, 1), seen);
}

ShadowError half_plane_error(const PatchSet& elements, std::span<const double> radiosity) {
  constexpr int kGrid = 200;
  DrawnLight light(elements, radiosity, 1);
  ShadowError error;
  double squares = 0, all = 0;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const double x = kSide * (i + 0.5) / kGrid, y = kSide * (j + 0.5) / kGrid;
      const double expected = half_plane_radiosity(x, y);
      double drawn = 0;
      light.at({x, y, 0}, {0, 0, 1}, {&drawn, 1});
      const double difference = drawn - expected;
      squares += difference * difference;
      all += expected * expected;
      error.largest = std::max(error.largest, std::fabs(difference));
    }
  error.rms = std::sqrt(squares / all);
  return error;
}

} // namespace hemicube::test
