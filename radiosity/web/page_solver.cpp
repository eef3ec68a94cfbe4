#include "radiosity/web/page_solver.h"

#include "radiosity/shoot_scene.h"
#include "radiosity/solver_watch.h"

namespace hemicube::radiosity::web {
namespace {

constexpr std::uint64_t kApart = FormFactorMatrix::kBlockRows;

} // namespace

Status PageSolver::open(std::span<const std::byte> scene) {
  HC_TRY(unpack_page_scene(scene, &page_));
  for (const double exitance : page_.scene.space_exitance)
    if (exitance != 0)
      return Status::error(StatusCode::kInvalidArgument, "space sends light into the scene, ",
                           "which the page does not show");
  HC_TRY(reflectance_.assign(page_.scene.reflectance.span()));
  HC_TRY(exitance_.assign(page_.scene.exitance.span()));
  return geometry_.init(page_.patches);
}

Status PageSolver::set_resolution(std::uint32_t resolution) {
  const std::uint32_t count = patch_count();
  options_.resolution = resolution;
  run_.emplace();
  HC_TRY(run_->init(&geometry_, {Rung::kHemicube, resolution, options_.error}, options_, count,
                    executor_, nullptr));
  HC_TRY(kept_.init(count * kApart, count));
  HC_TRY(statistics_.init(count, false));
  rows_made_ = next_to_fill_ = 0;
  return {};
}

Status PageSolver::set_light(double reflectance, double exitance) {
  Scene& scene = page_.scene;
  for (std::size_t at = 0; at < reflectance_.size(); ++at) {
    scene.reflectance[at] = reflectance * reflectance_[at];
    scene.exitance[at] = exitance * exitance_[at];
    if (!(scene.reflectance[at] >= 0 && scene.reflectance[at] < 1 && scene.exitance[at] >= 0))
      return Status::error(StatusCode::kInvalidArgument, "reflectance ", scene.reflectance[at],
                           " or exitance ", scene.exitance[at], " is out of range");
  }
  HC_TRY(model_.init(scene, page_.patches));
  problem_ = model_.problem(page_.patches);
  HC_TRY(shooting_.init(problem_, {}, this));
  return shooting_.survey();
}

bool PageSolver::is_converged() const noexcept {
  return shooting_.unshot() <= kDefaultStopUnshot;
}

Status PageSolver::shoot() {
  return is_converged() ? Status() : shooting_.shoot();
}

Status PageSolver::fill() {
  while (next_to_fill_ < patch_count() && is_made(next_to_fill_))
    ++next_to_fill_;
  return next_to_fill_ < patch_count() ? make(next_to_fill_) : Status();
}

std::uint64_t PageSolver::form_factor_hash() const {
  if (rows_made_ < patch_count())
    return 0;
  Certificate certificate;
  statistics_.summarise(&certificate);
  return certificate.form_factor_hash;
}

Status PageSolver::displayed(Solution* solution) {
  const std::span<const double> none;
  return fill_light(model_, page_.scene.band_count(), shooting_.light().radiosity().span(),
                    is_converged() ? shooting_.light().unshot().ambient() : none, solution);
}

Status PageSolver::prepare(std::span<const std::uint32_t> patches) {
  turn_ = patches; // one row a shot: each is made when it is needed
  return {};
}

Status PageSolver::row(std::size_t k, RowView* row) {
  if (!is_made(turn_[k]))
    HC_TRY(make(turn_[k]));
  *row = kept_.row(turn_[k] * kApart);
  return {};
}

bool PageSolver::is_made(std::uint32_t patch) const noexcept {
  return is_computed(kept_.row(patch * kApart));
}

Status PageSolver::make(std::uint32_t patch) {
  const auto place_of = [&](std::uint64_t, RowPlace* place) {
    place->patch = patch;
    return true;
  };
  const auto keep = [&](std::uint64_t, const RowView& row, const RowFacts* facts) {
    HC_TRY(kept_.reserve_block(patch, row.columns.size())); // it gets no other
    HC_TRY(kept_.append_row(patch, row, *facts));
    statistics_.record(patch, row, *facts);
    return Status();
  };
  HC_TRY(run_->build(1, place_of, keep));
  ++rows_made_;
  return {};
}

} // namespace hemicube::radiosity::web
