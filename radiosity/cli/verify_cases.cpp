#include "radiosity/cli/verify_cases.h"

#include <algorithm>

namespace hemicube::radiosity::cli {
namespace {

// What the rungs promise: hemicube, analytic, area, adaptive, exact. Figures in brackets are the
// largest that were measured. A bound that is more than ten times as large is the rung's own
// target.
constexpr double kNone = kNoPromise;

// Form factors from points: pixels (8.5e-5), then Lambert's formula, up to rounding (4e-16).
const Bounds kPoints = {5e-4, 1e-14, 1e-14, 1e-14, 1e-14};
// Pairs that nothing is between. One point does not stand for an area near by, so the first two
// rungs promise nothing there. Areas by closed forms up to what cancels in them far away (7.9e-11);
// by quadrature (5.6e-11; for nearly flat wedges, relative to small form factors, 3.7e-8), on rung
// exact to 1e-10 (7.6e-12).
const Bounds kClosedForm = {kNone, kNone, 5e-10, 5e-10, 5e-10};
const Bounds kFarAway = {kNone, 2e-6, 5e-10, 5e-10,
                         5e-10}; // proximity, (size / distance)^2: 3.3e-7
const Bounds kQuadrature = {kNone, kNone, 5e-10, 5e-10, 1e-10};
const Bounds kNearlyFlat = {kNone, kNone, 2e-7, 2e-7, 1e-10};
// Partly hidden pairs. The target of adaptive is an RMS over all pairs, relative to that of F: of a
// single pair ten times as much is allowed (2.5e-3). Exact promises 1e-6 (8.7e-7).
const Bounds kOccluded = {kNone, kNone, kNone, 10 * kVerifyError, 1e-6};
// The sums of rows are 1 on every rung, whatever the rows: rounding (1.3e-15).
const Bounds kFurnace = {1e-14, 1e-14, 1e-14, 1e-14, 1e-14};
// Reciprocal form factors, entries rounded to float (6e-8), which averages out (9e-12).
const Bounds kReciprocal = {kNone, kNone, 5e-11, 5e-11, 5e-11};
// Errors of single pairs average out in the sum: the targets themselves.
const Bounds kShared = {kNone, kNone, kNone, kVerifyError, 1e-6};

/// Two unit squares that meet in an edge, by the cosine and sine of the angle between them.
VerifyCase wedge(const char* name, double exact, const Bounds& bounds, double cosine, double sine) {
  return pair(name, exact, bounds, rectangle(1, 1),
              {{0, 0, 0}, {0, 1, 0}, {cosine, 1, sine}, {cosine, 0, sine}});
}

// The values without another source are F12_str of tests/reference/formfactors.json, found with 40
// digits; named after the cases there.
void add_form_factors(std::vector<VerifyCase>* cases) {
  const Polygon square = rectangle(1, 1);
  const auto add = [cases](VerifyCase made) { cases->push_back(std::move(made)); };

  // Howell C-11: par_1x1_gap1, par_1x1_gap0.001, par_1x1_gap1000.
  add(pair("plates gap 1", 0.19982489569838738304, kClosedForm, square, ceiling(1, 1, 1)));
  add(pair("plates gap 0.001", 0.998005631907579727, kClosedForm, square, ceiling(1, 1, 0.001)));
  add(pair("plates gap 1000", 3.1830967397738025777e-7, kFarAway, square, ceiling(1, 1, 1000)));
  // Howell C-14: perp_edge_h1_w1_l1.
  add(pair("edge 90 degrees", 0.20004377607540315424, kClosedForm, square,
           {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}));
  // Howell C-16, by a contour integral: tilt_{1,5,175,179}_1x1x1.
  add(wedge("wedge 1 degree", 0.9829971785746488096, kQuadrature, 0.9998476951563913,
            0.01745240643728351));
  add(wedge("wedge 5 degrees", 0.92026190811122237612, kQuadrature, 0.9961946980917455,
            0.08715574274765817));
  add(wedge("wedge 175 degrees", 0.00059029091743304567294, kNearlyFlat, -0.9961946980917455,
            0.0871557427476582));
  add(wedge("wedge 179 degrees", 0.000023608783114983162156, kNearlyFlat, -0.9998476951563913,
            0.01745240643728344));

  // Lambert's polygon formula: pt_corner_par (also Howell B-4), pt_near_1e-3, pt_hexagon.
  add(point("point under a corner", 0.13853160599489299678, kPoints, {0, 0, 0}, ceiling(1, 1, 1)));
  add(point("point 0.001 under", 0.99999672677154818434, kPoints, {0.5, 0.5, 0},
            ceiling(1, 1, 0.001)));
  const double h = 0.8660254037844386;
  add(point(
      "point under a hexagon", 0.26207092405055374738, kPoints, {0.1, -0.2, 0},
      {{1, 0, 1.5}, {0.5, -h, 1.5}, {-0.5, -h, 1.5}, {-1, 0, 1.5}, {-0.5, h, 1.5}, {0.5, h, 1.5}}));

  // Visibility cut at all its events, Gauss-Legendre per cell, good to 1e-11 relative:
  // occ_centre_square, occ_offcentre, occ_thin_wire; occ_total.
  const Polygon above = ceiling(1, 1, 1);
  const auto sheet = [](double x0, double x1, double y0, double y1, double z) {
    return Polygon{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  };
  add(pair("blocker at the centre", 0.099506294598984412758, kOccluded, square, above,
           {sheet(0.25, 0.75, 0.25, 0.75, 0.5)}));
  add(pair("blocker off the centre", 0.12656948353690827824, kOccluded, rectangle(2, 1),
           ceiling(2, 1, 1.5), {sheet(0.1, 0.9, 0.3, 0.8, 0.4)}));
  add(pair("thin wire", 0.19850124819487013905, kOccluded, square, above,
           {sheet(0.498, 0.502, -1, 2, 0.5)}));
  add(pair("all hidden", 0, kHidden, square, above, {sheet(-1, 2, -1, 2, 0.5)}));
}

// A closed room of one material has B = E / (1 - rho), whatever its shape: only the sums of rows
// matter, and they must be 1.
void add_furnaces(std::vector<VerifyCase>* cases) {
  const double rho = 0.75, exitance = 0.5;
  VerifyCase cube{"furnace cube", VerifyKind::kRadiosity, exitance / (1 - rho), kFurnace, {}};
  cube.scene.box(cube.scene.material(rho, exitance), {0, 0, 0}, {1, 1, 1}, 3, true);
  cases->push_back(std::move(cube));

  VerifyCase boxes{
      "furnace with a box", VerifyKind::kRadiosity, exitance / (1 - rho), kFurnace, {}};
  const std::uint32_t wall = boxes.scene.material(rho, exitance);
  boxes.scene.box(wall, {0, 0, 0}, {1, 1, 1}, 1, true);
  boxes.scene.box(wall, {0.5, 0.5, 0.5}, {0.625, 0.625, 0.625}, 1, false);
  cases->push_back(std::move(boxes));

  VerifyCase sphere{"furnace sphere", VerifyKind::kRadiosity, exitance / (1 - rho), kFurnace, {}};
  const std::uint32_t inside = sphere.scene.material(rho, exitance);
  sphere.scene.sphere([inside](const Vec3&) { return inside; }, 2);
  cases->push_back(std::move(sphere));
}

/// The inside of a tetrahedron around the origin; turned inside out by a negative scale.
void add_tetrahedron(std::uint32_t material, double scale, VerifyScene* scene) {
  const std::array<Vec3, 4> v = {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}};
  constexpr std::size_t kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (const auto& f : kFaces)
    scene->face(material, {scale * v[f[0]], scale * v[f[1]], scale * v[f[2]]});
}

// That F_ij = A_j / A holds inside a smooth sphere; it is no truth about a polyhedron (it is 1 %
// off at level 2). What is exact in any closed room: what is emitted is absorbed, as form factors
// are reciprocal. And what leaves a convex body all meets the walls around it, so that by
// reciprocity sum A_i F_ij over the walls i and the body j is the area of the body.
void add_reciprocal(std::vector<VerifyCase>* cases) {
  VerifyCase sphere{"power in a sphere", VerifyKind::kImbalance, 0, kReciprocal, {}};
  const std::uint32_t lit = sphere.scene.material(0.25, 1), dark = sphere.scene.material(0.75, 0);
  sphere.scene.sphere([=](const Vec3& centre) { return centre.z > 0.5 ? lit : dark; }, 2);
  cases->push_back(std::move(sphere));

  VerifyCase body{"body in a room", VerifyKind::kSharedPower, 1, kShared, {}};
  const std::uint32_t room = body.scene.material(0.5, 0), inner = body.scene.material(0.5, 1);
  add_tetrahedron(room, 1, &body.scene);
  add_tetrahedron(inner, -0.125, &body.scene);
  cases->push_back(std::move(body));
}

} // namespace

std::vector<VerifyCase> verify_cases() {
  std::vector<VerifyCase> cases;
  add_form_factors(&cases);
  add_furnaces(&cases);
  add_reciprocal(&cases);
  return cases;
}

} // namespace hemicube::radiosity::cli
