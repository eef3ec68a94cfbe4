#include "radiosity/c_api/handles.h"

#include <limits>

namespace hemicube::radiosity::c_api {

Status write_certificate(const Certificate& certificate, hc_certificate* to) noexcept {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Certificate& c = certificate;
  hc_certificate r = {};
  r.patches = c.patches;
  r.hemicubes = c.hemicubes;
  r.nonzeros = c.nonzeros;
  r.subpixel_patches = c.subpixel_patches;
  r.rung = static_cast<std::int32_t>(c.setting.rung) + HC_RUNG_HEMICUBE;
  r.resolution = c.setting.resolution;
  r.target = c.setting.target;
  r.row_sum_raw_min = c.row_sum_raw.min;
  r.row_sum_raw_mean = c.row_sum_raw.mean;
  r.row_sum_raw_max = c.row_sum_raw.max;
  r.row_sum_min = c.row_sum.min;
  r.row_sum_mean = c.row_sum.mean;
  r.row_sum_max = c.row_sum.max;
  r.space_mean = c.space.mean;
  r.space_max = c.space.max;
  r.back_side_mean = c.back_side.mean;
  r.back_side_max = c.back_side.max;
  r.form_factor_error = c.has_form_factor_error ? c.form_factor_error : kNone;
  r.radiosity_error = c.has_radiosity_error ? c.radiosity_error : kNone;
  r.reciprocity_max = c.has_reciprocity ? c.reciprocity.max : kNone;
  r.reciprocity_rms = c.has_reciprocity ? c.reciprocity.rms : kNone;
  r.balance_max_change = c.balanced ? c.balance.max_change : kNone;
  r.balance_rms_change = c.balanced ? c.balance.rms_change : kNone;
  r.balance_closure_residual = c.balanced ? c.balance.closure_residual : kNone;
  r.residual = c.has_residual ? c.residual : kNone;
  r.estimated_error = c.has_residual ? c.estimated_error : kNone;
  r.sweeps = c.sweeps;
  r.shots = c.shots;
  r.unshot = c.has_shots ? c.unshot : kNone;
  r.unshot_bound = c.has_shots ? c.unshot_bound : kNone;
  r.solved = c.solved ? 1 : 0;
  r.converged = c.converged ? 1 : 0;
  r.scene_hash = c.scene_hash;
  r.form_factor_hash = c.form_factor_hash;
  r.radiosity_hash = c.radiosity_hash;
  return write_struct("certificate", r, sizeof(hc_certificate), to);
}

} // namespace hemicube::radiosity::c_api
