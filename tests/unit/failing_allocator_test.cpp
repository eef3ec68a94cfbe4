// Every request for memory is refused in turn, those of the core, which go to its allocator, as
// those of the adapters, which go to operator new: a status, nothing lost, never another result.

#include "radiosity/adaptive.h"
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "radiosity/output/file_set.h"
#include "radiosity/output/row_file.h"
#include "radiosity/output/solution_files.h"
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/scene/read_scene.h"
#include "raster/hash.h"
#include "raster/memory.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>

#include <unistd.h>

namespace {

constexpr std::int64_t kNone = -1;
std::atomic<std::int64_t> requests{kNone}; ///< since counting began; kNone: none is refused
std::atomic<std::int64_t> alive{0};        ///< blocks of memory
std::int64_t first_refused = 0;
bool refuses_all_after = false;

void* take(std::size_t alignment, std::size_t bytes) noexcept {
  if (requests != kNone) {
    const std::int64_t number = requests++;
    if (number == first_refused || (refuses_all_after && number > first_refused))
      return nullptr;
  }
  void* memory = std::aligned_alloc(alignment, (bytes + alignment) / alignment * alignment);
  alive += memory != nullptr;
  return memory;
}

void give_back(void* memory) noexcept {
  alive -= memory != nullptr;
  std::free(memory);
}

} // namespace

void* operator new(std::size_t bytes) {
  if (void* memory = take(alignof(std::max_align_t), bytes))
    return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return take(alignof(std::max_align_t), bytes);
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}

namespace hemicube::test {
namespace {

using radiosity::Options;
using radiosity::Rung;

/// As long as it lives, requests are counted and refused.
class Refusal {
public:
  Refusal(std::int64_t first, bool all_after) {
    first_refused = first;
    refuses_all_after = all_after;
    requests = 0;
  }
  Refusal(const Refusal&) = delete;
  Refusal& operator=(const Refusal&) = delete;
  ~Refusal() { requests = kNone; }
};

class FailingAllocator : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    set_allocator({[](std::size_t bytes) { return take(64, bytes); },
                   [](void* memory, std::size_t) { give_back(memory); }});
  }

  /// Refuses every request of a run alone, and every 8th with all that follow.
  /// @param run  Status(Hash*), which receives what the run yields
  template <typename Run> static void refuse_each(Run run) {
    Hash expected;
    require(run(&expected));
    std::int64_t asked = 0;
    for (std::int64_t first = 0; first <= asked; ++first)
      for (const bool all_after : {false, true}) {
        if (all_after && first % 8 != 0)
          continue;
        Hash hash;
        Status status;
        const std::int64_t before = alive;
        {
          const Refusal refusal(first, all_after);
          status = run(&hash);
          asked = requests;
        }
        const std::int64_t lost = alive - before;
        SCOPED_TRACE(std::to_string(first) + (all_after ? " and all after" : ""));
        ASSERT_EQ(lost, 0) << "blocks that nobody owns";
        if (status.ok()) // as where a library does without
          ASSERT_EQ(hash.value(), expected.value());
        else
          ASSERT_EQ(status.code(), StatusCode::kOutOfMemory) << status.message();
      }
    EXPECT_GT(asked, 20) << "what was refused?";
  }

  /// A closed room of 6 patches and a sheet in it, seen from both sides.
  static Scene small_room() {
    SceneBuilder builder;
    const std::uint32_t wall = builder.material("wall", 0.5, 0);
    const std::uint32_t lamp = builder.material("lamp", 0, 10);
    const std::uint32_t sheet = builder.material("sheet", 0.3, 0);
    builder.two_sided(sheet);
    builder.box({wall, wall, wall, wall, wall, lamp}, {0, 0, 0}, {1, 1, 1}, {1, 1, 1}, true);
    builder.face(sheet, {{0.5, 0.5, 0.6}, {0.8, 0.5, 0.6}, {0.8, 0.8, 0.6}, {0.5, 0.8, 0.6}});
    return builder.finish();
  }

  static Options on(Rung rung) {
    Options options;
    options.rung = rung;
    options.resolution = 16;
    options.error = 0.5;
    return options;
  }

  static Status solve(const Scene& scene, const PatchSet& patches, const Options& options,
                      radiosity::Executor& executor, Hash* hash) {
    radiosity::Solution solution;
    radiosity::Certificate certificate;
    HC_TRY(radiosity::solve_scene(scene, patches, options, executor, nullptr, &solution,
                                  &certificate));
    hash->add(certificate.radiosity_hash);
    return {};
  }

  void refuse_each_of_a_solve(const Options& options, radiosity::Executor& executor) const {
    refuse_each([&](Hash* hash) { return solve(scene_, patches_, options, executor, hash); });
  }

  const Scene scene_ = small_room();
  const PatchSet patches_ = patches_of(scene_);
  radiosity::SerialExecutor serial_;
};

TEST_F(FailingAllocator, MeshesOfPatches) {
  refuse_each([&](Hash* hash) {
    PatchSet coarse, fine;
    radiosity::MeshReport report;
    HC_TRY(radiosity::build_patches(scene_, &coarse, &report));
    std::vector<double> limits;
    try {
      limits.assign(coarse.patch_count(), 0.4);
    } catch (const std::bad_alloc&) {
      return Status::error(StatusCode::kOutOfMemory, "the test's own");
    }
    HC_TRY(radiosity::subdivide(coarse, limits, &fine, &report));
    HC_TRY(radiosity::add_back_sides(scene_, &fine));
    for (const double area : fine.area)
      hash->add(area);
    return Status();
  });
}

TEST_F(FailingAllocator, SolvesOnEveryRung) {
  // Rung exact does what adaptive does, with another target.
  for (const Rung rung : {Rung::kHemicube, Rung::kAnalytic, Rung::kArea, Rung::kAdaptive}) {
    SCOPED_TRACE(radiosity::rung_name(rung));
    refuse_each_of_a_solve(on(rung), serial_);
  }
}

// Catches: a worker that goes on without its memory, or forgets that it has none.
TEST_F(FailingAllocator, SolvesOnSeveralThreads) {
  radiosity::ThreadPool pool;
  require(pool.init(3));
  for (const Rung rung : {Rung::kHemicube, Rung::kAdaptive})
    refuse_each_of_a_solve(on(rung), pool);
}

TEST_F(FailingAllocator, EverySolverWithAllThereIs) {
  Options options = on(Rung::kHemicube);
  options.solver = radiosity::SolverKind::kJacobi;
  options.balance = options.estimate_error = options.hash_items = true;
  refuse_each_of_a_solve(options, serial_);
  options = on(Rung::kHemicube);
  options.solver = radiosity::SolverKind::kProgressive;
  refuse_each_of_a_solve(options, serial_);
  options = on(Rung::kHemicube);
  options.choose_rung = options.choose_resolution = true;
  refuse_each_of_a_solve(options, serial_);
}

TEST_F(FailingAllocator, FormFactorsOfPatchesAndPoints) {
  const Options options = on(Rung::kAdaptive);
  refuse_each([&](Hash* hash) {
    const std::uint32_t rows[] = {1, 7};
    const radiosity::Receiver points[] = {{{0.5, 0.5, 0.5}, {0, 0, 1}}};
    radiosity::FormFactorMatrix of_patches, of_points;
    radiosity::Certificate certificate;
    HC_TRY(radiosity::compute_form_factors(patches_, rows, options, serial_, nullptr, &of_patches,
                                           &certificate));
    hash->add(certificate.form_factor_hash);
    HC_TRY(radiosity::compute_point_form_factors(patches_, points, options, serial_, nullptr,
                                                 &of_points, &certificate));
    hash->add(certificate.form_factor_hash);
    return Status();
  });
}

// Catches: what lets rows go to a file, and reads them, without a word when it cannot.
TEST_F(FailingAllocator, RowsBeyondMemory) {
  refuse_each([&](Hash* hash) {
    try {
      radiosity::RowFile rows;
      rows.use_temporary();
      radiosity::RunFiles files;
      files.rows = &rows;
      files.most_bytes = files.range_bytes = 500;
      Options options = on(Rung::kHemicube);
      options.files = &files;
      return solve(scene_, patches_, options, serial_, hash);
    } catch (const std::bad_alloc&) { // of the name of the file, which the program catches
      return Status::error(StatusCode::kOutOfMemory, "no name");
    }
  });
}

TEST_F(FailingAllocator, CutsAlongShadows) {
  refuse_each([&](Hash* hash) {
    PatchSet fronts, elements;
    radiosity::MeshReport mesh;
    std::vector<radiosity::DiscontinuityLine> lines;
    radiosity::DiscontinuityReport report;
    HC_TRY(radiosity::build_patches(scene_, &fronts, &mesh));
    HC_TRY(radiosity::cut_discontinuities(scene_, fronts, {}, &elements, &lines, &report));
    for (const double area : elements.area)
      hash->add(area);
    return Status();
  });
}

TEST_F(FailingAllocator, ElementsThatFollowTheLight) {
  refuse_each([&](Hash* hash) {
    radiosity::ElementTree tree;
    PatchSet elements;
    radiosity::Solution solution;
    radiosity::Certificate certificate;
    radiosity::RefinementReport report;
    HC_TRY(radiosity::solve_adaptive(scene_, patches_, {0.2, 0.2, 40}, on(Rung::kArea), serial_,
                                     nullptr, &tree, &elements, &solution, &certificate, &report));
    hash->add(certificate.radiosity_hash);
    return Status();
  });
}

// Catches: a destructor that takes memory, and files that stay behind.
TEST_F(FailingAllocator, FilesInTheMaking) {
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("hemicube_refused_" + std::to_string(::getpid())))
          .string();
  const std::string table = folder + "/table.csv";
  refuse_each([&](Hash* hash) {
    const Status status = [&] {
      try {
        radiosity::FileSet files;
        HC_TRY(files.begin(folder));
        HC_TRY(files.add("table.csv", "a,b"));
        return files.commit();
      } catch (const std::bad_alloc&) { // as the program does
        return Status::error(StatusCode::kOutOfMemory, "out of memory");
      }
    }();
    EXPECT_EQ(::unlink(table.c_str()) == 0, status.ok());
    EXPECT_EQ(::rmdir(folder.c_str()) == 0, status.ok()) << "it was not empty, or left";
    hash->add(std::uint32_t{1});
    return status;
  });
}

// Catches: a scene that is half the one before.
TEST_F(FailingAllocator, SceneFiles) {
  const std::string path = HC_SOURCE_DIR "/scenes/plate.json";
  refuse_each([&](Hash* hash) {
    Scene scene;
    radiosity::ReadReport report;
    const Status status = radiosity::read_scene(path, &scene, &report);
    EXPECT_TRUE(status.ok() || scene.vertices.empty());
    for (const Vec3& vertex : scene.vertices)
      hash->add(vertex.x + 2 * vertex.y + 3 * vertex.z);
    return status;
  });
}

} // namespace
} // namespace hemicube::test
