#include "tests/support/scene_checks.h"

#include <cmath>
#include <set>
#include <string_view>
#include <vector>

namespace hemicube::test {
namespace {

/// The first thing that is wrong.
class Problem {
public:
  /// @return `holds`
  template <typename... Places>
  bool expect(bool holds, std::string_view what, const Places&... places) {
    if (!holds && text_.empty()) {
      text_ = what;
      ((text_ += ' ', text_ += std::to_string(places)), ...);
    }
    return holds;
  }
  std::string text() const { return text_; }

private:
  std::string text_;
};

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void expect_unique(const radiosity::NameTable& table, std::string_view what, Problem* problem) {
  std::set<std::string_view> names;
  for (std::uint32_t i = 0; i < table.size(); ++i)
    names.insert(table[i]);
  problem->expect(names.size() == table.size(), what);
}

void check_light(const radiosity::Scene& scene, Problem* problem) {
  const std::size_t bands = scene.band_count(), materials = scene.materials.size();
  problem->expect(bands >= 1, "no bands");
  problem->expect(scene.reflectance.size() == materials * bands, "reflectances");
  problem->expect(scene.exitance.size() == materials * bands, "exitances");
  problem->expect(scene.two_sided.size() == materials, "two-sided flags");
  problem->expect(scene.space_exitance.size() == bands, "space exitances");
  for (const double rho : scene.reflectance)
    problem->expect(rho >= 0 && rho <= 1, "reflectance", rho);
  for (const double e : scene.exitance)
    problem->expect(e >= 0 && std::isfinite(e), "exitance", e);
  for (const double e : scene.space_exitance)
    problem->expect(e >= 0 && std::isfinite(e), "space exitance", e);
  for (const std::uint8_t two_sided : scene.two_sided)
    problem->expect(two_sided <= 1, "two-sided", two_sided);
}

void check_faces(const radiosity::Scene& scene, Problem* problem) {
  const std::size_t faces = scene.face_count();
  if (!problem->expect(faces >= 1, "no faces") ||
      !problem->expect(scene.corner_offsets[0] == 0, "first corner offset") ||
      !problem->expect(scene.corner_offsets[faces] == scene.corners.size(), "last corner offset") ||
      !problem->expect(scene.face_material.size() == faces, "materials of faces") ||
      !problem->expect(scene.face_group.size() == faces, "groups of faces"))
    return;
  for (std::size_t f = 0; f < faces; ++f)
    problem->expect(scene.corner_offsets[f + 1] >= scene.corner_offsets[f] + 3, "corners of face",
                    f);
  for (const std::uint32_t corner : scene.corners)
    problem->expect(corner < scene.vertices.size(), "corner", corner);
  std::set<std::uint32_t> used;
  for (const std::uint32_t material : scene.face_material)
    used.insert(material);
  problem->expect(used.size() == scene.materials.size(), "a material that no face uses");
  problem->expect(*used.rbegin() < scene.materials.size(), "material", *used.rbegin());
  for (const std::uint32_t group : scene.face_group)
    problem->expect(group < scene.groups.size(), "group", group);
  problem->expect(scene.face_max_edge.empty() || scene.face_max_edge.size() == faces,
                  "longest edges of faces");
  for (const double edge : scene.face_max_edge)
    problem->expect(edge >= 0 && std::isfinite(edge), "longest edge", edge);
}

} // namespace

std::string scene_problem(const radiosity::Scene& scene) {
  Problem problem;
  expect_unique(scene.bands, "a band twice", &problem);
  expect_unique(scene.materials, "a material twice", &problem);
  expect_unique(scene.groups, "a group twice", &problem);
  check_light(scene, &problem);
  for (const Vec3& v : scene.vertices)
    problem.expect(is_finite(v), "vertex", v.x, v.y, v.z);
  check_faces(scene, &problem);
  if (scene.has_camera) {
    const radiosity::Camera& camera = scene.camera;
    problem.expect(is_finite(camera.position) && is_finite(camera.target) && is_finite(camera.up),
                   "camera");
    problem.expect(camera.vertical_field_of_view > 0 && camera.vertical_field_of_view < 180,
                   "field of view", camera.vertical_field_of_view);
  }
  return problem.text();
}

std::string mesh_problem(const radiosity::Scene& scene, const radiosity::PatchSet& patches) {
  Problem problem;
  const std::size_t count = patches.patch_count();
  if (!problem.expect(count >= 1, "no patches") ||
      !problem.expect(patches.corner_offsets.size() == count + 1, "corner offsets") ||
      !problem.expect(patches.corner_offsets[count] == patches.corners.size(), "last offset") ||
      !problem.expect(patches.face.size() == count && patches.parent.size() == count &&
                          patches.material.size() == count && patches.group.size() == count &&
                          patches.normal.size() == count && patches.centre.size() == count,
                      "sizes of arrays") ||
      !problem.expect(patches.front_count >= 1 && patches.front_count <= count, "fronts"))
    return problem.text();
  for (const std::uint32_t corner : patches.corners)
    problem.expect(corner < patches.vertices.size(), "corner", corner);
  for (std::uint32_t i = 0; i < count; ++i) {
    problem.expect(patches.corner_offsets[i + 1] >= patches.corner_offsets[i] + 3, "patch", i);
    problem.expect(patches.area[i] > 0 && std::isfinite(patches.area[i]), "area", i,
                   patches.area[i]);
    problem.expect(is_finite(patches.centre[i]), "centre", i);
    problem.expect(std::fabs(glm::length(patches.normal[i]) - 1) <= 1e-14, "normal", i);
    if (problem.expect(patches.face[i] < scene.face_count(), "face", i))
      problem.expect(patches.material[i] == scene.face_material[patches.face[i]] &&
                         patches.group[i] == scene.face_group[patches.face[i]],
                     "material or group", i);
    problem.expect(i == 0 || i == patches.front_count || patches.face[i - 1] <= patches.face[i],
                   "order of faces", i);
  }
  return problem.text();
}

} // namespace hemicube::test
