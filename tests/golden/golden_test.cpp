// The hashes of hashes.txt, for every instruction set of this machine and several thread counts. A
// hash says "unchanged"; that the results are right is shown by the tests of tests/analytic on
// these scenes.
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/read_scene.h"

#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace hemicube::radiosity {
namespace {

const std::string kFile = HC_SOURCE_DIR "/tests/golden/hashes.txt";

const std::string kCut = "+discontinuity";

struct Golden {
  std::string scene; ///< below the checkout; its patches cut where it ends with kCut
  std::string rung;  ///< adaptive: with its target, "adaptive:0.3"
  std::uint32_t resolution = 0;
  std::string items, form_factors, radiosity;
};

std::vector<Golden> read_goldens() {
  std::vector<Golden> goldens;
  std::ifstream in(kFile);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#')
      continue;
    std::istringstream words(line);
    Golden golden;
    words >> golden.scene >> golden.rung >> golden.resolution >> golden.items >>
        golden.form_factors >> golden.radiosity;
    goldens.push_back(golden);
  }
  return goldens;
}

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, value);
  return text;
}

/// @return false for a name that is no rung
bool parse_rung(const std::string& text, Options* options) {
  const std::string name = text.substr(0, text.find(':'));
  if (name.size() < text.size())
    options->error = std::stod(text.substr(name.size() + 1));
  for (const Rung rung :
       {Rung::kHemicube, Rung::kAnalytic, Rung::kArea, Rung::kAdaptive, Rung::kExact})
    if (name == rung_name(rung)) {
      options->rung = rung;
      return true;
    }
  return false;
}

Golden compute(const Golden& golden, const raster::Kernels& kernels, std::uint32_t threads) {
  Golden result = golden;
  Scene scene;
  ReadReport read;
  PatchSet patches;
  MeshReport mesh;
  const bool is_cut = golden.scene.ends_with(kCut);
  const std::string path =
      HC_SOURCE_DIR "/" + golden.scene.substr(0, golden.scene.size() - (is_cut ? kCut.size() : 0));
  for (const Status& status :
       {read_scene(path, &scene, &read), build_patches(scene, &patches, &mesh)})
    EXPECT_TRUE(status.ok()) << status.message();
  if (is_cut) {
    PatchSet elements;
    DiscontinuityReport report;
    std::vector<DiscontinuityLine> lines;
    EXPECT_TRUE(cut_discontinuities(scene, patches, {}, &elements, &lines, &report).ok());
    patches = std::move(elements);
  }
  ThreadPool pool;
  EXPECT_TRUE(pool.init(threads).ok());
  Options options;
  EXPECT_TRUE(parse_rung(golden.rung, &options)) << golden.rung;
  options.resolution = golden.resolution;
  options.hash_items = true;
  options.kernels = &kernels;
  Solution solution;
  Certificate certificate;
  const Status status =
      solve_scene(scene, patches, options, pool, nullptr, &solution, &certificate);
  EXPECT_TRUE(status.ok()) << status.message();
  result.items = hex(certificate.item_hash);
  result.form_factors = hex(certificate.form_factor_hash);
  result.radiosity = hex(certificate.radiosity_hash);
  return result;
}

std::string text(const Golden& golden) {
  return golden.scene + " " + golden.rung + " " + std::to_string(golden.resolution) + " " +
         golden.items + " " + golden.form_factors + " " + golden.radiosity;
}

TEST(Golden, HashesAreThoseOnFile) {
  const std::vector<Golden> goldens = read_goldens();
  ASSERT_FALSE(goldens.empty()) << kFile << " has no line";
  if (std::getenv("HEMICUBE_WRITE_GOLDEN") != nullptr) {
    std::string lines =
        "# scene rung resolution items form_factors radiosity; rewritten by `make golden`\n";
    for (const Golden& golden : goldens)
      lines += text(compute(golden, raster::best_kernels(), 1)) + "\n";
    std::ofstream(kFile) << lines;
    return;
  }
  for (const Golden& golden : goldens)
    for (const char* isa : {"scalar", "sse41", "avx2", "avx512"})
      for (const std::uint32_t threads : {1u, 2u, 3u, 7u}) {
        const raster::Kernels* kernels = raster::kernels_by_name(isa);
        // Slow, or hardly a matter of vectors: once is enough.
        const bool is_slow = std::string(isa) == "scalar" || golden.rung != "hemicube";
        if (kernels == nullptr || (is_slow && threads != 2))
          continue;
        EXPECT_EQ(text(compute(golden, *kernels, threads)), text(golden))
            << "actual, expected; isa " << isa << ", " << threads << " threads";
      }
}

} // namespace
} // namespace hemicube::radiosity
