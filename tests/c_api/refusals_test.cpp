// Bad input to the C interface is an error code and a text, and nothing else.
#include "tests/c_api/rooms.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace hemicube::c_api_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct BadScene {
  const char* name;
  int code;
  const char* text; ///< part of what hc_error_text says
  std::function<void(Room*)> spoil;
};

const std::vector<BadScene>& bad_scenes() {
  static const std::vector<BadScene> cases = {
      {"no size", HC_INVALID_ARGUMENT, "struct_size is 0",
       [](Room* r) { r->desc.struct_size = 0; }},
      {"a size cut off", HC_INVALID_ARGUMENT, "struct_size",
       [](Room* r) { r->desc.struct_size -= 8; }},
      {"a later version", HC_INVALID_ARGUMENT, "struct_size",
       [](Room* r) { r->desc.struct_size += 8; }},
      {"a mad size", HC_INVALID_ARGUMENT, "struct_size",
       [](Room* r) { r->desc.struct_size = ~std::size_t{0}; }},
      {"no vertices", HC_INVALID_ARGUMENT, "vertices is NULL",
       [](Room* r) { r->desc.vertices = nullptr; }},
      {"no offsets", HC_INVALID_ARGUMENT, "polygon_offsets is NULL",
       [](Room* r) { r->desc.polygon_offsets = nullptr; }},
      {"no indices", HC_INVALID_ARGUMENT, "indices is NULL",
       [](Room* r) { r->desc.indices = nullptr; }},
      {"no polygons", HC_INVALID_ARGUMENT, "polygon_count is 0",
       [](Room* r) { r->desc.polygon_count = 0; }},
      {"2^63 polygons", HC_BAD_SCENE, "9223372036854775808",
       [](Room* r) { r->desc.polygon_count = std::uint64_t{1} << 63; }},
      {"2^64 - 1 polygons", HC_BAD_SCENE, "18446744073709551615",
       [](Room* r) { r->desc.polygon_count = ~std::uint64_t{0}; }},
      {"2^61 vertices", HC_BAD_SCENE, "2305843009213693952",
       [](Room* r) { r->desc.vertex_count = std::uint64_t{1} << 61; }},
      {"2^62 indices", HC_BAD_SCENE, "4611686018427387904",
       [](Room* r) { r->desc.index_count = std::uint64_t{1} << 62; }},
      {"2^32 - 1 materials", HC_INVALID_ARGUMENT, "4294967295 materials",
       [](Room* r) { r->desc.material_count = ~0u; }},
      {"2^32 - 1 bands", HC_INVALID_ARGUMENT, "4294967295 bands",
       [](Room* r) { r->desc.band_count = ~0u; }},
      {"materials without a count", HC_INVALID_ARGUMENT, "material_count is 0",
       [](Room* r) { r->desc.material_count = 0; }},
      {"bands without a count", HC_INVALID_ARGUMENT, "band_count is 0",
       [](Room* r) { r->desc.band_count = 0; }},
      {"first offset", HC_BAD_SCENE, "are 1 to 24", [](Room* r) { r->offsets[0] = 1; }},
      {"last offset too large", HC_BAD_SCENE, "to 25, but there are 24",
       [](Room* r) { r->offsets[6] = 25; }},
      {"fewer indices than the offsets say", HC_BAD_SCENE, "to 24, but there are 23",
       [](Room* r) { r->desc.index_count = 23; }},
      {"an offset far out", HC_BAD_SCENE, "face 1", [](Room* r) { r->offsets[2] = ~0ull; }},
      {"offsets backwards", HC_BAD_SCENE, "face 2", [](Room* r) { r->offsets[3] = 4; }},
      {"two corners", HC_BAD_SCENE, "face 2: needs 3 corners or more, has 2",
       [](Room* r) { r->offsets[3] = 10; }},
      {"an index too large", HC_BAD_SCENE, "face 1, corner 1: vertex 24 does not exist",
       [](Room* r) { r->indices[5] = 24; }},
      {"index 2^32 - 1", HC_BAD_SCENE, "vertex 4294967295", [](Room* r) { r->indices[0] = ~0u; }},
      {"a material too large", HC_BAD_SCENE, "face 3: material 2 does not exist",
       [](Room* r) { r->materials[3] = 2; }},
      {"a vertex that is no number", HC_BAD_SCENE, "vertex 3: nan",
       [](Room* r) { r->vertices[10] = kNaN; }},
      {"a vertex at infinity", HC_BAD_SCENE, "vertex 0: -inf",
       [](Room* r) { r->vertices[0] = -HUGE_VAL; }},
      {"areas beyond double", HC_BAD_SCENE, "",
       [](Room* r) {
         for (double& x : r->vertices)
           x *= 1e300;
       }},
      {"no area", HC_BAD_SCENE, "no face of the scene has an area",
       [](Room* r) {
         for (double& x : r->vertices)
           x = 1;
       }},
      {"reflectance above 1", HC_BAD_SCENE, "reflectance of material 1, band 0: 1.5 is not in 0..1",
       [](Room* r) { r->reflectance[1] = 1.5; }},
      {"reflectance below 0", HC_BAD_SCENE, "-0.5", [](Room* r) { r->reflectance[0] = -0.5; }},
      {"reflectance that is no number", HC_BAD_SCENE, "nan",
       [](Room* r) { r->reflectance[0] = kNaN; }},
      {"exitance below 0", HC_BAD_SCENE, "exitance of material 0, band 0: -1",
       [](Room* r) { r->exitance[0] = -1; }},
      {"infinite exitance", HC_BAD_SCENE, "inf is not a finite number",
       [](Room* r) { r->exitance[0] = HUGE_VAL; }},
  };
  return cases;
}

TEST(CRefusals, BadScenes) {
  for (const BadScene& bad : bad_scenes()) {
    Room cube = room(1);
    bad.spoil(&cube);
    hc_scene* scene = reinterpret_cast<hc_scene*>(&cube);
    EXPECT_EQ(hc_scene_create(&cube.desc, &scene), bad.code) << bad.name;
    EXPECT_EQ(scene, nullptr) << bad.name;
    EXPECT_NE(std::string(hc_error_text()).find(bad.text), std::string::npos)
        << bad.name << ": " << hc_error_text();
  }
}

struct BadOptions {
  const char* name;
  std::function<void(hc_options*)> spoil;
};

TEST(CRefusals, BadOptions) {
  const Room cube = room(1);
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  static const hc_executor kEmpty = {sizeof kEmpty, 1, nullptr, nullptr};
  static const auto kRun = [](void*, std::uint64_t, hc_block, void*) { return 0; };
  static const hc_executor kNobody = {sizeof kNobody, 0, kRun, nullptr},
                           kCrowd = {sizeof kCrowd, 1025, kRun, nullptr},
                           kSizeless = {0, 1, kRun, nullptr};
  const std::vector<BadOptions> cases = {
      {"struct_size", [](hc_options* o) { o->struct_size = 1; }},
      {"rung", [](hc_options* o) { o->rung = 6; }},
      {"rung", [](hc_options* o) { o->rung = -1; }},
      {"solver", [](hc_options* o) { o->solver = 3; }},
      {"resolution", [](hc_options* o) { o->resolution = 15; }},
      {"resolution", [](hc_options* o) { o->resolution = 65; }},
      {"resolution", [](hc_options* o) { o->resolution = 4096; }},
      {"error", [](hc_options* o) { o->error = kNaN; }},
      {"error", [](hc_options* o) { o->error = 1; }},
      {"tolerance", [](hc_options* o) { o->tolerance = -1; }},
      {"stop_unshot", [](hc_options* o) { o->stop_unshot = HUGE_VAL; }},
      {"balance", [](hc_options* o) { o->balance = 2; }},
      {"no_error_estimate", [](hc_options* o) { o->no_error_estimate = -1; }},
      {"no_black_irradiance", [](hc_options* o) { o->no_black_irradiance = 7; }},
      {"isa", [](hc_options* o) { o->isa = "mmx"; }},
      {"threads", [](hc_options* o) { o->threads = ~0u; }},
      {"run", [](hc_options* o) { o->executor = &kEmpty; }},
      {"worker_count", [](hc_options* o) { o->executor = &kNobody; }},
      {"worker_count", [](hc_options* o) { o->executor = &kCrowd; }},
      {"struct_size", [](hc_options* o) { o->executor = &kSizeless; }},
  };
  for (const BadOptions& bad : cases) {
    hc_options options = options_of(HC_RUNG_HEMICUBE, 16);
    bad.spoil(&options);
    OwnedSolution solution;
    EXPECT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_INVALID_ARGUMENT) << bad.name;
    EXPECT_EQ(solution, nullptr);
    EXPECT_NE(std::string(hc_error_text()).find(bad.name), std::string::npos)
        << bad.name << ": " << hc_error_text();
  }
}

TEST(CRefusals, NullAndSizesOfEveryCall) {
  const Room cube = room(1);
  OwnedScene scene, other;
  OwnedFormFactors rows, some;
  OwnedSolution solution;
  const hc_options options = options_of(HC_RUNG_HEMICUBE, 16);
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  ASSERT_EQ(hc_form_factors_create(scene, &options, rows.to()), HC_OK);
  ASSERT_EQ(hc_solve(scene, rows, &options, solution.to()), HC_OK);
  hc_form_factors* made = nullptr;
  hc_solution* solved = nullptr;
  const std::uint32_t patch[] = {0, 6};
  const double point[] = {0.5, 0.5, 0}, normal[] = {0, 0, 1}, zero[] = {0, 0, 0},
               nan[] = {kNaN, 0, 0};
  std::uint64_t nonzeros = 0;
  ASSERT_EQ(hc_form_factors_get_size(rows, nullptr, nullptr, &nonzeros), HC_OK);
  double values[8];
  hc_scene_info info = {};
  hc_certificate certificate = {};
  hc_energy energy = {};
  const hc_patches too_many = {sizeof too_many, 7, nullptr, nullptr, nullptr, nullptr};
  const auto ignore = [](void*, const hc_row*) { return 0; };
  hc_options balanced = options;
  balanced.balance = 1;
  const int codes[] = {
      hc_scene_create(nullptr, other.to()),
      hc_scene_create(&cube.desc, nullptr),
      hc_scene_get_info(nullptr, &info),
      hc_scene_get_info(scene, nullptr),
      hc_scene_get_info(scene, &info), // without its size
      hc_scene_get_patches(nullptr, &too_many),
      hc_scene_get_patches(scene, nullptr),
      hc_scene_get_patches(scene, &too_many),
      hc_form_factors_create(nullptr, &options, &made),
      hc_form_factors_create(scene, &options, nullptr),
      hc_patch_form_factors_create(scene, nullptr, 1, &options, &made),
      hc_patch_form_factors_create(scene, patch, 0, &options, &made),
      hc_patch_form_factors_create(scene, patch, 2, &options, &made), // there is no patch 6
      hc_patch_form_factors_create(scene, patch, ~0ull, &options, &made),
      hc_patch_form_factors_create(scene, patch, 1, &balanced, &made),
      hc_point_form_factors_create(nullptr, point, normal, 1, &options, &made),
      hc_point_form_factors_create(scene, nullptr, normal, 1, &options, &made),
      hc_point_form_factors_create(scene, point, nullptr, 1, &options, &made),
      hc_point_form_factors_create(scene, point, normal, 0, &options, &made),
      hc_point_form_factors_create(scene, point, normal, ~0ull, &options, &made),
      hc_point_form_factors_create(scene, point, zero, 1, &options, &made),
      hc_point_form_factors_create(scene, nan, normal, 1, &options, &made),
      hc_point_form_factors_create(scene, point, normal, 1, &balanced, &made),
      hc_form_factors_get_size(nullptr, nullptr, nullptr, nullptr),
      hc_form_factors_get_csr(nullptr, 6, nonzeros, nullptr, nullptr, nullptr, nullptr, nullptr),
      hc_form_factors_get_csr(rows, 5, nonzeros, nullptr, nullptr, nullptr, nullptr, nullptr),
      hc_form_factors_get_csr(rows, 6, nonzeros + 1, nullptr, nullptr, nullptr, nullptr, nullptr),
      hc_form_factors_get_certificate(nullptr, &certificate),
      hc_form_factors_get_certificate(rows, nullptr),
      hc_form_factors_get_certificate(rows, &certificate),
      hc_form_factors_for_each(nullptr, &options, ignore, nullptr, nullptr),
      hc_form_factors_for_each(scene, &options, nullptr, nullptr, nullptr),
      hc_form_factors_for_each(scene, &balanced, ignore, nullptr, nullptr),
      hc_form_factors_for_each(scene, &options, ignore, nullptr, &certificate),
      hc_solve(nullptr, nullptr, &options, &solved),
      hc_solve(scene, nullptr, &options, nullptr),
      hc_solution_get_values(nullptr, HC_RADIOSITY, 6, values),
      hc_solution_get_values(solution, HC_RADIOSITY, 6, nullptr),
      hc_solution_get_values(solution, HC_RADIOSITY, 7, values),
      hc_solution_get_values(solution, -1, 6, values),
      hc_solution_get_values(solution, 5, 6, values),
      hc_solution_get_energy(nullptr, 0, &energy),
      hc_solution_get_energy(solution, 1, &energy),
      hc_solution_get_energy(solution, 0, nullptr),
      hc_solution_get_energy(solution, 0, &energy),
      hc_solution_get_certificate(nullptr, &certificate),
      hc_solution_get_certificate(solution, nullptr),
      hc_solution_get_certificate(solution, &certificate),
  };
  int number = 0;
  for (const int code : codes)
    EXPECT_EQ(code, HC_INVALID_ARGUMENT) << "call " << number++;
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(solved, nullptr);
  hc_scene_release(nullptr);
  hc_form_factors_release(nullptr);
  hc_solution_release(nullptr);

  // Form factors of some patches, and of other polygons, solve nothing.
  ASSERT_EQ(hc_patch_form_factors_create(scene, patch, 1, &options, some.to()), HC_OK);
  EXPECT_EQ(hc_solve(scene, some, &options, &solved), HC_INVALID_ARGUMENT);
  const Room finer = room(2);
  ASSERT_EQ(hc_scene_create(&finer.desc, other.to()), HC_OK);
  EXPECT_EQ(hc_solve(other, rows, &options, &solved), HC_INVALID_ARGUMENT);
}

TEST(CRefusals, WhiteRoomHasNoSolution) {
  const Room cube = room(1, {1, 1}, {1, 1});
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  OwnedSolution solution;
  const hc_options options = options_of(HC_RUNG_AREA, 16);
  EXPECT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_SINGULAR) << hc_error_text();
  EXPECT_EQ(solution, nullptr);
}

TEST(CRefusals, SolutionThatHasNotConvergedIsThere) {
  const Room cube = room(1);
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  OwnedSolution solution;
  hc_options options = options_of(HC_RUNG_AREA, 16);
  options.tolerance = 1e-12;
  options.max_sweeps = 1;
  EXPECT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_NOT_CONVERGED);
  ASSERT_NE(solution, nullptr);
  EXPECT_EQ(certificate_of(solution).converged, 0);
}

using Run = int (*)(void*, std::uint64_t, hc_block, void*);
struct BadExecutor {
  Run run;
  const char* text;
};

TEST(CRefusals, ExecutorsThatDoNotRunEveryBlockOnce) {
  const Room cube = room(2); // three blocks of eight rows
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  const std::vector<BadExecutor> cases = {
      {[](void*, std::uint64_t, hc_block, void*) { return 0; }, "ran 0 of 3 blocks"},
      {[](void*, std::uint64_t count, hc_block block, void* context) {
         for (std::uint64_t b = 1; b < count; ++b)
           block(context, b, 0);
         return 0;
       },
       "ran 2 of 3 blocks"},
      {[](void*, std::uint64_t, hc_block block, void* context) {
         block(context, 1, 0);
         block(context, 1, 0);
         return 0;
       },
       "ran block 1 twice"},
      {[](void*, std::uint64_t count, hc_block block, void* context) {
         return block(context, count, 0);
       },
       "ran block 3 of 3"},
      {[](void*, std::uint64_t, hc_block block, void* context) { return block(context, 0, 1); },
       "as worker 1 of 1"},
      {[](void*, std::uint64_t, hc_block, void*) { return 5; }, "failed with 5"},
  };
  for (const BadExecutor& bad : cases) {
    const hc_executor executor = {sizeof executor, 1, bad.run, nullptr};
    hc_options options = options_of(HC_RUNG_HEMICUBE, 16);
    options.executor = &executor;
    OwnedFormFactors rows;
    EXPECT_EQ(hc_form_factors_create(scene, &options, rows.to()), HC_INVALID_ARGUMENT);
    EXPECT_NE(std::string(hc_error_text()).find(bad.text), std::string::npos) << hc_error_text();
  }
}

} // namespace
} // namespace hemicube::c_api_test
