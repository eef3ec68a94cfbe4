#include "radiosity/adaptive.h"

#include "radiosity/dial.h"
#include "radiosity/light_model.h"
#include "radiosity/refine/element_rows.h"
#include "radiosity/refine/variation.h"
#include "radiosity/row_run.h"
#include "radiosity/solve/gauss_seidel.h"
#include "radiosity/solver_watch.h"
#include "raster/fp_environment.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace hemicube::radiosity {
namespace {

/// Of the squared errors that are too large, so much is dealt with in a round: elements go first to
/// where they are needed most (Doerfler 1996).
constexpr double kBulk = 0.5;
constexpr std::uint32_t kLeastResolution = 256; ///< where it is chosen
/// Of the light that cuts are chosen by.
constexpr double kRoughTolerance = 1e-4;
constexpr double kEdgePart = 8; ///< the smallest elements, without a wish, to patches

class AdaptiveSolver {
public:
  AdaptiveSolver(const Scene& scene, const PatchSet& patches, const Refinement& refinement,
                 const Options& options, Executor& executor, Progress* progress, ElementTree* tree,
                 RefinementReport* report)
      : scene_(scene), patches_(patches), limits_(refinement), options_(options),
        executor_(executor), progress_(progress), tree_(*tree), report_(*report) {}

  Status run(PatchSet* elements, Solution* solution, Certificate* certificate);

private:
  Status begin();
  /// @param is_cut  receives whether there are new elements
  Status refine(const PatchSet& elements, const FormFactorMatrix& matrix, bool* is_cut);
  Status find_variations(const PatchSet& elements, const FormFactorMatrix& matrix,
                         std::vector<double>* variation);
  /// An element whose row is to be gathered.
  struct NewElement {
    std::uint32_t node;
    unsigned side;
    std::size_t first_corner, corner_count;
  };

  Status gather_patches();
  Status gather(const std::vector<std::uint32_t>& nodes);
  std::uint32_t patch_of(std::uint32_t node, unsigned side) const {
    return side == 0 ? tree_.patch_of(node) : back_of_[tree_.patch_of(node)];
  }
  void cut(const std::vector<std::uint32_t>& wanted, std::vector<std::uint32_t>* cut);
  bool cut_one(std::uint32_t leaf, std::vector<std::uint32_t>* cut);

  const Scene& scene_;
  const PatchSet& patches_;
  Refinement limits_;
  const Options& options_;
  Executor& executor_;
  Progress* progress_;
  ElementTree& tree_;
  RefinementReport& report_;

  std::vector<std::uint32_t> back_of_; ///< [front] its back
  RowGeometry geometry_;
  RungSetting setting_;
  Buffer<double> light_guess_; ///< [patch] all bands together
  ElementRows rows_;
};

Status check(const Refinement& r) {
  if (!(r.variation > 0 && std::isfinite(r.variation)))
    return Status::error(StatusCode::kInvalidArgument, "a variation of ", r.variation,
                         " cannot be reached: give a number > 0, such as 0.05");
  if (!(r.min_edge >= 0 && std::isfinite(r.min_edge)))
    return Status::error(StatusCode::kInvalidArgument, "the shortest edge is ", r.min_edge,
                         ": give a length, or 0 for one that is chosen");
  return {};
}

Status AdaptiveSolver::run(PatchSet* elements, Solution* solution, Certificate* certificate) {
  HC_TRY(begin());
  FormFactorMatrix matrix;
  for (bool is_cut = true; is_cut;) {
    HC_TRY(tree_.make_mesh(elements));
    HC_TRY(rows_.make_matrix(tree_, *elements, executor_, &matrix));
    report_.elements = elements->patch_count();
    HC_TRY(refine(*elements, matrix, &is_cut));
  }
  Options options = options_;
  options.files = nullptr;
  return solve_rows(scene_, *elements, setting_, &matrix, options, executor_, progress_, solution,
                    certificate);
}

Status AdaptiveSolver::begin() {
  HC_TRY(check(limits_));
  if (limits_.max_elements < patches_.patch_count())
    return Status::error(StatusCode::kInvalidArgument, "at most ", limits_.max_elements,
                         " elements are allowed, but there are ", patches_.patch_count(),
                         " patches to begin with: allow more, or give a coarser mesh");
  double area = 0;
  for (const double a : patches_.area)
    area += a;
  if (limits_.min_edge == 0)
    limits_.min_edge = std::sqrt(area / patches_.patch_count()) / kEdgePart;
  report_ = {};
  report_.limits = limits_;
  report_.patches = patches_.patch_count();
  HC_TRY(tree_.init(scene_, patches_));
  back_of_.assign(patches_.front_count, ElementTree::kNone);
  std::uint32_t back = patches_.front_count;
  for (std::uint32_t front = 0; front < patches_.front_count; ++front)
    if (tree_.side_count(front) == 2)
      back_of_[front] = back++;

  LightModel light;
  HC_TRY(light.init(scene_, patches_));
  const LightProblem problem = light.problem(patches_);
  HC_TRY(geometry_.init(patches_));
  HC_TRY(guess_patch_light(problem, &light_guess_));
  setting_ = {options_.rung, options_.resolution, options_.error};
  HC_TRY(Dial(&geometry_, &problem, options_, executor_).choose(&setting_));
  // The pixels of one point make light vary that does not: it would be cut after.
  if (options_.choose_rung)
    setting_.rung = std::max(setting_.rung, Rung::kArea);
  if (options_.choose_resolution)
    setting_.resolution = std::max(setting_.resolution, kLeastResolution);
  return gather_patches();
}

Status AdaptiveSolver::gather_patches() {
  const std::uint32_t count = patches_.patch_count();
  RowRun run;
  FormFactorMatrix* rows = nullptr;
  HC_TRY(
      run.init(&geometry_, setting_, options_, count, executor_, progress_, light_guess_.span()));
  HC_TRY(rows_.begin_round(count, count, &rows));
  for (std::uint32_t front = 0; front < patches_.front_count; ++front)
    for (unsigned side = 0; side < tree_.side_count(front); ++side)
      rows_.assign(front, side, patch_of(front, side));
  report_.rows_gathered += count;
  return run.build_all(
      count, [](std::uint32_t) { return true; },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        return rows->append_row(i / FormFactorMatrix::kBlockRows, row, *facts);
      });
}

/// The rows of the children of nodes that were cut.
Status AdaptiveSolver::gather(const std::vector<std::uint32_t>& nodes) {
  std::vector<NewElement> added;
  std::vector<Vec3> corners, polygon;
  for (const std::uint32_t node : nodes)
    for (std::uint32_t k = 0; k < tree_.child_count(node); ++k) {
      const std::uint32_t child = tree_.child(node, k);
      if (!tree_.is_leaf(child))
        continue; // was cut itself
      for (unsigned side = 0; side < tree_.side_count(child); ++side) {
        tree_.corners_of(child, &polygon);
        if (side == 1) // as add_back_sides does
          std::reverse(polygon.begin() + 1, polygon.end());
        added.push_back({child, side, corners.size(), polygon.size()});
        corners.insert(corners.end(), polygon.begin(), polygon.end());
      }
    }
  RowRun run;
  FormFactorMatrix* rows = nullptr;
  HC_TRY(run.init(&geometry_, setting_, options_, added.size(), executor_, progress_,
                  light_guess_.span()));
  HC_TRY(rows_.begin_round(added.size(), patches_.patch_count(), &rows));
  for (std::size_t i = 0; i < added.size(); ++i)
    rows_.assign(added[i].node, added[i].side, i);
  report_.rows_gathered += added.size();
  return run.build(
      added.size(),
      [&](std::uint64_t i, RowPlace* place) {
        const NewElement& element = added[i];
        place->patch = patch_of(element.node, element.side);
        place->part = {corners.data() + element.first_corner, element.corner_count};
        return true;
      },
      [&](std::uint64_t i, const RowView& row, const RowFacts* facts) {
        return rows->append_row(i / FormFactorMatrix::kBlockRows, row, *facts);
      });
}

/// How much the light on elements varies across each, well enough to choose by.
Status AdaptiveSolver::find_variations(const PatchSet& elements, const FormFactorMatrix& matrix,
                                       std::vector<double>* variation) {
  LightModel light;
  Buffer<double> radiosity, irradiance;
  Convergence convergence;
  HC_TRY(light.init(scene_, elements));
  const LightProblem problem = light.problem(elements);
  SolverWatch watch(scene_, elements, light, options_, progress_);
  const SolverOptions rough{std::max(options_.tolerance, kRoughTolerance), options_.max_sweeps,
                            options_.kernels};
  const Status solved = watch.outcome(gauss_seidel(matrix, problem, rough, executor_, &watch,
                                                   &radiosity, &irradiance, &convergence));
  if (!solved.ok() && solved.code() != StatusCode::kNotConverged)
    return solved;
  // The scale: the area-weighted mean of what is reflected, over what reflects.
  const std::uint32_t bands = problem.band_count;
  std::vector<double> power(bands), area(bands);
  for (std::size_t at = 0; at < radiosity.size(); ++at)
    if (light.reflectance[at] > 0) {
      power[at % bands] += elements.area[at / bands] * (radiosity[at] - light.exitance[at]);
      area[at % bands] += elements.area[at / bands];
    }
  for (std::uint32_t b = 0; b < bands; ++b)
    power[b] = area[b] > 0 ? power[b] / area[b] : 0;
  return find_variation(elements, radiosity.span(), light.exitance.span(), power, variation);
}

Status AdaptiveSolver::refine(const PatchSet& elements, const FormFactorMatrix& matrix,
                              bool* is_cut) {
  std::vector<double> variation;
  HC_TRY(find_variations(elements, matrix, &variation));
  struct Candidate {
    double weight;
    std::uint32_t leaf, order;
  };
  std::vector<Candidate> candidates;
  const std::vector<std::uint32_t> leaves = tree_.leaves();
  std::uint32_t back = elements.front_count;
  double all = 0;
  report_.largest_variation = 0;
  report_.end = RefinementEnd::kVariation;
  for (std::uint32_t k = 0; k < leaves.size(); ++k) {
    double varies = variation[k];
    if (tree_.side_count(leaves[k]) == 2)
      varies = std::max(varies, variation[back++]);
    report_.largest_variation = std::max(report_.largest_variation, varies);
    if (!(varies > limits_.variation))
      continue;
    if (tree_.pieces_of(leaves[k], limits_.min_edge) == 0) {
      report_.end = RefinementEnd::kMinEdge;
      continue;
    }
    // As the squared error of a constant over the element.
    candidates.push_back({varies * varies * elements.area[k], leaves[k], k});
    all += candidates.back().weight;
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.order < b.order;
  });
  std::vector<std::uint32_t> wanted, cut_nodes;
  double taken = 0;
  for (std::size_t k = 0; k < candidates.size() && taken < kBulk * all; ++k) {
    wanted.push_back(candidates[k].leaf);
    taken += candidates[k].weight;
  }
  cut(wanted, &cut_nodes);
  *is_cut = !cut_nodes.empty();
  if (!*is_cut)
    return {};
  ++report_.rounds;
  return gather(cut_nodes);
}

bool AdaptiveSolver::cut_one(std::uint32_t leaf, std::vector<std::uint32_t>* cut) {
  const std::uint64_t pieces = tree_.pieces_of(leaf, limits_.min_edge);
  if (pieces == 0)
    return false;
  if (tree_.element_count() + (pieces - 1) * tree_.side_count(leaf) > limits_.max_elements) {
    report_.end = RefinementEnd::kMaxElements;
    return false;
  }
  tree_.split(leaf);
  cut->push_back(leaf);
  return true;
}

/// Cuts what is wanted, then what would be too coarse beside it, but for slender shapes that
/// min_edge does not allow to be cut.
void AdaptiveSolver::cut(const std::vector<std::uint32_t>& wanted,
                         std::vector<std::uint32_t>* cut) {
  for (const std::uint32_t leaf : wanted)
    if (!cut_one(leaf, cut))
      break; // there are enough elements
  for (bool is_done = false; !is_done;) {
    is_done = true;
    for (const std::uint32_t leaf : tree_.uneven_leaves())
      if (cut_one(leaf, cut))
        is_done = false;
  }
}

} // namespace

const char* refinement_end_name(RefinementEnd end) noexcept {
  return end == RefinementEnd::kVariation ? "variation"
         : end == RefinementEnd::kMinEdge ? "min_edge"
                                          : "max_elements";
}

Status solve_adaptive(const Scene& scene, const PatchSet& patches, const Refinement& refinement,
                      const Options& options, Executor& executor, Progress* progress,
                      ElementTree* tree, PatchSet* elements, Solution* solution,
                      Certificate* certificate, RefinementReport* report) {
  const FloatEnvironment environment;
  try {
    return AdaptiveSolver(scene, patches, refinement, options, executor, progress, tree, report)
        .run(elements, solution, certificate);
  } catch (const std::bad_alloc&) {
    return Status::error(StatusCode::kOutOfMemory, "out of memory refining ", patches.patch_count(),
                         " patches");
  }
}

} // namespace hemicube::radiosity
