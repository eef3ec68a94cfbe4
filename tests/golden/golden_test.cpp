// The hashes of hashes.txt, for every instruction set of this machine and several thread counts. A
// hash says "unchanged"; that the results are right is shown by the tests of tests/analytic on
// these scenes.
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/scene/read_scene.h"
#include "raster/simd/dispatch.h"
#include "tests/golden/golden_file.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace hemicube::radiosity::test {
namespace {

Scene scene_of(const GoldenCase& golden) {
  Scene scene;
  ReadReport report;
  const Status status = read_scene(HC_SOURCE_DIR "/" + golden.scene_file(), &scene, &report);
  EXPECT_TRUE(status.ok()) << status.message();
  return scene;
}

GoldenCase compute(const GoldenCase& golden, const Scene& scene, const raster::Kernels& kernels,
                   std::uint32_t threads) {
  GoldenCase result = golden;
  ThreadPool pool;
  EXPECT_TRUE(pool.init(threads).ok());
  const Status status = compute_hashes(scene, kernels, pool, &result);
  EXPECT_TRUE(status.ok()) << status.message();
  return result;
}

TEST(Golden, HashesAreThoseOnFile) {
  const std::vector<GoldenCase> goldens = read_golden_cases();
  ASSERT_FALSE(goldens.empty()) << kGoldenFile << " has no line";
  if (std::getenv("HEMICUBE_WRITE_GOLDEN") != nullptr) {
    std::string lines =
        "# scene rung resolution items form_factors radiosity; rewritten by `make golden`\n";
    for (const GoldenCase& golden : goldens)
      lines += line_of(compute(golden, scene_of(golden), raster::best_kernels(), 1)) + "\n";
    std::ofstream(kGoldenFile) << lines;
    return;
  }
  for (const GoldenCase& golden : goldens) {
    const Scene scene = scene_of(golden);
    for (const char* isa : {"scalar", "sse41", "avx2", "avx512", "neon"})
      for (const std::uint32_t threads : {1u, 2u, 3u, 7u}) {
        const raster::Kernels* kernels = raster::kernels_by_name(isa);
        // Slow, or hardly a matter of vectors: once is enough.
        const bool is_slow = std::string(isa) == "scalar" || golden.rung != "hemicube";
        if (kernels == nullptr || (is_slow && threads != 2))
          continue;
        EXPECT_EQ(line_of(compute(golden, scene, *kernels, threads)), line_of(golden))
            << "actual, expected; isa " << isa << ", " << threads << " threads";
      }
  }
}

} // namespace
} // namespace hemicube::radiosity::test
