// Uniform and adaptive meshes: error against the number of elements and against time.
// Usage: refinement_bench OUTPUT_FOLDER
#include "bench/machine.h"
#include "bench/refinement/merged_quads.h"
#include "bench/refinement/truth_patches.h"
#include "radiosity/adaptive.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"
#include "tests/support/reference.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>

using namespace hemicube;
using namespace hemicube::bench;
using namespace hemicube::radiosity;

namespace {

constexpr int kUniformLevels = 4;
constexpr double kMultiples[] = {1.25, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32}; ///< of the patches
constexpr double kFineVariation = 0.01; ///< so that the number of elements is what ends it
constexpr double kMostElements = 6000;

/// Which mesh to begin with: the reference mesh with quads put together so often.
struct Base {
  const char* scene;
  int merges;
};
constexpr Base kBases[] = {{"tableroom_a", 2}, {"cornell", 2}, {"corner2_90_a", 2}};

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double longest_edge(const PatchSet& patches, std::uint32_t patch) {
  const auto corners = patches.corners_of(patch);
  double longest = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    longest = std::max(longest, glm::length(patches.vertices[corners[(k + 1) % corners.size()]] -
                                            patches.vertices[corners[k]]));
  return longest;
}

/// Each patch cut into 4^level.
PatchSet uniform_mesh(const PatchSet& patches, int level) {
  std::vector<double> limits;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    limits.push_back(longest_edge(patches, i) * 1.05 / (1 << level));
  PatchSet elements;
  MeshReport report;
  test::require(subdivide(patches, limits, &elements, &report));
  elements.front_count = elements.patch_count();
  return elements;
}

class Comparison {
public:
  Comparison(const Base& base, std::ofstream* csv)
      : name_(base.scene), csv_(*csv), scene_(merge_quads(reference_mesh(), base.merges)),
        patches_(test::patches_of(scene_)), truth_(read_truth()) {
    options_.error = 0.3; // of rung adaptive: its form factors are finer than any of the meshes
  }

  void run(Rung rung) {
    options_.rung = rung;
    for (int level = 0; level < kUniformLevels; ++level) {
      const PatchSet elements = uniform_mesh(patches_, level);
      if (elements.patch_count() > kMostElements)
        break;
      Solution solution;
      Certificate certificate;
      const double start = processor_seconds();
      test::require(
          solve_scene(scene_, elements, options_, executor_, nullptr, &solution, &certificate));
      write("uniform", elements, 0, elements.patch_count(), processor_seconds() - start, solution,
            certificate);
    }
    for (const double multiple : kMultiples) {
      Refinement limits;
      limits.variation = kFineVariation;
      limits.max_elements = static_cast<std::uint64_t>(multiple * patches_.patch_count());
      if (static_cast<double>(limits.max_elements) > kMostElements)
        break;
      ElementTree tree;
      PatchSet elements;
      Solution solution;
      Certificate certificate;
      RefinementReport report;
      const double start = processor_seconds();
      test::require(solve_adaptive(scene_, patches_, limits, options_, executor_, nullptr, &tree,
                                   &elements, &solution, &certificate, &report));
      write("adaptive", elements, report.rounds, report.rows_gathered, processor_seconds() - start,
            solution, certificate);
    }
  }

private:
  Scene reference_mesh() const { return test::reference_scene("scenes/" + name_ + ".coarse.obj"); }
  TruthPatches read_truth() const {
    return {test::patches_of(reference_mesh()),
            test::reference_json("scenes/" + name_ + ".truth.json").at("coarse").at("B")};
  }

  void write(const char* mesh, const PatchSet& elements, std::uint64_t rounds, std::uint64_t rows,
             double seconds, const Solution& solution, const Certificate& certificate) {
    const std::size_t bands = solution.band_count;
    char line[256];
    std::snprintf(line, sizeof line,
                  "%s,%s,%s,%u,%" PRIu64 ",%" PRIu64 ",%.3g,%.3e,%016" PRIx64 "\n", name_.c_str(),
                  rung_name(options_.rung), mesh, elements.patch_count(), rounds, rows, seconds,
                  truth_.error(elements, solution.radiosity.span(), bands),
                  certificate.radiosity_hash);
    std::fputs(line, stdout);
    std::fflush(stdout);
    csv_ << line << std::flush;
  }

  std::string name_;
  std::ofstream& csv_;
  Scene scene_;
  PatchSet patches_;
  TruthPatches truth_;
  Options options_;
  SerialExecutor executor_;
};

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: refinement_bench OUTPUT_FOLDER\n");
    return 2;
  }
  try {
    const auto folder =
        std::filesystem::path(argv[1]) / (cpu_name() + "_" + raster::best_kernels().name);
    std::filesystem::create_directories(folder);
    std::ofstream csv(folder / "refinement.csv");
    csv << "scene,rung,mesh,elements,rounds,rows,seconds,error,radiosity_hash\n";
    for (const Base& base : kBases) {
      Comparison comparison(base, &csv);
      for (const Rung rung : {Rung::kAdaptive, Rung::kArea})
        comparison.run(rung);
    }
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "refinement_bench: %s\n", failure.what());
    return 1;
  }
  return 0;
}
