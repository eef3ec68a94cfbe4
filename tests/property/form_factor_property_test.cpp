// Form factors and radiosities as functions of the scene alone: the same bits for any thread count,
// instruction set and power-of-two scale; closed rows; light that only grows with reflectance.

#include "radiosity/hemicube/delta_form_factors.h"
#include "radiosity/hemicube/five_views.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/support/drawn_face.h"
#include "tests/support/office.h"
#include "tests/support/solved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <map>
#include <stdexcept>

namespace hemicube::test {
namespace {

using radiosity::Options;

Options at_resolution(std::uint32_t resolution) {
  Options options;
  options.resolution = resolution;
  return options;
}

/// An open scene with occluders, seen backs and a lone quad: nothing closes by chance.
Scene open_scene() {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material("grey", 0.6, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.2, 5);
  builder.grid(grey, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, 5, 5);
  builder.grid(grey, {0, 2, 0}, {0, 2, 1}, {0, 0, 1}, {0, 0, 0}, 3, 3);
  builder.grid(lamp, {0.5, 0.5, 1.5}, {0.5, 1, 1.5}, {1, 1, 1.5}, {1, 0.5, 1.5}, 2, 2);
  builder.grid(grey, {0.4, 0.4, 0.7}, {1.1, 0.5, 0.75}, {1.2, 1.1, 0.8}, {0.5, 1, 0.75}, 2, 2);
  builder.face(grey, {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}});
  return builder.finish();
}

struct NamedScene {
  const char* name;
  Scene (*make)();
};
const NamedScene kScenes[] = {
    {"cube8", cube8},
    {"l_room", [] { return l_room(2, 0.7, 1); }},
    {"t_vertex_room", [] { return t_vertex_room(); }},
    {"cornell_like", [] { return cornell_like(8); }},
    {"open_scene", open_scene},
};

class Scenes : public testing::TestWithParam<NamedScene> {};

// Catches: a row that depends on the worker or on rows computed before it; a race.
TEST_P(Scenes, ThreadsDoNotChangeABit) {
  const Scene scene = GetParam().make();
  const PatchSet patches = patches_of(scene);
  FormFactors expected;
  compute_all(patches, at_resolution(64), 1, &expected);
  const Solved solved = solve(scene, at_resolution(64), 1);
  for (const std::uint32_t threads : {2u, 3u, 7u, 16u}) {
    FormFactors actual;
    compute_all(patches, at_resolution(64), threads, &actual);
    EXPECT_TRUE(same_bits(expected.matrix, actual.matrix)) << threads << " threads";
    EXPECT_EQ(expected.certificate.form_factor_hash, actual.certificate.form_factor_hash);
    const Solved again = solve(scene, at_resolution(64), threads);
    EXPECT_TRUE(same_bits(solved.solution.radiosity, again.solution.radiosity)) << threads;
    EXPECT_EQ(solved.certificate.radiosity_hash, again.certificate.radiosity_hash);
    EXPECT_EQ(solved.certificate.sweeps, again.certificate.sweeps);
  }
}

// Catches: a kernel, a read-out or a sum whose result depends on the vector width.
TEST_P(Scenes, KernelsDoNotChangeABit) {
  const Scene scene = GetParam().make();
  const PatchSet patches = patches_of(scene);
  for (const std::uint32_t resolution : {16u, 50u, 128u, 200u, 300u}) {
    Options options = at_resolution(resolution);
    options.kernels = raster::kernels_by_name("scalar");
    FormFactors expected;
    compute_all(patches, options, 0, &expected);
    for (const std::string& isa : kernels_here()) {
      options.kernels = raster::kernels_by_name(isa);
      FormFactors actual;
      compute_all(patches, options, 0, &actual);
      EXPECT_TRUE(same_bits(expected.matrix, actual.matrix)) << isa << " at " << resolution;
    }
  }
}

// Catches: light made or lost between pixels and row: sums in floating point, a pixel counted
// twice.
TEST_P(Scenes, EveryRowClosesExactly) {
  const PatchSet patches = patches_of(GetParam().make());
  for (const std::uint32_t resolution : {16u, 50u, 64u, 256u}) {
    FormFactors factors;
    compute_all(patches, at_resolution(resolution), 0, &factors);
    for (std::uint64_t i = 0; i < factors.matrix.row_count(); ++i) {
      const radiosity::RowView row = factors.matrix.row(i);
      long double sum = 0;
      for (std::size_t k = 0; k < row.columns.size(); ++k) {
        EXPECT_GT(row.values[k], 0.0f);
        EXPECT_NE(row.columns[k], i) << "a patch sees itself";
        if (k > 0) {
          EXPECT_LT(row.columns[k - 1], row.columns[k]) << "columns must ascend";
        }
        sum += static_cast<long double>(row.scale) * static_cast<long double>(row.values[k]);
      }
      EXPECT_NEAR(static_cast<double>(sum + row.space + row.back_side), 1.0, 1e-15)
          << "row " << i << " at " << resolution;
      EXPECT_GE(row.space, 0.0);
      EXPECT_GE(row.back_side, 0.0);
    }
  }
}

/// Every step-th row; throws on any failure.
void compute_some(const PatchSet& patches, std::uint32_t step, const Options& options,
                  std::uint32_t threads, FormFactors* result) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 0; row < patches.patch_count(); row += step)
    rows.push_back(row);
  radiosity::ThreadPool pool;
  require(pool.init(threads));
  require(radiosity::compute_form_factors(patches, rows, options, pool, nullptr, &result->matrix,
                                          &result->certificate));
}

/// Compares every step-th row with the pixels that its hemicube shows, weighed one by one.
void expect_rows_of_pixels(const PatchSet& patches, std::uint32_t step, std::uint32_t resolution) {
  FormFactors factors;
  compute_some(patches, step, at_resolution(resolution), 1, &factors);
  radiosity::DeltaFormFactors delta;
  require(delta.init(resolution));
  Drawer drawer(radiosity::polygons_of(patches), *raster::kernels_by_name("scalar"),
                raster::Culling::kOff);
  for (std::uint64_t i = 0; i < factors.matrix.row_count(); ++i) {
    std::map<std::uint32_t, std::uint64_t> weights;
    std::uint64_t space = 0, back_side = 0;
    drawer.begin(radiosity::hemicube_view(patches, static_cast<std::uint32_t>(i) * step));
    for (const raster::Face face : kFaces) {
      const DrawnFace drawn = drawer.draw(face, raster::hemicube_grid(face, resolution));
      for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x) {
          const raster::Item item = drawn.items[drawn.index(x, y)];
          (item == raster::kNoItem        ? space
           : raster::is_back_facing(item) ? back_side
                                          : weights[item]) += delta.weight(face, x, y);
        }
    }
    const radiosity::RowView row = factors.matrix.row(i);
    std::size_t k = 0;
    for (const auto& [patch, weight] : weights) {
      ASSERT_LT(k, row.columns.size()) << "row " << i;
      ASSERT_EQ(row.columns[k], patch) << "row " << i << " at " << resolution;
      ASSERT_EQ(row.values[k], static_cast<float>(static_cast<double>(weight) * 0x1p-48))
          << "row " << i << " at " << resolution << ", patch " << patch;
      ++k;
    }
    ASSERT_EQ(k, row.columns.size()) << "row " << i << " at " << resolution;
    ASSERT_EQ(row.space, static_cast<double>(space) * 0x1p-48) << "row " << i;
    ASSERT_EQ(row.back_side, static_cast<double>(back_side) * 0x1p-48) << "row " << i;
  }
}

// Catches: weights that are counted while drawing and not taken back when something nearer comes,
// or taken back from the wrong polygon; sums of the wrong face, row or window.
TEST_P(Scenes, RowsAreTheWeightsOfTheirPixels) {
  const PatchSet patches = patches_of(GetParam().make());
  for (const std::uint32_t resolution : {16u, 64u, 130u, 300u})
    expect_rows_of_pixels(patches, 1 + patches.patch_count() / 30, resolution);
}

/// The scene with every coordinate times 2^exponent.
Scene scaled(Scene scene, int exponent) {
  for (Vec3& vertex : scene.vertices)
    vertex = vertex * std::ldexp(1.0, exponent);
  return scene;
}

// Catches: absolute tolerances anywhere between the vertices and the radiosity.
TEST_P(Scenes, ScaleByPowersOfTwoDoesNotChangeABit) {
  const Scene scene = GetParam().make();
  FormFactors expected;
  compute_all(patches_of(scene), at_resolution(64), 0, &expected);
  const Solved solved = solve(scene, at_resolution(64));
  for (const int exponent : {-40, -20, -3, 1, 20, 40}) {
    const Scene larger = scaled(GetParam().make(), exponent);
    FormFactors actual;
    compute_all(patches_of(larger), at_resolution(64), 0, &actual);
    EXPECT_TRUE(same_bits(expected.matrix, actual.matrix)) << "2^" << exponent;
    EXPECT_TRUE(
        same_bits(solved.solution.radiosity, solve(larger, at_resolution(64)).solution.radiosity))
        << "2^" << exponent;
  }
}

INSTANTIATE_TEST_SUITE_P(, Scenes, testing::ValuesIn(kScenes),
                         [](const auto& made) { return std::string(made.param.name); });

// ---------------------------------------------------------------------------------------------------

/// Rooms with doors and furniture: most of it hidden from any one patch.
PatchSet office_patches() {
  return patches_of(office({2, 2, 1, 0.8}));
}

// Catches: the same, where most of what is drawn first is covered later, or hidden and left out.
TEST(FormFactors, RowsOfAnOfficeAreTheWeightsOfTheirPixels) {
  const PatchSet patches = office_patches();
  expect_rows_of_pixels(patches, patches.patch_count() / 60, 64);
  expect_rows_of_pixels(patches, patches.patch_count() / 20, 258);
}

// Catches: a row that depends on the worker, on rows drawn before it, or on the vector width, where
// culling has most to do.
TEST(FormFactors, NeitherThreadsNorKernelsChangeABitOfAnOffice) {
  const PatchSet patches = office_patches();
  for (const std::uint32_t resolution : {64u, 130u}) {
    Options options = at_resolution(resolution);
    options.kernels = raster::kernels_by_name("scalar");
    FormFactors expected;
    compute_some(patches, 9, options, 1, &expected);
    for (const std::string& isa : kernels_here())
      for (const std::uint32_t threads : {1u, 2u, 3u}) {
        options.kernels = raster::kernels_by_name(isa);
        FormFactors actual;
        compute_some(patches, 9, options, threads, &actual);
        EXPECT_TRUE(same_bits(expected.matrix, actual.matrix))
            << isa << " at " << resolution << ", " << threads << " threads";
        EXPECT_EQ(expected.certificate.form_factor_hash, actual.certificate.form_factor_hash)
            << isa << " at " << resolution << ", " << threads << " threads";
      }
  }
}

/// The scene with its faces in another order: face k of the result is face order[k].
Scene permuted(const Scene& scene, std::span<const std::uint32_t> order) {
  SceneBuilder builder;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
    builder.material(scene.materials[m], scene.reflectance.span().subspan(m * 3, 3),
                     scene.exitance.span().subspan(m * 3, 3));
  for (const std::uint32_t face : order) {
    std::vector<Vec3> corners;
    for (auto k = scene.corner_offsets[face]; k < scene.corner_offsets[face + 1]; ++k)
      corners.push_back(scene.vertices[scene.corners[k]]);
    builder.face(scene.face_material[face], corners);
  }
  return builder.finish();
}

// Catches: form factors that depend on the order of faces. Only ties between surfaces that meet
// may.
TEST(FormFactors, OrderOfFacesOnlyPermutesTheMatrix) {
  const Scene scene = cube8();
  std::vector<std::uint32_t> order(scene.face_count());
  Random random(77);
  for (std::uint32_t i = 0; i < order.size(); ++i)
    order[i] = i;
  for (std::uint32_t i = static_cast<std::uint32_t>(order.size()); i > 1; --i)
    std::swap(order[i - 1], order[random.index(i)]);
  FormFactors expected, actual;
  compute_all(patches_of(scene), at_resolution(64), 0, &expected);
  compute_all(patches_of(permuted(scene, order)), at_resolution(64), 0, &actual);
  for (std::uint64_t k = 0; k < order.size(); ++k) {
    const std::vector<double> a = expected.dense_row(order[k]), b = actual.dense_row(k);
    // The scale of a row depends on the order of its sum: equal up to roundings of a double.
    for (std::size_t j = 0; j < order.size(); ++j)
      EXPECT_NEAR(a[order[j]], b[j], 1e-14 * a[order[j]]);
  }
}

// Catches: an orientation that is not handled symmetrically: a mirrored room has the mirrored
// light, up to the pixels of its hemicubes, which are turned the other way.
TEST(FormFactors, MirroredRoomHasTheMirroredLight) {
  const Scene scene = cornell_like(8);
  Scene mirrored = cornell_like(8);
  for (Vec3& vertex : mirrored.vertices)
    vertex.x = -vertex.x;
  for (std::size_t f = 0; f < mirrored.face_count(); ++f)
    std::reverse(mirrored.corners.data() + mirrored.corner_offsets[f],
                 mirrored.corners.data() + mirrored.corner_offsets[f + 1]);
  const Solved a = solve(scene, at_resolution(256)), b = solve(mirrored, at_resolution(256));
  double squares = 0, total = 0;
  for (std::uint32_t p = 0; p < a.patches.patch_count(); ++p) {
    const double difference = a.radiosity(p, 0) - b.radiosity(p, 0);
    squares += difference * difference;
    total += a.radiosity(p, 0) * a.radiosity(p, 0);
  }
  RecordProperty("relative_rms", std::to_string(std::sqrt(squares / total)));
  EXPECT_LE(std::sqrt(squares / total), 5e-3);
}

// Catches: a singular case that goes on for ever, or that names the number of a merged band.
TEST(FormFactors, TheBandWithoutASolutionIsNamed) {
  Scene scene = furnace_cube(2, 0.5, 1); // r and g are equal and solved as one
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
    scene.reflectance[m * 3 + 2] = 1;
  try {
    solve(scene, at_resolution(32));
    FAIL() << "a white closed room with light has no solution";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("patch 0 "), std::string::npos) << message;
    EXPECT_NE(message.find("band b,"), std::string::npos) << message;
  }
}

/// A lone quad with two opposite corners h above its plane and two below.
Scene bent_quad(double h) {
  SceneBuilder builder;
  const std::uint32_t material = builder.material("sheet", 0.9, 1);
  builder.face(material, {{0, 0, -h}, {1, 0, h}, {1, 1, -h}, {0, 1, h}});
  Scene scene = builder.finish();
  scene.two_sided[0] = 1;
  return scene;
}

// Catches: a two-sided face that is bent within the planarity tolerance and sees its own other
// side.
TEST(FormFactors, ABentSheetDoesNotSeeItself) {
  for (const double h : {0.0, 1e-8, 1e-4, 4e-4}) {
    const Solved solved = solve(bent_quad(h), at_resolution(64));
    ASSERT_EQ(solved.patches.patch_count(), 2u);
    for (std::uint32_t p = 0; p < 2; ++p) {
      EXPECT_EQ(solved.solution.space[p], 1) << "h " << h;
      EXPECT_EQ(solved.radiosity(p, 0), 1);
    }
  }
}

// Catches: sums, tables or planes computed on a thread whose rounding the host program has changed.
TEST(FormFactors, TheCallersRoundingModeChangesNoBit) {
  const Solved nearest = solve(cornell_like(4), at_resolution(64));
  for (const int mode : {FE_UPWARD, FE_TOWARDZERO}) {
    const Scene scene = cornell_like(4);
    std::fesetround(mode);
    const PatchSet patches = patches_of(scene);
    std::fesetround(FE_TONEAREST);
    radiosity::SerialExecutor executor;
    radiosity::Solution solution;
    radiosity::Certificate certificate;
    std::fesetround(mode);
    const Status status = radiosity::solve_scene(scene, nearest.patches, at_resolution(64),
                                                 executor, nullptr, &solution, &certificate);
    std::fesetround(FE_TONEAREST);
    require(status);
    EXPECT_TRUE(same_bits(solution.radiosity, nearest.solution.radiosity));
    EXPECT_EQ(certificate.form_factor_hash, nearest.certificate.form_factor_hash);
    EXPECT_EQ(certificate.radiosity_hash, nearest.certificate.radiosity_hash);
    EXPECT_TRUE(same_bits(patches.area, nearest.patches.area));
  }
}

} // namespace
} // namespace hemicube::test
