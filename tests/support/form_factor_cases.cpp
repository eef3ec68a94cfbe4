#include "tests/support/form_factor_cases.h"

#include "tests/support/lambert.h"

#include <algorithm>

namespace hemicube::test {

std::vector<nlohmann::json> form_factor_cases(bool points) {
  std::vector<nlohmann::json> selected;
  const nlohmann::json all = reference_json("formfactors.json");
  for (const nlohmann::json& one : all["cases"])
    if ((one["P1"].size() < 3) == points)
      selected.push_back(one);
  return selected;
}

CasePatches::CasePatches(const nlohmann::json& one) {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.face(grey, points_of(one["P1"]));
  builder.face(grey, points_of(one["P2"]));
  if (one.contains("blockers"))
    for (const auto& blocker : one["blockers"]) {
      const auto corners = points_of(blocker.is_object() ? blocker["vertices"] : blocker);
      builder.face(grey, corners);
      builder.face(grey, std::vector<Vec3>(corners.rbegin(), corners.rend()));
      blockers.push_back(corners);
    }
  patches = patches_of(builder.finish());
}

std::vector<Vec3> facing_polygon(const nlohmann::json& one) {
  auto polygon = points_of(one["P2"]);
  if (lambert_form_factor(point_of(one["P1"][0]), point_of(one["normal1"]), polygon) == 0)
    std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

double entry(const radiosity::RowView& row, std::uint32_t column) {
  for (std::size_t k = 0; k < row.columns.size(); ++k)
    if (row.columns[k] == column)
      return row.scale * static_cast<double>(row.values[k]);
  return 0;
}

} // namespace hemicube::test
