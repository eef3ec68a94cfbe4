// Uniform, adaptive and discontinuity meshes: error against the number of elements and against
// time. Usage: refinement_bench OUTPUT_FOLDER
#include "bench/machine.h"
#include "bench/refinement/merged_quads.h"
#include "bench/refinement/truth_patches.h"
#include "radiosity/adaptive.h"
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"
#include "tests/support/half_plane_shadow.h"
#include "tests/support/reference.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>

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
  int floor = -1; ///< the axis that is 0 there; < 0: not looked at
};
constexpr Base kBases[] = {{"tableroom_a", 2, 2}, {"cornell", 2, 1}, {"corner2_90_a", 2}};

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

/// Each patch cut into 4^level. @param patches  fronts
PatchSet uniform_mesh(const PatchSet& patches, int level) {
  std::vector<double> limits;
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    limits.push_back(longest_edge(patches, i) * 1.05 / (1 << level));
  PatchSet elements;
  MeshReport report;
  test::require(subdivide(patches, limits, &elements, &report));
  return elements;
}

PatchSet fronts_of(const Scene& scene) {
  PatchSet patches;
  MeshReport report;
  test::require(build_patches(scene, &patches, &report));
  return patches;
}

PatchSet cut(const Scene& scene, const PatchSet& patches) {
  PatchSet elements;
  DiscontinuityReport report;
  std::vector<DiscontinuityLine> lines;
  test::require(cut_discontinuities(scene, patches, {}, &elements, &lines, &report));
  return elements;
}

/// Of light on elements: of their means, and of what is drawn of them.
struct MeshError {
  double mean = std::nan(""), drawn = std::nan("");
};
using ErrorOf = std::function<MeshError(const PatchSet& elements, std::span<const double> radiosity,
                                        std::size_t bands)>;

class Comparison {
public:
  Comparison(std::string name, const Scene& scene, ErrorOf error_of, std::ofstream* csv)
      : name_(std::move(name)), csv_(*csv), scene_(scene), error_of_(std::move(error_of)) {
    options_.error = 0.3; // of rung adaptive: its form factors are finer than any of the meshes
  }

  void run(Rung rung) {
    options_.rung = rung;
    const PatchSet patches = fronts_of(scene_);
    for (int level = 0; level < kUniformLevels; ++level)
      solve("uniform", [&] { return uniform_mesh(patches, level); });
    for (int level = 0; level < kUniformLevels; ++level)
      solve("discontinuity", [&] { return cut(scene_, uniform_mesh(patches, level)); });
    for (const double multiple : kMultiples)
      refine("adaptive", multiple * patches.patch_count(), [&] { return fronts_of(scene_); });
    for (const double multiple : kMultiples)
      refine("both", multiple * patches.patch_count(),
             [&] { return cut(scene_, fronts_of(scene_)); });
  }

private:
  template <typename MakeMesh> void solve(const char* mesh, MakeMesh make_mesh) {
    const double start = processor_seconds();
    PatchSet elements = make_mesh();
    test::require(add_back_sides(scene_, &elements));
    if (elements.patch_count() > kMostElements)
      return;
    Solution solution;
    Certificate certificate;
    test::require(
        solve_scene(scene_, elements, options_, executor_, nullptr, &solution, &certificate));
    write(mesh, elements, 0, elements.patch_count(), processor_seconds() - start, solution,
          certificate);
  }

  template <typename MakeMesh>
  void refine(const char* mesh, double most_elements, MakeMesh make_mesh) {
    const double start = processor_seconds();
    PatchSet patches = make_mesh();
    test::require(add_back_sides(scene_, &patches));
    Refinement limits;
    limits.variation = kFineVariation;
    limits.max_elements = static_cast<std::uint64_t>(most_elements);
    if (limits.max_elements < patches.patch_count() || most_elements > kMostElements)
      return;
    ElementTree tree;
    PatchSet elements;
    Solution solution;
    Certificate certificate;
    RefinementReport report;
    test::require(solve_adaptive(scene_, patches, limits, options_, executor_, nullptr, &tree,
                                 &elements, &solution, &certificate, &report));
    write(mesh, elements, report.rounds, report.rows_gathered, processor_seconds() - start,
          solution, certificate);
  }

  void write(const char* mesh, const PatchSet& elements, std::uint64_t rounds, std::uint64_t rows,
             double seconds, const Solution& solution, const Certificate& certificate) {
    const MeshError error = error_of_(elements, solution.radiosity.span(), solution.band_count);
    char line[256];
    std::snprintf(line, sizeof line,
                  "%s,%s,%s,%u,%" PRIu64 ",%" PRIu64 ",%.3g,%.3e,%.3e,%016" PRIx64 "\n",
                  name_.c_str(), rung_name(options_.rung), mesh, elements.patch_count(), rounds,
                  rows, seconds, error.mean, error.drawn, certificate.radiosity_hash);
    std::fputs(line, stdout);
    std::fflush(stdout);
    csv_ << line << std::flush;
  }

  std::string name_;
  std::ofstream& csv_;
  const Scene& scene_;
  ErrorOf error_of_;
  Options options_;
  SerialExecutor executor_;
};

/// On the rung whose form factors are finer than the meshes, and on one that costs less.
void compare(std::string name, const Scene& scene, ErrorOf error_of, std::ofstream* csv) {
  Comparison comparison(std::move(name), scene, std::move(error_of), csv);
  for (const Rung rung : {Rung::kAdaptive, Rung::kArea})
    comparison.run(rung);
}

TruthPatches truth_of(const std::string& mesh, const nlohmann::json& radiosity) {
  return {test::patches_of(test::reference_scene("scenes/" + mesh + ".obj")), radiosity};
}

/// Against the continuous solution: means over the patches of the reference mesh; what is drawn on
/// the floor, where the shadows fall, over those of a finer one.
void compare_with_truth(const Base& base, std::ofstream* csv) {
  const std::string name = base.scene, mesh = "scenes/" + name;
  const TruthPatches coarse =
      truth_of(name + ".coarse", test::reference_json(mesh + ".truth.json").at("coarse").at("B"));
  std::optional<TruthPatches> fine;
  if (base.floor >= 0)
    fine = truth_of(name + ".fine", test::reference_json(mesh + ".fine_truth.json").at("B"));
  const Scene scene = merge_quads(test::reference_scene(mesh + ".coarse.obj"), base.merges);
  compare(
      name, scene,
      [&](const PatchSet& elements, std::span<const double> radiosity, std::size_t bands) {
        MeshError error;
        error.mean = coarse.error(elements, radiosity, bands);
        if (fine)
          error.drawn = fine->drawn_error(elements, radiosity, bands, base.floor);
        return error;
      },
      csv);
}

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
    csv << "scene,rung,mesh,elements,rounds,rows,seconds,error,drawn_error,radiosity_hash\n";
    // Against the known light of every point, as it is drawn.
    compare(
        "half_plane", test::half_plane_shadow(4),
        [](const PatchSet& elements, std::span<const double> radiosity, std::size_t) {
          return MeshError{std::nan(""), test::half_plane_error(elements, radiosity).rms};
        },
        &csv);
    for (const Base& base : kBases)
      compare_with_truth(base, &csv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "refinement_bench: %s\n", failure.what());
    return 1;
  }
  return 0;
}
