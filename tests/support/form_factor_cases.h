#pragma once

#include "radiosity/form_factor/matrix.h"
#include "tests/support/reference.h"
#include "tests/support/scenes_shared.h"

/// The pairs of tests/reference/formfactors.json as scenes.
namespace hemicube::test {

/// The cases with a point (or those without).
std::vector<nlohmann::json> form_factor_cases(bool points);

/// A case as patches: P1, P2, then each blocker once per side.
struct CasePatches {
  PatchSet patches;
  std::vector<std::vector<Vec3>> blockers;

  explicit CasePatches(const nlohmann::json& one);
};

/// P2 of a case with a point, wound so that the point sees its front. One case of the data
/// (pt_general_tri) shows the point the back of P2; its value is that of the triangle turned over.
std::vector<Vec3> facing_polygon(const nlohmann::json& one);

/// The form factor of a row to a patch.
double entry(const radiosity::RowView& row, std::uint32_t column);

} // namespace hemicube::test
