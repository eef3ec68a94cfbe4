#include "radiosity/c_api/call.h"
#include "radiosity/c_api/handles.h"
#include "radiosity/form_factor/matrix_file.h"

#include <limits>

namespace hemicube::radiosity::c_api {
namespace {

Status copy_rows(const FormFactorMatrix& from, FormFactorMatrix* to) noexcept {
  Buffer<std::uint32_t> all;
  HC_TRY(all.resize(static_cast<std::size_t>(from.row_count())));
  for (std::uint32_t i = 0; i < all.size(); ++i)
    all[i] = i;
  return to->copy_rows(from, all.span());
}

/// With form factors that are there: shared with other calls, unless balance is to change them.
Status solve_given(const hc_scene& scene, const hc_form_factors& given, Call& call,
                   hc_solution* made) noexcept {
  if (!given.are_all || given.geometry != hash_geometry(scene.patches))
    return Status::error(StatusCode::kInvalidArgument, "the form factors are not those of all ",
                         "patches of a scene with the same polygons");
  FormFactorMatrix copy;
  FormFactorMatrix* rows = const_cast<FormFactorMatrix*>(&given.matrix);
  if (call.options().balance) {
    HC_TRY(copy_rows(given.matrix, &copy));
    rows = &copy;
  }
  return solve_rows(scene.scene, scene.patches, given.certificate.setting, rows, call.options(),
                    call.executor(), call.progress(), &made->solution, &made->certificate);
}

Status solve(const hc_scene* scene, const hc_form_factors* form_factors, const hc_options* options,
             NewHandle<hc_solution>* made) noexcept {
  if (scene == nullptr)
    return null_argument("scene");
  Call call;
  HC_TRY(call.begin(options));
  HC_TRY(made->make());
  return form_factors != nullptr
             ? solve_given(*scene, *form_factors, call, &**made)
             : solve_scene(scene->scene, scene->patches, call.options(), call.executor(),
                           call.progress(), &(*made)->solution, &(*made)->certificate);
}

Status get_values(const hc_solution* solution, int quantity, std::uint64_t count,
                  double* values) noexcept {
  if (solution == nullptr || values == nullptr)
    return null_argument(solution == nullptr ? "solution" : "values");
  const Solution& s = solution->solution;
  const Buffer<double>* const all[] = {&s.radiosity, &s.irradiance, &s.row_sum, &s.space,
                                       &s.back_side};
  if (quantity < HC_RADIOSITY || quantity > HC_BACK_SIDE)
    return Status::error(StatusCode::kInvalidArgument, "there is no quantity ", quantity);
  const Buffer<double>& from = *all[quantity];
  if (count != from.size())
    return Status::error(StatusCode::kInvalidArgument, "count is ", count, ", but there are ",
                         from.size(), " values");
  std::memcpy(values, from.data(), from.size() * sizeof(double));
  return {};
}

Status get_energy(const hc_solution* solution, std::uint32_t band, hc_energy* energy) noexcept {
  if (solution == nullptr)
    return null_argument("solution");
  if (band >= solution->solution.band_count)
    return Status::error(StatusCode::kInvalidArgument, "band ", band, " does not exist: there are ",
                         solution->solution.band_count, ", counted from 0");
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  hc_energy filled = {0, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  if (const Buffer<EnergyBalance>& bands = solution->certificate.energy; !bands.empty()) {
    const EnergyBalance& e = bands[band];
    filled = {0, e.emitted, e.absorbed, e.back_side, e.escaped, e.cut, e.unshot, e.imbalance};
  }
  return write_struct("energy", filled, sizeof(hc_energy), energy);
}

} // namespace
} // namespace hemicube::radiosity::c_api

using namespace hemicube;
using namespace hemicube::radiosity::c_api;

int hc_solve(hc_scene* scene, const hc_form_factors* form_factors, const hc_options* options,
             hc_solution** solution) {
  if (solution == nullptr)
    return finish(null_argument("solution"));
  *solution = nullptr;
  const Held held_scene(scene);
  const Held held_rows(form_factors);
  NewHandle<hc_solution> made;
  const Status status = solve(scene, form_factors, options, &made);
  if (status.ok() || status.code() == StatusCode::kNotConverged)
    made.give(solution);
  return finish(status);
}

void hc_solution_release(hc_solution* solution) {
  release_handle(solution);
}

int hc_solution_get_values(const hc_solution* solution, int quantity, uint64_t count,
                           double* values) {
  return finish(get_values(solution, quantity, count, values));
}

int hc_solution_get_energy(const hc_solution* solution, uint32_t band, hc_energy* energy) {
  return finish(get_energy(solution, band, energy));
}

int hc_solution_get_certificate(const hc_solution* solution, hc_certificate* certificate) {
  return finish(solution != nullptr ? write_certificate(solution->certificate, certificate)
                                    : null_argument("solution"));
}
