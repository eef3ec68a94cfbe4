// Occluder faces of what nobody drew: random tilings, failing memory, a whole building.
#include "tests/support/face_checks.h"
#include "tests/support/office.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace hemicube::test {
namespace {

using radiosity::OccluderFaces;

/// A rectangle cut in two at a random multiple of 1/64, and the parts again, some as grids.
void cut_at_random(double low_x, double low_y, double high_x, double high_y, int depth,
                   Random& random, PolygonList* list) {
  if (depth == 0) {
    append(list, rectangle_grid(low_x, low_y, high_x, high_y, 1 + static_cast<int>(random.index(3)),
                                1 + static_cast<int>(random.index(3))));
    return;
  }
  const double part = (16 + random.index(33)) / 64.0;
  if (high_x - low_x > high_y - low_y) {
    const double x = low_x + (high_x - low_x) * part;
    cut_at_random(low_x, low_y, x, high_y, depth - 1, random, list);
    cut_at_random(x, low_y, high_x, high_y, depth - 1, random, list);
  } else {
    const double y = low_y + (high_y - low_y) * part;
    cut_at_random(low_x, low_y, high_x, y, depth - 1, random, list);
    cut_at_random(low_x, y, high_x, high_y, depth - 1, random, list);
  }
}

// All at once, in mixes no one thought of: T-vertices on both sides of a line, holes, patches
// twice, patches turned over, triangles, slanted planes, offsets.
TEST(OccluderMixtures, RandomTilings) {
  std::size_t patch_count = 0, face_count = 0;
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    Random random(seed);
    PolygonList list;
    cut_at_random(0, 0, 1.3, 1, static_cast<int>(random.index(7)), random, &list);
    list = shuffled(list, seed);
    if (random.index(2) == 0)
      list.resize(list.size() - list.size() / 8);
    if (random.index(3) == 0)
      list = in_triangles(list, seed);
    if (random.index(3) == 0)
      list.push_back(list[0]);
    if (random.index(3) == 0)
      std::reverse(list[1 % list.size()].begin(), list[1 % list.size()].end());
    if (random.index(2) == 0)
      list = turned(list, random_frame(random));
    if (random.index(3) == 0)
      list = moved(list, random.between(1e-3, 1e3), random.point(-100, 100));
    patch_count += list.size();
    face_count += checked_count(list);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  std::printf("%zu patches, %zu faces\n", patch_count, face_count);
}

int allocations_left = -1; ///< until one fails; < 0: none does

// An error that is lost on the way up, or leaves a buffer half filled.
TEST(OccluderMixtures, EveryAllocationMayFail) {
  set_allocator({[](std::size_t bytes) -> void* {
                   if (allocations_left == 0)
                     return nullptr;
                   allocations_left -= allocations_left > 0;
                   return std::aligned_alloc(64, (bytes + 63) / 64 * 64);
                 },
                 [](void* memory, std::size_t) { std::free(memory); }});
  PolygonList list = rectangle_grid(0, 0, 1, 1, 5, 5);
  append(&list, rectangle_grid(1, 0, 2, 1, 1, 3));
  list.push_back(regular(48));
  const PatchSet patches = patches_of(without(list, {7}));
  for (int fail_at = 0;; ++fail_at) {
    OccluderFaces fresh;
    allocations_left = fail_at;
    const Status status = fresh.build(patches);
    allocations_left = -1;
    if (status.ok()) {
      EXPECT_GT(fail_at, 20);
      expect_faces_cover(patches, fresh);
      break;
    }
    ASSERT_EQ(status.code(), StatusCode::kOutOfMemory);
  }
}

// Costs that grow faster than the mesh: not asserted, but it would not end.
TEST(OccluderMixtures, Office) {
  for (const double cell : {0.5, 0.255}) {
    const PatchSet patches = patches_of(office({4, 4, 2, cell}));
    const auto start = std::chrono::steady_clock::now();
    const OccluderFaces faces = faces_of(patches);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%u patches, %u faces, %.3f s\n", patches.patch_count(), faces.face_count(),
                seconds.count());
    EXPECT_LT(faces.face_count(), 12000u);
    expect_faces_cover(patches, faces, 3);
  }
}

} // namespace
} // namespace hemicube::test
