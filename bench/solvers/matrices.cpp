#include "bench/solvers/solvers.h"

#include "radiosity/mesh/build_patches.h"
#include "radiosity/mesh/openmesh_subdivide.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/read_scene.h"
#include "raster/hash.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>

namespace hemicube::bench {

using namespace radiosity;
using test::require;

void make_long_matrix(std::uint32_t patches, std::uint32_t row_nonzeros, Executor& executor,
                      FormFactorMatrix* matrix) {
  constexpr std::uint32_t kLongestRun = 128, kWallRows = 64;
  // Runs and gaps have the same distribution, but for a factor.
  const double gap_per_run = static_cast<double>(patches) / static_cast<double>(row_nonzeros) - 1;
  require(matrix->init(patches, patches));
  require(executor.for_each(matrix->block_count(), [&](std::size_t block, std::size_t) {
    std::vector<std::uint32_t> columns;
    std::vector<float> values;
    for (std::uint64_t i = matrix->block_begin(block); i < matrix->block_end(block); ++i) {
      test::Random wall(static_cast<std::uint32_t>(i / kWallRows)); // sees about the same
      test::Random random(static_cast<std::uint32_t>(i));
      columns.clear();
      values.clear();
      for (std::uint32_t j = 0; j < patches;) {
        const std::uint32_t begin = j + random.index(4);
        j = std::min(j + 1 + wall.index(kLongestRun), patches);
        for (std::uint32_t column = begin; column < j; ++column) {
          columns.push_back(column);
          values.push_back(static_cast<float>(0.01 + random.unit()));
        }
        j += static_cast<std::uint32_t>(gap_per_run * (1 + wall.index(kLongestRun)));
      }
      RowView row;
      row.columns = columns;
      row.values = values;
      fit_scale(1, &row);
      HC_TRY(matrix->append_row(block, row));
    }
    return Status();
  }));
}

void make_cornell_matrix(double max_edge, Executor& executor, FormFactorMatrix* matrix,
                         std::vector<double>* area) {
  Scene scene;
  ReadReport read;
  MeshReport mesh;
  PatchSet coarse, fine;
  require(read_scene(HC_SOURCE_DIR "/scenes/cornell.obj", &scene, &read));
  require(build_patches(scene, &coarse, &mesh));
  const std::vector<double> limits(coarse.patch_count(), max_edge);
  require(subdivide(coarse, limits, &fine, &mesh));
  Options options;
  options.resolution = 128;
  Certificate certificate;
  require(compute_form_factors(fine, {}, options, executor, nullptr, matrix, &certificate));
  area->assign(fine.area.begin(), fine.area.end());
}

std::uint64_t hash_of(const Buffer<double>& values) {
  Hash hash;
  for (const double value : values)
    hash.add(value);
  return hash.value();
}

} // namespace hemicube::bench
