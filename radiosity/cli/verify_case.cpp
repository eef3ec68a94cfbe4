#include "radiosity/cli/verify_case.h"

namespace hemicube::radiosity::cli {

Polygon rectangle(double width, double depth) {
  return {{0, 0, 0}, {width, 0, 0}, {width, depth, 0}, {0, depth, 0}};
}

Polygon ceiling(double width, double depth, double height) {
  return {{0, depth, height}, {width, depth, height}, {width, 0, height}, {0, 0, height}};
}

Polygon turned_round(const Polygon& polygon) {
  return {polygon.rbegin(), polygon.rend()};
}

VerifyCase pair(const char* name, double exact, const Bounds& bounds, const Polygon& from,
                const Polygon& to, const std::vector<Polygon>& blockers) {
  VerifyCase made{name, VerifyKind::kPatchToPatch, exact, bounds, {}};
  const std::uint32_t grey = made.scene.material(0.5, 1);
  made.scene.face(grey, from);
  made.scene.face(grey, to);
  for (const Polygon& blocker : blockers) {
    made.scene.face(grey, blocker);
    made.scene.face(grey, turned_round(blocker));
  }
  return made;
}

VerifyCase point(const char* name, double exact, const Bounds& bounds, const Vec3& position,
                 const Polygon& to) {
  VerifyCase made{name, VerifyKind::kPointToPatch, exact, bounds, {}, {position, {0, 0, 1}}};
  made.scene.face(made.scene.material(0.5, 1), to);
  return made;
}

} // namespace hemicube::radiosity::cli
