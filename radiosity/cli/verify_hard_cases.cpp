#include "radiosity/cli/verify_cases.h"

namespace hemicube::radiosity::cli {
namespace {

/// Of areas that nothing is between: from the centres nothing is promised.
Bounds of_areas(double relative) {
  return {kNoPromise, kNoPromise, relative, relative, relative};
}

/// From points: pixels, then Lambert's formula.
Bounds of_points(double relative) {
  return {kNoPromise, relative, relative, relative, relative};
}

Polygon placed(Polygon polygon, double scale, const Vec3& offset) {
  for (Vec3& corner : polygon)
    corner = corner * scale + offset;
  return polygon;
}

const double kPlates = 0.19982489569838738304, kEdge = 0.20004377607540315424;

// The values without another source are F12_str of tests/reference/formfactors.json, found with 40
// digits; named after the cases there.
void add_form_factors(std::vector<VerifyCase>* cases) {
  const auto add = [cases](VerifyCase made) { cases->push_back(std::move(made)); };
  const Polygon square = rectangle(1, 1), above = ceiling(1, 1, 1);
  const Polygon wall = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};

  // perp_edge_h0.01_w1_l1, tri_shared_edge_60, perp_off_1.
  add(pair("edge, a low wall", 0.0048958492685066830398, of_areas(1e-4), square,
           {{0, 0, 0}, {0, 1, 0}, {0, 1, 0.01}, {0, 0, 0.01}}));
  add(pair("edge of two triangles", 0.37996530484100817059, of_areas(1e-4),
           {{0, 0, 0}, {1, 0, 0}, {0.5, 0.9, 0}}, {{0, 0, 0}, {0.5, 0.4, 0.7}, {1, 0, 0}}));
  add(pair("corner in common", 0.040592230101558542583, of_areas(1e-4), square,
           {{0, 1, 0}, {0, 2, 0}, {0, 2, 1}, {0, 1, 1}}));
  // horizon_wall_half, horizon_tilted, horizon_triangle: of both, what is in front of the other.
  add(pair("horizon, a wall", 0.076136640422677840791, of_areas(1e-3), square,
           {{-0.5, 0, -1}, {-0.5, 1, -1}, {-0.5, 1, 1}, {-0.5, 0, 1}}));
  add(pair("horizon, tilted", 0.11098324906890496511, of_areas(1e-3),
           {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
           {{0.9, -0.5, 1.2}, {0.9, 0.7, 1.2}, {1.5, 0.7, -1}, {1.5, -0.5, -1}}));
  add(pair("horizon, a triangle", 0.083881126991653459347, of_areas(1e-3),
           {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0.2, -0.4, 1.2}, {2, -0.5, 1}, {1, -0.3, -1}}));
  // Howell B-3, for each half of the wall: (atan(b/c) - c/d atan(b/d)) / (2 pi), d^2 = 1 + c^2.
  add(point("wall before the feet", 0.49921579759625996987, of_points(1e-12), {0.5, 0, 0},
            {{0, 0.001, 0}, {1, 0.001, 0}, {1, 0.001, 1}, {0, 0.001, 1}}));

  // par_1x1_gap0.1, occ_near_receiver.
  add(pair("plates gap 0.1", 0.82699452239725657792, of_areas(1e-4), square, ceiling(1, 1, 0.1)));
  add(pair("blocker on the floor", 0.16965986041257311023,
           {kNoPromise, kNoPromise, kNoPromise, 1e-3, 1e-6}, square, above,
           {{{0.3, 0.3, 0.05}, {0.6, 0.3, 0.05}, {0.6, 0.7, 0.05}, {0.3, 0.7, 0.05}}}));

  // tiny_far_1e-8, tiny_far_rev, tiny_light_in_room, pt_far.
  const double low = 0.5, high = 0.50177;
  add(pair("tiny and far", 9.939204828515386234e-9, of_areas(1e-6), square,
           {{low, high, 10}, {high, high, 10}, {high, low, 10}, {low, low, 10}}));
  add(pair("far from tiny", 0.0031725254009114195263, of_areas(1e-6),
           {{low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}}, ceiling(1, 1, 10)));
  add(pair("tiny light in a room", 3.081590165163309638e-6, of_areas(1e-6), rectangle(4, 3),
           {{1.8, 1.51, 2.5}, {1.81, 1.51, 2.5}, {1.81, 1.5, 2.5}, {1.8, 1.5, 2.5}}));
  add(point("point, tiny and far", 5.0848170467757934955e-8, of_points(1e-6), {0, 0, 0},
            {{100, 0.1, 50}, {100.1, 0.1, 50}, {100.1, 0, 50}, {100, 0, 50}}));
  // sliver_par, sliver_wall, sliver_tri, coplanar_step_1e-3.
  add(pair("slivers", 0.000024999999924237088494, of_areas(1e-3), rectangle(1, 1e-4),
           ceiling(1, 1e-4, 1)));
  add(pair("sliver of a wall", 0.00001672209575846181496, of_areas(1e-3), square,
           {{0, 0, 0.5}, {0, 1, 0.5}, {0, 1, 0.5001}, {0, 0, 0.5001}}));
  add(pair("sliver of a triangle", 8.2800355394302951483e-6, of_areas(1e-3), square,
           {{0, 0, 1}, {1, 1e-4, 1}, {1, 0, 1}}));
  add(pair("grazing step", 0.00049739816185990700528, of_areas(1e-2), square,
           {{1, 1, 0.001}, {2, 1, 0.001}, {2, 0, 0.001}, {1, 0, 0.001}}));

  // zero_coplanar, zero_backfacing.
  add(pair("in one plane", 0, kHidden, square, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}));
  add(pair("averted", 0, kHidden, square, turned_round(above)));

  // Of coincident fronts the lower is seen, of both sides of a sheet the facing one: par_1x1_gap1,
  // perp_edge_h1_w1_l1.
  VerifyCase copied = pair("one plate twice", kPlates, of_areas(1e-12), square, above);
  copied.scene.face(0, above);
  cases->push_back(std::move(copied));
  VerifyCase sheet = pair("sheet on an edge", kEdge, of_areas(1e-4), square, wall);
  sheet.scene.face(0, turned_round(wall));
  sheet.scene.face(0, placed(square, 1, {-1, 0, 0}));
  cases->push_back(std::move(sheet));
  // par_1x1_gap1 with coordinates that leave a billionth of a metre, and at the size of dust.
  const Vec3 away(1e6 + 0.1, 1e6 + 0.1, 1e6 + 0.1);
  add(pair("plates 1e6 m away", kPlates, of_areas(1e-6), placed(square, 1, away),
           placed(above, 1, away)));
  add(pair("plates of 1e-6 m", kPlates, of_areas(1e-9), placed(square, 1e-6, {0, 0, 0}),
           placed(above, 1e-6, {0, 0, 0})));
}

} // namespace

std::vector<VerifyCase> verify_hard_cases() {
  std::vector<VerifyCase> cases;
  add_form_factors(&cases);
  // B = E / (1 - rho): what rows are above or below 1 counts a million times.
  const double rho = 0.999999, exitance = 1e-6;
  VerifyCase white{"furnace, nearly white",
                   VerifyKind::kRadiosity,
                   exitance / (1 - rho),
                   {1e-4, 1e-4, 1e-4, 1e-4, 1e-4},
                   {}};
  white.scene.box(white.scene.material(rho, exitance), {0, 0, 0}, {1, 1, 1}, 2, true);
  cases.push_back(std::move(white));
  return cases;
}

} // namespace hemicube::radiosity::cli
