#include "radiosity/output/report_json.h"

#include "radiosity/output/number_text.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity {
namespace {

using Json = nlohmann::ordered_json;

/// Sets a key unless the number is not finite: JSON has no word for those.
void set(Json* object, const char* key, double value) {
  if (std::isfinite(value))
    (*object)[key] = value;
}

Json range_json(const Range& range) {
  Json json = Json::object();
  set(&json, "min", range.min);
  set(&json, "mean", range.mean);
  set(&json, "max", range.max);
  return json;
}

Json fraction_json(const WorstFraction& fraction) {
  Json json = Json::object();
  set(&json, "mean", fraction.mean);
  set(&json, "max", fraction.max);
  if (fraction.max > 0)
    json["worst_patch"] = fraction.worst_patch;
  json["count"] = fraction.count;
  if (fraction.count == 0)
    return json;
  Json& worst = json["worst"] = Json::array();
  for (const WorstFraction::Patch& one : fraction.listed())
    worst.push_back({{"patch", one.patch}, {"fraction", one.fraction}});
  return json;
}

Json energy_json(const Certificate& certificate) {
  constexpr std::pair<const char*, double EnergyBalance::*> kQuantities[] = {
      {"emitted", &EnergyBalance::emitted},
      {"absorbed", &EnergyBalance::absorbed},
      {"back_side", &EnergyBalance::back_side},
      {"escaped", &EnergyBalance::escaped},
      {"cut", &EnergyBalance::cut},
      {"unshot", &EnergyBalance::unshot},
      {"imbalance", &EnergyBalance::imbalance}};
  Json json = Json::object();
  for (const auto& [key, quantity] : kQuantities) {
    const bool is_of_shots = quantity == &EnergyBalance::cut || quantity == &EnergyBalance::unshot;
    if (is_of_shots && certificate.has_residual)
      continue;
    Json values = Json::array();
    for (const EnergyBalance& band : certificate.energy)
      values.push_back(band.*quantity);
    json[key] = std::move(values);
  }
  return json;
}

Json repaired_json(const MeshReport& mesh) {
  const std::pair<const char*, std::uint64_t> counts[] = {
      {"dropped_repeated_index", mesh.dropped_repeated_index},
      {"dropped_zero_area", mesh.dropped_zero_area},
      {"triangulated_concave", mesh.triangulated_concave},
      {"triangulated_warped", mesh.triangulated_warped},
      {"duplicate_faces", mesh.duplicate_faces},
      {"non_manifold_faces", mesh.non_manifold_faces}};
  Json json = Json::object();
  for (const auto& [reason, count] : counts)
    if (count != 0)
      json[reason] = count;
  return json;
}

Json skipped_json(const std::map<std::string, std::uint64_t>& skipped) {
  Json json = Json::object();
  for (const auto& [reason, count] : skipped)
    if (count != 0)
      json[reason] = count;
  return json;
}

Json hashes_json(const Certificate& certificate) {
  Json json = Json::object();
  json["scene"] = hex(certificate.scene_hash);
  json["form_factors"] = hex(certificate.form_factor_hash);
  if (certificate.solved)
    json["radiosity"] = hex(certificate.radiosity_hash);
  if (certificate.has_item_hash)
    json["items"] = hex(certificate.item_hash);
  return json;
}

Json reciprocity_json(const Reciprocity& reciprocity) {
  Json json = Json::object();
  set(&json, "max", reciprocity.max);
  set(&json, "rms", reciprocity.rms);
  return json;
}

Json balance_json(const BalanceReport& balance) {
  Json json = Json::object();
  json["iterations"] = balance.iterations;
  set(&json, "max_change", balance.max_change);
  set(&json, "rms_change", balance.rms_change);
  set(&json, "closure_residual", balance.closure_residual);
  return json;
}

Json refinement_json(const RefinementReport& refinement) {
  Json json = Json::object();
  json["patches"] = refinement.patches;
  json["elements"] = refinement.elements;
  json["rounds"] = refinement.rounds;
  json["rows_gathered"] = refinement.rows_gathered;
  set(&json, "largest_variation", refinement.largest_variation);
  json["ended_by"] = refinement_end_name(refinement.end);
  return json;
}

Json discontinuity_json(const DiscontinuityReport& found) {
  Json json = Json::object();
  json["patches"] = found.patches;
  json["elements"] = found.elements;
  json["emitters"] = found.emitters;
  json["emitters_treated"] = found.emitters_treated;
  set(&json, "power_treated", found.power_treated);
  json["contact_lines"] = found.contact_lines;
  json["shadow_lines"] = found.shadow_lines;
  json["lines_skipped"] = found.lines_skipped;
  json["wedges"] = found.wedges;
  json["wedges_skipped"] = found.wedges_skipped;
  return json;
}

Json options_json(const ReportParts& parts) {
  const Options& options = parts.options;
  Json json = Json::object();
  const RungSetting& setting = parts.certificate.setting;
  json["rung"] = rung_name(setting.rung);
  if (setting.rung <= Rung::kArea)
    json["resolution"] = setting.resolution;
  if (setting.rung == Rung::kAdaptive)
    set(&json, "target", setting.target);
  if (options.choose_rung || options.choose_resolution)
    set(&json, "error", options.error);
  json["balance"] = options.balance;
  if (parts.max_edge != 0)
    json["max_edge"] = parts.max_edge;
  if (parts.discontinuity != nullptr) {
    Json& limits = json["discontinuity"] = Json::object();
    limits["max_emitters"] = parts.discontinuity->limits.max_emitters;
    set(&limits, "snap", parts.discontinuity->limits.snap);
    limits["max_elements"] = parts.discontinuity->limits.max_elements;
  }
  if (parts.refinement != nullptr) {
    set(&json, "variation", parts.refinement->limits.variation);
    set(&json, "min_edge", parts.refinement->limits.min_edge);
    json["max_elements"] = parts.refinement->limits.max_elements;
  }
  if (parts.certificate.solved) {
    set(&json, "tolerance", options.tolerance);
    json["max_sweeps"] = options.max_sweeps;
    json["black_irradiance"] = options.black_irradiance;
    if (options.stop_unshot > 0)
      set(&json, "stop_unshot", options.stop_unshot);
    if (options.max_shots != ~std::uint64_t{0})
      json["max_shots"] = options.max_shots;
  }
  return json;
}

Json result_json(const ReportParts& parts) {
  const Certificate& certificate = parts.certificate;
  Json json = Json::object();
  json["options"] = options_json(parts);
  json["patches"] = certificate.patches;
  if (parts.discontinuity != nullptr)
    json["discontinuity"] = discontinuity_json(*parts.discontinuity);
  if (parts.refinement != nullptr)
    json["adaptive"] = refinement_json(*parts.refinement);
  json["hemicubes"] = certificate.hemicubes;
  json["nonzeros"] = certificate.nonzeros;
  json["subpixel_patches"] = certificate.subpixel_patches;
  json["row_sum_raw"] = range_json(certificate.row_sum_raw);
  json["row_sum"] = range_json(certificate.row_sum);
  json["space"] = fraction_json(certificate.space);
  json["back_side"] = fraction_json(certificate.back_side);
  if (certificate.has_form_factor_error || certificate.has_radiosity_error) {
    Json& error = json["error"] = Json::object();
    if (certificate.has_form_factor_error)
      set(&error, "form_factor", certificate.form_factor_error);
    if (certificate.has_radiosity_error)
      set(&error, "radiosity", certificate.radiosity_error);
  }
  if (certificate.balanced)
    json["reciprocity_raw"] = reciprocity_json(certificate.reciprocity_raw);
  if (certificate.has_reciprocity)
    json["reciprocity"] = reciprocity_json(certificate.reciprocity);
  if (certificate.balanced)
    json["balance"] = balance_json(certificate.balance);
  if (certificate.solved) {
    json["solver"] = certificate.solver;
    if (certificate.has_residual) {
      set(&json, "residual", certificate.residual);
      set(&json, "estimated_error", certificate.estimated_error);
      json["sweeps"] = certificate.sweeps;
    }
    if (certificate.has_shots) {
      json["shots"] = certificate.shots;
      set(&json, "unshot", certificate.unshot);
      set(&json, "unshot_bound", certificate.unshot_bound);
    }
    json["converged"] = certificate.converged;
    json["rounding_floor"] = certificate.rounding_floor;
    Json bands = Json::array();
    for (std::uint32_t band = 0; band < parts.scene.band_count(); ++band)
      bands.push_back(std::string(parts.scene.bands[band]));
    json["bands"] = std::move(bands);
    if (!certificate.energy.empty())
      json["energy"] = energy_json(certificate);
  }
  json["repaired"] = repaired_json(parts.mesh);
  json["skipped"] = skipped_json(parts.skipped);
  json["hashes"] = hashes_json(certificate);
  return json;
}

Json run_json(const ReportParts& parts) {
  const RunReport& run = parts.run;
  Json json = Json::object();
  json["version"] = std::string(parts.version);
  if (!parts.scene_path.empty())
    json["scene"] = parts.scene_path;
  json["isa"] = run.isa;
  json["threads"] = run.threads;
  Json& seconds = json["seconds"] = Json::object();
  set(&seconds, "read", run.read_seconds);
  set(&seconds, "mesh", run.mesh_seconds);
  set(&seconds, "build", run.build_seconds);
  set(&seconds, "form_factors", run.form_factor_seconds);
  if (parts.certificate.balanced)
    set(&seconds, "balance", run.balance_seconds);
  if (parts.certificate.solved)
    set(&seconds, "solve", run.solve_seconds);
  set(&seconds, "write", run.write_seconds);
  json["peak_memory_bytes"] = run.peak_memory_bytes;
  json["rows_resumed"] = run.rows_resumed;
  return json;
}

} // namespace

std::string report_json(const ReportParts& parts) {
  Json json = Json::object();
  json["result"] = result_json(parts);
  json["run"] = run_json(parts);
  // Names come from files: bytes that are not UTF-8 are replaced, not thrown at us.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace hemicube::radiosity
