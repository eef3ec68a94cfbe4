// Rows of form factors of a few polygons, anyhow: on every rung they close, and say what the rung
// above says to its error.

#include "radiosity/form_factor/area_to_area.h"
#include "tests/fuzz/polygon_decoder.h"
#include "tests/fuzz/polygon_pair.h"
#include "tests/fuzz/target.h"
#include "tests/support/ladder_levels.h"
#include "tests/support/solved.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hemicube::test {
namespace {

/// Rows, as radiosity/README.md promises them of every rung.
std::string closure_problem(const FormFactors& factors) {
  std::ostringstream text;
  text.precision(17);
  for (std::uint64_t i = 0; i < factors.matrix.row_count(); ++i) {
    const radiosity::RowView row = factors.matrix.row(i);
    double sum = row.space + row.back_side;
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      const double value = row.scale * static_cast<double>(row.values[k]);
      sum += value;
      if (row.columns[k] == i || !(value > 0 && value <= 1))
        text << "row " << i << " holds " << value << " of " << row.columns[k];
    }
    if (!(std::fabs(sum - 1) <= 1e-12) || !(row.space >= 0) || !(row.back_side >= 0))
      text << "row " << i << " sums to " << sum << ", space " << row.space << ", backs "
           << row.back_side;
    if (text.tellp() > 0)
      return text.str();
  }
  return "";
}

double exchange_of(const PatchSet& patches, const FormFactors& factors, std::uint32_t i,
                   std::uint32_t j) {
  return patches.area[i] * factors.dense_row(i)[j];
}

/// Two patches that nothing is between: A_i F_ij = A_j F_ji to the rounding of float entries and of
/// rows that sum to 1, and what rung `area` finds is good to its 1e-5.
std::string pair_problem(const PatchSet& patches, const FormFactors& area) {
  FormFactors exact;
  compute_all(patches, kExactRung.options(16), 1, &exact);
  const double there = exchange_of(patches, area, 0, 1), back = exchange_of(patches, area, 1, 0);
  const double expected = exchange_of(patches, exact, 0, 1);
  const double rounding = rounding_of(PairSide(patches, 0), PairSide(patches, 1));
  std::ostringstream text;
  text.precision(17);
  if (std::fabs(there - back) >
      0x1p-22 * std::max(there, back) + 0x1p-52 * (patches.area[0] + patches.area[1]))
    text << "there " << there << ", back " << back;
  else if (std::fabs(there - expected) > 1.1e-5 * expected + rounding + 0x1p-52 * patches.area[0])
    text << "exchange " << there << ", on rung exact " << expected << ", rounding " << rounding;
  return text.str();
}

/// Strips of an aspect of 10^8 have no plane to speak of (raster/README.md, Limits): their own
/// corners may lie as far off it as they are wide, and hide what is behind.
bool has_strip(const PatchSet& patches) {
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
    const PairSide side(patches, i);
    if (side.longest * side.longest > 1e8 * side.area)
      return true;
  }
  return false;
}

/// Patches with others between them: visible shares are good to the target.
std::string share_problem(const PatchSet& patches, const FormFactors& loose) {
  FormFactors better;
  compute_all(patches, kAdaptiveRung.options(16), 1, &better);
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    for (std::uint32_t j = 0; j < patches.patch_count(); ++j) {
      if (i == j)
        continue;
      const PairSide p(patches, i), q(patches, j);
      const radiosity::AreaIntegral whole =
          radiosity::exchange_area(radiosity::ConvexPolygon(p.corners), p.normal,
                                   radiosity::ConvexPolygon(q.corners), q.normal, 1e-5);
      const double found = exchange_of(patches, loose, i, j);
      const double expected = exchange_of(patches, better, i, j);
      const double allowed = (kLooseRung.error + kAdaptiveRung.error) * whole.value;
      if (std::fabs(found - expected) >
          allowed + whole.error + rounding_of(p, q) + 0x1p-52 * patches.area[i]) {
        std::ostringstream text;
        text.precision(17);
        text << "from " << i << " to " << j << " " << found << " of " << whole.value
             << ", at a finer target " << expected;
        return text.str();
      }
    }
  return "";
}

} // namespace

Verdict judge_rungs(Bytes bytes) {
  ByteReader reader(bytes);
  const std::uint32_t count = 2 + reader.below(5);
  PolygonList polygons = {decode_polygon(&reader)};
  while (polygons.size() < count)
    polygons.push_back(reader.below(2) == 1
                           ? decode_neighbour(&reader, polygons[reader.byte() % polygons.size()])
                           : decode_polygon(&reader));
  const auto patches = patches_if_kept(polygons);
  if (!patches)
    return {"", false};
  for (const LadderLevel& level : {kHemicubeRung, kAnalyticRung, kAreaRung, kLooseRung}) {
    FormFactors factors;
    compute_all(*patches, level.options(16), 1, &factors);
    std::string problem = closure_problem(factors);
    if (problem.empty() && count == 2 && level.rung == radiosity::Rung::kArea)
      problem = pair_problem(*patches, factors);
    if (problem.empty() && count == 3 && level.rung == radiosity::Rung::kAdaptive &&
        !has_strip(*patches))
      problem = share_problem(*patches, factors);
    if (!problem.empty())
      return {std::string(level.name) + ": " + problem};
  }
  return {};
}

} // namespace hemicube::test
