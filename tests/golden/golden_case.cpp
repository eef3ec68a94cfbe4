#include "tests/golden/golden_case.h"

#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/mesh/build_patches.h"
#include "radiosity/radiosity.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace hemicube::radiosity::test {
namespace {

const std::string kCut = "+discontinuity";

/// The next word, and removes it.
std::string take_word(std::string* line) {
  const std::size_t end = line->find(' ');
  const std::string word = line->substr(0, end);
  *line = end == std::string::npos ? "" : line->substr(end + 1);
  return word;
}

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, value);
  return text;
}

/// @return false for a name that is no rung
bool parse_rung(const std::string& text, Options* options) {
  const std::string name = text.substr(0, text.find(':'));
  if (name.size() < text.size())
    options->error = std::strtod(text.c_str() + name.size() + 1, nullptr);
  for (const Rung rung :
       {Rung::kHemicube, Rung::kAnalytic, Rung::kArea, Rung::kAdaptive, Rung::kExact})
    if (name == rung_name(rung)) {
      options->rung = rung;
      return true;
    }
  return false;
}

Status mesh_scene(const Scene& scene, bool is_cut, PatchSet* patches) {
  MeshReport report;
  HC_TRY(build_patches(scene, patches, &report));
  if (!is_cut)
    return {};
  PatchSet elements;
  DiscontinuityReport cut_report;
  std::vector<DiscontinuityLine> lines;
  HC_TRY(cut_discontinuities(scene, *patches, {}, &elements, &lines, &cut_report));
  *patches = std::move(elements);
  return {};
}

} // namespace

std::string GoldenCase::scene_file() const {
  return scene.substr(0, scene.size() - (scene.ends_with(kCut) ? kCut.size() : 0));
}

GoldenCase parse_golden_case(std::string line) {
  GoldenCase golden;
  golden.scene = take_word(&line);
  golden.rung = take_word(&line);
  golden.resolution = static_cast<std::uint32_t>(std::atoi(take_word(&line).c_str()));
  golden.items = take_word(&line);
  golden.form_factors = take_word(&line);
  golden.radiosity = take_word(&line);
  return golden;
}

std::string line_of(const GoldenCase& golden) {
  return golden.scene + " " + golden.rung + " " + std::to_string(golden.resolution) + " " +
         golden.items + " " + golden.form_factors + " " + golden.radiosity;
}

Status compute_hashes(const Scene& scene, const raster::Kernels& kernels, Executor& executor,
                      GoldenCase* golden) {
  Options options;
  if (!parse_rung(golden->rung, &options))
    return Status::error(StatusCode::kInvalidArgument, golden->rung, " is no rung");
  options.resolution = golden->resolution;
  options.hash_items = true;
  options.kernels = &kernels;
  PatchSet patches;
  HC_TRY(mesh_scene(scene, golden->scene.ends_with(kCut), &patches));
  Solution solution;
  Certificate certificate;
  HC_TRY(solve_scene(scene, patches, options, executor, nullptr, &solution, &certificate));
  golden->items = hex(certificate.item_hash);
  golden->form_factors = hex(certificate.form_factor_hash);
  golden->radiosity = hex(certificate.radiosity_hash);
  return {};
}

} // namespace hemicube::radiosity::test
