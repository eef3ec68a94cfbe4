// Time of each kernel of the rasterizer on each instruction set: 16 polygons, one node, one row of
// pixels, everything in the first-level caches. Arguments: the side of a polygon in pixels.
#include "raster/face_view.h"
#include "raster/item_buffer.h"
#include "raster/polygon_tree.h"
#include "raster/simd/dispatch.h"
#include "tests/support/drawn_face.h"
#include "tests/support/scenes_shared.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

using namespace hemicube;
using namespace hemicube::raster;
using hemicube::test::PolygonSet;
using hemicube::test::require;

namespace {

constexpr double kPixel = 2.0 / 256;

/// A 4 x 4 grid of squares before an eye that looks along z, `side` pixels each, not aligned with
/// the pixels.
PolygonSet squares(int side) {
  PolygonSet set;
  const double step = side * kPixel, start = -2 * step + 0.3 * kPixel;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const auto corner = [&](int a, int b) {
        const double u = start + (i + a) * step, v = start + (j + b) * step;
        return Vec3(0.96 * u - 0.28 * v, 0.28 * u + 0.96 * v, 1 + 0.1 * u);
      };
      set.add({corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)});
    }
  return set;
}

/// A cluster, a window that shows all of it, and what the kernels write.
class Stage {
public:
  explicit Stage(int side) {
    const PolygonSet set = squares(side);
    require(tree.build(set.view()));
    require(buffer.init());
    buffer.begin({0, 0, 256, 256});
    cluster = tree.cluster(0);
    const PixelGrid grid = hemicube_grid(Face::kTop, 256);
    window.frame[0][0] = window.frame[1][1] = window.frame[2][2] = 1;
    window.skip_normal[0] = std::numeric_limits<double>::quiet_NaN();
    window.x0 = grid.x0;
    window.dx = grid.dx;
    window.y0 = grid.y0;
    window.dy = grid.dy;
    window.unit = 1;
    window.columns_per_x = 1 / grid.dx;
    window.rows_per_y = 1 / grid.dy;
    window.x_end = window.y_end = 256;
    window.x_reach = window.y_reach = 3;
    window.horizon_axis = 2;
    window.above_horizon = window.draw_backs = 1;
    moved.resize(4 * 3 * kBatch * 3 / 2);
    edges.resize(4 * 3 * kBatch);
    batch.edges = edges.data();
    node.plane_count = 5;
    node.slack = 1e-5f;
    node.frame[0][0] = node.frame[1][1] = node.frame[2][2] = 1;
    for (float(&plane)[3] : node.inward)
      plane[2] = 1;
    for (int axis = 0; axis < 3; ++axis)
      node.eye[axis] = static_cast<float>(-tree.origin()[axis]);
    node.x_scale = node.y_scale = 128;
    node.x_offset = node.y_offset = 127.5f;
    node.columns = node.rows = 256;
  }

  std::uint32_t prepare(const Kernels& kernels) {
    const std::uint32_t drawn = kernels.find_bounds(&cluster, &window, moved.data(), &batch);
    kernels.set_up(&cluster, &window, moved.data(), drawn, &batch);
    return drawn;
  }

  PolygonTree tree;
  ItemBuffer buffer;
  Cluster cluster{};
  WindowProblem window{};
  NodeProblem node{};
  PolygonBatch batch{};
  std::vector<double> moved, edges;
};

void test_node(benchmark::State& state, const Kernels& kernels) {
  Stage stage(8);
  NodeResult result;
  for (auto _ : state) {
    kernels.test_node(stage.tree.nodes().data(), &stage.node, &result);
    benchmark::DoNotOptimize(result.reached);
  }
}

void find_bounds(benchmark::State& state, const Kernels& kernels) {
  Stage stage(8);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        kernels.find_bounds(&stage.cluster, &stage.window, stage.moved.data(), &stage.batch));
}

void set_up(benchmark::State& state, const Kernels& kernels) {
  Stage stage(8);
  const std::uint32_t drawn = stage.prepare(kernels);
  for (auto _ : state)
    kernels.set_up(&stage.cluster, &stage.window, stage.moved.data(), drawn, &stage.batch);
}

void draw(benchmark::State& state, const Kernels& kernels) {
  Stage stage(static_cast<int>(state.range(0)));
  const std::uint32_t drawn = stage.prepare(kernels);
  if (drawn != 0xffff)
    state.SkipWithError("not all polygons are seen");
  for (auto _ : state)
    kernels.draw(&stage.batch, drawn, &stage.buffer.planes());
}

void hidden(benchmark::State& state, const Kernels& kernels) {
  Stage stage(static_cast<int>(state.range(0)));
  const std::uint32_t drawn = stage.prepare(kernels);
  kernels.draw(&stage.batch, drawn, &stage.buffer.planes());
  for (std::int32_t y = 0; y < kTilesPerRow; ++y)
    stage.buffer.planes().dirty[y] = 0xffffffffu; // the first look brings them up to date
  for (auto _ : state)
    benchmark::DoNotOptimize(kernels.hidden(&stage.batch, drawn, &stage.buffer.planes()));
}

void take_runs(benchmark::State& state, const Kernels& kernels) {
  const auto length = static_cast<std::size_t>(state.range(0));
  std::vector<Item> row(1 + 256 + 16), runs(256 + 16);
  std::vector<float> depths(256 + 16);
  std::vector<std::int32_t> begins(256 + 16);
  std::vector<Item> drawn(256);
  for (std::size_t x = 0; x < 256; ++x)
    drawn[x] = static_cast<Item>(x / length);
  for (auto _ : state) {
    std::copy(drawn.begin(), drawn.end(), row.begin() + 1); // the kernel clears it
    benchmark::DoNotOptimize(
        kernels.take_runs(row.data() + 1, depths.data(), 256, begins.data(), runs.data()));
  }
}

} // namespace

int main(int argc, char** argv) {
  for (const std::string& isa : hemicube::test::kernels_here()) {
    const Kernels* kernels = kernels_by_name(isa);
    const auto add = [&](const char* name, void (*run)(benchmark::State&, const Kernels&)) {
      return benchmark::RegisterBenchmark(
          (std::string(name) + "/" + isa).c_str(),
          [run, kernels](benchmark::State& state) { run(state, *kernels); });
    };
    add("test_node", test_node);
    add("find_bounds", find_bounds);
    add("set_up", set_up);
    add("draw", draw)->Arg(2)->Arg(6)->Arg(16)->Arg(40);
    add("hidden", hidden)->Arg(6)->Arg(40);
    add("take_runs", take_runs)->Arg(2)->Arg(8)->Arg(32);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
