// The C interface computes what the program computes, and what is known.
#include "radiosity/scene/read_scene.h"
#include "tests/c_api/rooms.h"

#include <atomic>
#include <cinttypes>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <thread>

namespace hemicube::c_api_test {
namespace {

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, value);
  return text;
}

/// A scene file by way of arrays.
void load(const std::string& file, hc_scene** scene) {
  radiosity::Scene read;
  radiosity::ReadReport report;
  ASSERT_TRUE(radiosity::read_scene(HC_SOURCE_DIR "/" + file, &read, &report).ok());
  hc_scene_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = &read.vertices[0].x;
  desc.vertex_count = read.vertices.size();
  desc.polygon_offsets = read.corner_offsets.data();
  desc.polygon_count = read.face_count();
  desc.indices = read.corners.data();
  desc.index_count = read.corners.size();
  desc.polygon_materials = read.face_material.data();
  desc.material_count = read.materials.size();
  desc.band_count = read.band_count();
  desc.reflectance = read.reflectance.data();
  desc.exitance = read.exitance.data();
  desc.two_sided = read.two_sided.data();
  desc.space_exitance = read.space_exitance.data();
  ASSERT_EQ(hc_scene_create(&desc, scene), HC_OK) << hc_error_text();
}

TEST(CResults, HashesAreTheGoldenOnes) {
  const std::map<std::string, int> rungs = {
      {"hemicube", HC_RUNG_HEMICUBE}, {"analytic", HC_RUNG_ANALYTIC}, {"area", HC_RUNG_AREA}};
  std::ifstream in(HC_SOURCE_DIR "/tests/golden/hashes.txt");
  int compared = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string file, rung, items, form_factors, radiosity;
    std::uint32_t resolution = 0;
    words >> file >> rung >> resolution >> items >> form_factors >> radiosity;
    if (rungs.count(rung) == 0 || file.find('+') != std::string::npos) // cut before it is solved
      continue;
    OwnedScene scene;
    load(file, scene.to());
    const hc_options options = options_of(rungs.at(rung), resolution, 2);
    OwnedSolution solution;
    ASSERT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_OK) << hc_error_text();
    const hc_certificate c = certificate_of(solution);
    EXPECT_EQ(hex(c.form_factor_hash), form_factors) << line;
    EXPECT_EQ(hex(c.radiosity_hash), radiosity) << line;
    ++compared;
  }
  EXPECT_GE(compared, 7);
}

/// Workers of the test's own: blocks from both ends, on two threads.
int run_from_both_ends(void*, std::uint64_t count, hc_block block, void* block_context) {
  std::thread other([&] {
    for (std::uint64_t b = count; b-- > count / 2;)
      block(block_context, b, 1);
  });
  for (std::uint64_t b = count / 2; b-- > 0;)
    block(block_context, b, 0);
  other.join();
  return 0;
}

TEST(CResults, SameBitsForThreadsExecutorsAndInstructionSets) {
  const Room cube = room(3);
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK) << hc_error_text();
  hc_options options = options_of(HC_RUNG_HEMICUBE, 64);
  OwnedSolution solution;
  ASSERT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_OK);
  const std::uint64_t hash = certificate_of(solution).radiosity_hash;
  for (const std::uint32_t threads : {0u, 2u, 7u}) {
    options.threads = threads;
    ASSERT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_OK);
    EXPECT_EQ(certificate_of(solution).radiosity_hash, hash);
  }
  for (const char* isa : {"scalar", "sse41", "avx2", "avx512"}) {
    options.isa = isa;
    const int code = hc_solve(scene, nullptr, &options, solution.to());
    if (code == HC_OK) {
      EXPECT_EQ(certificate_of(solution).radiosity_hash, hash) << isa;
    } else {
      EXPECT_EQ(code, HC_INVALID_ARGUMENT) << isa << ": " << hc_error_text();
      EXPECT_STRNE(isa, "scalar");
    }
  }
  options.isa = nullptr;
  const hc_executor executor = {sizeof executor, 2, run_from_both_ends, nullptr};
  options.executor = &executor;
  ASSERT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_OK) << hc_error_text();
  EXPECT_EQ(certificate_of(solution).radiosity_hash, hash);
}

TEST(CResults, RowsCloseAndAreTheSameInEveryForm) {
  const Room cube = room(3);
  const std::size_t count = cube.polygon_count();
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  const hc_options options = options_of(HC_RUNG_AREA, 64, 2);
  OwnedFormFactors all, some;
  ASSERT_EQ(hc_form_factors_create(scene, &options, all.to()), HC_OK) << hc_error_text();
  std::uint64_t rows = 0, columns = 0, nonzeros = 0;
  ASSERT_EQ(hc_form_factors_get_size(all, &rows, &columns, &nonzeros), HC_OK);
  EXPECT_EQ(rows, count);
  EXPECT_EQ(columns, count);
  std::vector<std::uint64_t> offsets(count + 1);
  std::vector<std::uint32_t> column(nonzeros);
  std::vector<double> value(nonzeros), space(count), back_side(count);
  ASSERT_EQ(hc_form_factors_get_csr(all, rows, nonzeros, offsets.data(), column.data(),
                                    value.data(), space.data(), back_side.data()),
            HC_OK);
  EXPECT_EQ(offsets.front(), 0u);
  EXPECT_EQ(offsets.back(), nonzeros);
  for (std::size_t i = 0; i < count; ++i) {
    double sum = space[i] + back_side[i];
    for (std::uint64_t k = offsets[i]; k < offsets[i + 1]; ++k)
      sum += value[k];
    EXPECT_NEAR(sum, 1, 1e-12);
  }

  struct Seen {
    const std::vector<std::uint64_t>& offsets;
    const std::vector<std::uint32_t>& column;
    const std::vector<double>& value;
    std::vector<int> rows;
  } seen{offsets, column, value, std::vector<int>(count)};
  const auto take = [](void* context, const hc_row* row) {
    auto& s = *static_cast<Seen*>(context);
    ++s.rows[row->index];
    const std::uint64_t begin = s.offsets[row->index];
    EXPECT_EQ(row->count, s.offsets[row->index + 1] - begin);
    for (std::uint64_t k = 0; k < row->count; ++k) {
      EXPECT_EQ(row->columns[k], s.column[begin + k]);
      EXPECT_EQ(row->scale * static_cast<double>(row->values[k]), s.value[begin + k]);
    }
    return 0;
  };
  hc_certificate certificate = {};
  certificate.struct_size = sizeof certificate;
  ASSERT_EQ(hc_form_factors_for_each(scene, &options, take, &seen, &certificate), HC_OK);
  EXPECT_EQ(seen.rows, std::vector<int>(count, 1));
  EXPECT_EQ(certificate.form_factor_hash, certificate_of(all).form_factor_hash);

  const std::vector<std::uint32_t> wanted = {7, 0, 7};
  const hc_options plain = options_of(HC_RUNG_HEMICUBE, 64);
  ASSERT_EQ(hc_patch_form_factors_create(scene, wanted.data(), 3, &plain, some.to()), HC_OK);
  ASSERT_EQ(hc_form_factors_get_size(some, &rows, nullptr, &nonzeros), HC_OK);
  EXPECT_EQ(rows, 3u);
  offsets.resize(4);
  ASSERT_EQ(hc_form_factors_get_csr(some, 3, nonzeros, offsets.data(), nullptr, nullptr, nullptr,
                                    nullptr),
            HC_OK);
  EXPECT_EQ(offsets[1] - offsets[0], offsets[3] - offsets[2]); // the same patch twice
}

TEST(CResults, PointSeesTheOppositeWallAsItsClosedForm) {
  const Room cube = room(2);
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  const double point[] = {0.5, 0.5, 0}, normal[] = {0, 0, 3};
  OwnedFormFactors seen;
  ASSERT_EQ(hc_point_form_factors_create(scene, point, normal, 1, nullptr, seen.to()), HC_OK)
      << hc_error_text();
  std::uint64_t nonzeros = 0;
  ASSERT_EQ(hc_form_factors_get_size(seen, nullptr, nullptr, &nonzeros), HC_OK);
  std::vector<std::uint32_t> column(nonzeros);
  std::vector<double> value(nonzeros);
  ASSERT_EQ(hc_form_factors_get_csr(seen, 1, nonzeros, nullptr, column.data(), value.data(),
                                    nullptr, nullptr),
            HC_OK);
  double ceiling = 0;
  for (std::size_t k = 0; k < nonzeros; ++k)
    ceiling += column[k] >= 5 * 4 ? value[k] : 0; // patches of the wall z = 1
  // A differential element below the corner of a parallel rectangle of half the wall, four times.
  const double x = 0.5 / std::sqrt(1.25);
  EXPECT_NEAR(ceiling, 4 * 2 * x * std::atan(x) / (2 * M_PI), 1e-6);
}

TEST(CResults, FurnaceIsSolvedAndItsEnergyCloses) {
  const Room cube = room(2, {0.5, 0.5}, {1, 1});
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  OwnedSolution solution;
  hc_options options = options_of(HC_RUNG_CHOSEN, 0);
  options.no_error_estimate = 0;
  ASSERT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_OK) << hc_error_text();
  for (const double b : values_of(solution, HC_RADIOSITY, cube.polygon_count()))
    EXPECT_NEAR(b, 2, 2e-6); // E / (1 - rho), to the solver's tolerance
  const hc_certificate c = certificate_of(solution);
  EXPECT_EQ(c.solved, 1);
  EXPECT_EQ(c.converged, 1);
  EXPECT_EQ(c.patches, cube.polygon_count());
  EXPECT_LT(c.radiosity_error, 0.01);
  hc_energy energy = {};
  energy.struct_size = sizeof energy;
  ASSERT_EQ(hc_solution_get_energy(solution, 0, &energy), HC_OK);
  EXPECT_NEAR(energy.emitted, 6, 1e-12); // six walls of 1 m^2, 1 W/m^2
  EXPECT_NEAR(energy.absorbed, 6, 1e-5);
}

TEST(CResults, GivenFormFactorsServeOtherLightsAndStayAsTheyAre) {
  const Room cube = room(3), other = room(3, {0.2, 0.9}, {5, 0});
  OwnedScene scene, relit;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  ASSERT_EQ(hc_scene_create(&other.desc, relit.to()), HC_OK);
  hc_options options = options_of(HC_RUNG_HEMICUBE, 64);
  OwnedFormFactors rows;
  ASSERT_EQ(hc_form_factors_create(scene, &options, rows.to()), HC_OK);
  for (hc_scene* each : {static_cast<hc_scene*>(scene), static_cast<hc_scene*>(relit)})
    for (const int balance : {1, 0}) {
      options.balance = balance;
      OwnedSolution direct, given;
      ASSERT_EQ(hc_solve(each, nullptr, &options, direct.to()), HC_OK) << hc_error_text();
      ASSERT_EQ(hc_solve(each, rows, &options, given.to()), HC_OK) << hc_error_text();
      EXPECT_EQ(certificate_of(given).radiosity_hash, certificate_of(direct).radiosity_hash);
    }
}

TEST(CResults, BacksAreCountedAndMatchTheirFronts) {
  Room cube = room(1);
  const std::uint8_t two_sided[] = {0, 1};
  cube.desc.two_sided = two_sided;
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  hc_scene_info info = {};
  info.struct_size = sizeof info;
  ASSERT_EQ(hc_scene_get_info(scene, &info), HC_OK);
  EXPECT_EQ(info.patch_count, 7u);
  EXPECT_EQ(info.front_count, 6u);
  EXPECT_EQ(info.band_count, 1u);
  double area[7], normal[7][3], centre[7][3];
  std::uint32_t polygon[7];
  const hc_patches patches = {sizeof patches, 7, area, &centre[0][0], &normal[0][0], polygon};
  ASSERT_EQ(hc_scene_get_patches(scene, &patches), HC_OK);
  EXPECT_EQ(polygon[6], 5u);
  EXPECT_EQ(area[6], 1);
  EXPECT_EQ(normal[5][2], -1);
  EXPECT_EQ(normal[6][2], 1);
  EXPECT_EQ(centre[6][2], 1);
}

TEST(CResults, VersionIsTheProjects) {
  EXPECT_STREQ(hc_version(), HC_VERSION);
}

} // namespace
} // namespace hemicube::c_api_test
