#include "tests/support/kept_runs.h"

#include "radiosity/parallel/thread_pool.h"

#include <bit>

namespace hemicube::test {
namespace {

using radiosity::Certificate;

std::string hex(std::uint64_t word) {
  std::string text(16, '0');
  for (std::size_t k = 16; k-- > 0; word >>= 4)
    text[k] = "0123456789abcdef"[word & 15];
  return text;
}

std::string bits(double value) {
  return hex(std::bit_cast<std::uint64_t>(value));
}

std::string text_of(const Certificate& c) {
  std::string text;
  const auto add = [&text](const char* name, std::initializer_list<double> values) {
    text += name;
    for (const double value : values)
      text += " " + bits(value);
    text += "\n";
  };
  const auto number = [](std::uint64_t value) { return static_cast<double>(value); };
  add("patches, hemicubes, nonzeros, subpixel",
      {number(c.patches), number(c.hemicubes), number(c.nonzeros), number(c.subpixel_patches)});
  for (const radiosity::Range& range : {c.row_sum_raw, c.row_sum})
    add("row sums", {range.min, range.mean, range.max});
  for (const radiosity::WorstFraction& worst : {c.space, c.back_side}) {
    add("losses", {worst.mean, worst.max, number(worst.worst_patch), number(worst.count)});
    for (const radiosity::WorstFraction::Patch& one : worst.listed())
      add("loss", {number(one.patch), one.fraction});
  }
  add("setting", {number(static_cast<std::uint64_t>(c.setting.rung)), number(c.setting.resolution),
                  c.setting.target});
  add("errors", {number(c.has_form_factor_error), c.form_factor_error,
                 number(c.has_radiosity_error), c.radiosity_error});
  add("reciprocity", {number(c.has_reciprocity), c.reciprocity.max, c.reciprocity.rms,
                      c.reciprocity_raw.max, c.reciprocity_raw.rms});
  add("balance", {number(c.balanced), number(c.balance.iterations), c.balance.closure_residual,
                  c.balance.max_change, c.balance.rms_change});
  add("solved", {number(c.solved), c.residual, c.estimated_error, number(c.sweeps),
                 number(c.converged), number(c.rounding_floor)});
  for (const radiosity::EnergyBalance& e : c.energy)
    add("energy", {e.emitted, e.absorbed, e.back_side, e.escaped, e.imbalance});
  for (const std::uint64_t hash : {c.scene_hash, c.form_factor_hash, c.radiosity_hash, c.item_hash})
    text += "hash " + hex(hash) + "\n";
  return text;
}

Outcome outcome(const Status& status, const Certificate& certificate) {
  return {status,
          text_of(certificate),
          {},
          certificate.patches,
          certificate.sweeps,
          certificate.setting};
}

} // namespace

KeptRun::KeptRun() {
  files.rows = &rows;
  files.pairs = &pairs;
  files.black_rows = &black_rows;
}

void KeptRun::forget_reports() {
  files.rows_are_finished = false;
  files.rows_resumed = 0;
}

bool Watch::rows(std::uint64_t done, std::uint64_t total) noexcept {
  if (!is_in_loop_)
    loops.push_back({done, done, total});
  is_in_loop_ = true;
  loops.back().last = done;
  has_overshot = has_overshot || done > total;
  return loops.size() - 1 != stop_loop_ || done < stop_after_;
}

bool Watch::balancing(std::uint64_t, double) noexcept {
  is_in_loop_ = false;
  return !stops_in_balancing;
}

bool Watch::sweeps(std::uint64_t, double) noexcept {
  is_in_loop_ = false;
  return !stops_in_sweeps;
}

Outcome solve_kept(const Scene& scene, const radiosity::Options& options, KeptRun* kept,
                   std::uint32_t threads, Watch* watch) {
  radiosity::Options with_files = options;
  if (kept != nullptr) {
    kept->forget_reports();
    with_files.files = &kept->files;
  }
  radiosity::ThreadPool pool;
  require(pool.init(threads));
  radiosity::Solution solution;
  Certificate certificate;
  const Status status = radiosity::solve_scene(scene, patches_of(scene), with_files, pool, watch,
                                               &solution, &certificate);
  Outcome result = outcome(status, certificate);
  const radiosity::Solution& s = solution;
  for (const Buffer<double>* values : {&s.reflectance, &s.exitance, &s.irradiance, &s.radiosity,
                                       &s.row_sum, &s.space, &s.back_side})
    for (const double value : *values)
      result.values.push_back(bits(value));
  return result;
}

Outcome form_factors_kept(const Scene& scene, const radiosity::Options& options, KeptRun* kept,
                          std::uint32_t threads, Watch* watch) {
  radiosity::Options with_files = options;
  if (kept != nullptr) {
    kept->forget_reports();
    with_files.files = &kept->files;
  }
  radiosity::ThreadPool pool;
  require(pool.init(threads));
  radiosity::FormFactorMatrix matrix;
  Certificate certificate;
  const Status status = radiosity::compute_form_factors(patches_of(scene), {}, with_files, pool,
                                                        watch, &matrix, &certificate);
  Outcome result = outcome(status, certificate);
  if (!status.ok())
    return result;
  require(matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i)
      result.values.push_back(hex(radiosity::hash_row(matrix.row(i))));
    return Status();
  }));
  return result;
}

Scene kept_room(double reflectance, double exitance) {
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", reflectance, 0);
  const std::uint32_t black = builder.material("black", 0, 0);
  const std::uint32_t lamp = builder.material("lamp", 0, exitance);
  const std::uint32_t table = builder.material("table", 0.4, 0);
  builder.grid([&](int i, int) { return i == 1 ? wall : black; }, {0, 0, 0}, {0, 2, 0}, {0, 2, 1},
               {0, 0, 1}, 3, 1); // x low
  builder.grid(wall, {3, 0, 0}, {3, 0, 1}, {3, 2, 1}, {3, 2, 0}, 1, 3);
  builder.grid(wall, {0, 0, 0}, {0, 0, 1}, {3, 0, 1}, {3, 0, 0}, 1, 3);
  builder.grid(black, {0, 2, 0}, {3, 2, 0}, {3, 2, 1}, {0, 2, 1}, 3, 1);
  builder.grid(wall, {0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, 3, 3);
  builder.box({table, table, table, table, table, table}, {1.2, 0.7, 0.1}, {1.9, 1.2, 0.35},
              {1, 1, 1}, false);
  builder.grid(table, {0.2, 0.2, 0.5}, {0.6, 0.2, 0.5}, {0.6, 0.6, 0.5}, {0.2, 0.6, 0.5}, 1, 1);
  builder.grid([&](int i, int j) { return i == 1 && j != 1 ? lamp
                                          : i == 2         ? black
                                                           : wall; },
               {0, 0, 1}, {0, 2, 1}, {3, 2, 1}, {3, 0, 1}, 3, 3);
  return builder.finish();
}

Scene kept_open_scene() {
  SceneBuilder builder;
  const double red[] = {0.8, 0.1, 0.1}, grey[] = {0.5, 0.5, 0.5}, none[] = {0, 0, 0},
               light[] = {3, 2, 1};
  const std::uint32_t floor = builder.material("floor", grey, none);
  const std::uint32_t wall = builder.material("wall", red, none);
  const std::uint32_t lamp = builder.material("lamp", none, light);
  builder.grid(floor, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, 4, 4);
  builder.grid(wall, {0, 0, 0}, {0, 2, 0}, {0, 2, 1}, {0, 0, 1}, 3, 2);
  builder.grid(lamp, {0.5, 0.5, 1.5}, {0.5, 1.1, 1.5}, {1, 1.1, 1.5}, {1, 0.5, 1.5}, 1, 2);
  builder.face(wall, {{0.4, 0.4, 0.7}, {1.1, 0.4, 0.8}, {1.1, 1.1, 0.8}, {0.4, 1.1, 0.7}});
  builder.face(floor, {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}});
  builder.face(lamp, {{9, 9, 10}, {9, 10, 10}, {10, 9, 10}});
  Scene scene = builder.finish();
  for (double& exitance : scene.space_exitance)
    exitance = 0.5;
  return scene;
}

} // namespace hemicube::test
