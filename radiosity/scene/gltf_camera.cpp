#include "radiosity/scene/gltf_camera.h"

#include "radiosity/scene/camera_problem.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Angle and shape of the picture.
Status read_lens(const GltfFile& file, const JsonValue& lens, const std::string& what,
                 Camera* camera) {
  const JsonFields& fields = file.fields();
  HC_TRY(fields.kind(lens, what, JsonValue::Kind::kObject));
  const JsonValue* angle = nullptr;
  double radians = 0;
  HC_TRY(file.required(lens, what, "yfov", &angle));
  HC_TRY(fields.positive_number(*angle, what + ".yfov", &radians));
  camera->vertical_field_of_view = radians * (180 / kPi);
  if (camera->vertical_field_of_view >= 180)
    return fields.error(*angle, what, ".yfov: ", radians, " must be less than pi");
  double ratio = 1;
  if (const JsonValue* value = lens.find("aspectRatio"))
    HC_TRY(fields.positive_number(*value, what + ".aspectRatio", &ratio));
  const double width = std::clamp(ratio * camera->height, 1.0, double{Camera::kMaxSize});
  camera->width = static_cast<std::uint32_t>(width + 0.5);
  return {};
}

} // namespace

Status read_gltf_camera(const GltfFile& file, const GltfNode& node, const JsonValue& reference,
                        bool* is_perspective, Camera* camera) {
  const JsonFields& fields = file.fields();
  GltfFile::Item item;
  HC_TRY(file.follow(reference, node.what + ".camera", "cameras", &item));
  const JsonValue* lens = item.value->find("perspective");
  *is_perspective = lens != nullptr;
  if (lens == nullptr)
    return {};
  *camera = {};
  HC_TRY(read_lens(file, *lens, item.what + ".perspective", camera));

  // A camera looks along -z of its node, y is up.
  const auto& m = node.placement.rows;
  const Vec3 back(m[2], m[6], m[10]), up(m[1], m[5], m[9]);
  const double back_length = largest_component(back), up_length = largest_component(up);
  camera->position = {m[3], m[7], m[11]};
  if (back_length != 0)
    camera->target = camera->position - unit(back / back_length);
  else
    camera->target = camera->position;
  camera->up = up_length == 0 ? up : unit(up / up_length);
  const std::string_view problem = camera_problem(*camera);
  return problem.empty() ? Status() : fields.error(reference, node.what, ".camera: ", problem);
}

} // namespace hemicube::radiosity
