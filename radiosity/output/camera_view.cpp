#include "radiosity/output/camera_view.h"

#include "radiosity/elementary.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr double kFittedFieldOfView = 40;
constexpr double kMargin = 1.05;      ///< around the box in a fitted picture
constexpr double kClearlyMore = 1.05; ///< area that makes a fitted camera choose a later side

/// tan of 0 < degrees < 90 by Lambert's continued fraction, on at most 45 degrees.
double tangent(double degrees) {
  if (degrees > 45)
    return 1 / tangent(90 - degrees);
  const double x = degrees * (kPi / 180), x2 = x * x;
  double denominator = 21;
  for (int odd = 19; odd >= 1; odd -= 2)
    denominator = odd - x2 / denominator;
  return x / denominator;
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Status refuse(const char* what) {
  return Status::error(StatusCode::kInvalidArgument, "camera: ", what);
}

template <typename Number, typename... Range>
Status refuse_value(const char* what, Number value, const Range&... range) {
  return Status::error(StatusCode::kInvalidArgument, "camera: ", what, " is ", value, ", not ",
                       range...);
}

/// The raster works on grids of fewer pixels along each side.
constexpr std::uint32_t kGridLimit = 1 << 17;

Status check_numbers(const Camera& camera, std::uint32_t samples) {
  if (!is_finite(camera.position) || !is_finite(camera.target) || !is_finite(camera.up))
    return refuse("position, target and up must be finite numbers");
  const double field = camera.vertical_field_of_view;
  if (!(field > 0 && field < 180))
    return refuse_value("the vertical field of view", field, "between 0 and 180 degrees");
  const std::uint32_t most = std::min(Camera::kMaxSize, (kGridLimit - 1) / samples);
  for (const auto& [what, size] :
       {std::pair{"the width", camera.width}, std::pair{"the height", camera.height}})
    if (size < 1 || size > most)
      return refuse_value(what, size, "1 to ", most, " pixels");
  return {};
}

/// Right, down and forward of a camera that looks along `forward`; false if they are not defined.
bool make_frame(const Vec3& look, const Vec3& up, raster::View* view) {
  const double length = glm::length(look), up_length = glm::length(up);
  if (!(length > 0 && up_length > 0) || !std::isfinite(length) || !std::isfinite(up_length))
    return false;
  const Vec3 forward = look / length;
  const Vec3 right = glm::cross(forward, up / up_length);
  if (!(glm::length(right) >= Camera::kMinUpSine))
    return false;
  view->axis_z = forward;
  view->axis_x = unit(right);
  view->axis_y = glm::cross(view->axis_z, view->axis_x);
  return true;
}

struct Box {
  Vec3 low, high;
};

Box bounding_box(const PatchSet& patches) {
  Box box{patches.vertices[patches.corners[0]], patches.vertices[patches.corners[0]]};
  for (const std::uint32_t vertex : patches.corners) {
    const Vec3& v = patches.vertices[vertex];
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = min_number(box.low[axis], v[axis]);
      box.high[axis] = max_number(box.high[axis], v[axis]);
    }
  }
  return box;
}

/// Area that faces a direction, as seen from there.
double facing_area(const PatchSet& patches, const Vec3& direction) {
  double sum = 0;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    sum += patches.area[patch] * max_number(glm::dot(patches.normal[patch], direction), 0);
  return sum;
}

/// Where a fitted camera stands, seen from the scene, and what is up in its picture.
struct Stand {
  Vec3 direction, up;
};

Stand fitted_stand(const PatchSet& patches) {
  constexpr Vec3 kY{0, 1, 0}, kZ{0, 0, 1};
  constexpr struct {
    Vec3 side, up;
  } kSides[] = {{{0, 0, 1}, kY},  {{0, 0, -1}, kY}, {{1, 0, 0}, kY},
                {{-1, 0, 0}, kY}, {{0, -1, 0}, kZ}, {{0, 1, 0}, kZ}};
  Stand best{};
  double best_area = -1;
  for (const auto& [side, up] : kSides) {
    const Vec3 right = glm::cross(up, side); // of someone who looks along -side
    const Vec3 direction = unit(side + 0.2 * right + 0.25 * up);
    const double area = facing_area(patches, direction);
    if (area > kClearlyMore * best_area) {
      best = {direction, up};
      best_area = area;
    }
  }
  return best;
}

} // namespace

Status camera_view(const Camera& camera, std::uint32_t samples, CameraView* out) {
  HC_ASSERT(samples >= 1 && samples <= kMaxSamples);
  HC_TRY(check_numbers(camera, samples));
  CameraView result;
  result.view.eye = camera.position;
  result.view.above_horizon = false;
  result.view.draw_backs = false;
  const Vec3 look = camera.target - camera.position;
  if (!(glm::length(look) > 0))
    return refuse("position and target are the same point; move one of them");
  if (!make_frame(look, camera.up, &result.view))
    return refuse("up is zero or along the view; choose another up");

  raster::PixelGrid& grid = result.grid;
  grid.width = static_cast<std::int32_t>(camera.width * samples);
  grid.height = static_cast<std::int32_t>(camera.height * samples);
  const double half_height = tangent(camera.vertical_field_of_view / 2);
  const double step = 2 * half_height / grid.height;
  grid.dx = grid.dy = step;
  grid.x0 = -0.5 * step * (grid.width - 1);
  grid.y0 = -0.5 * step * (grid.height - 1);
  *out = result;
  return {};
}

Camera fit_camera(const PatchSet& patches, std::uint32_t width, std::uint32_t height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.vertical_field_of_view = kFittedFieldOfView;
  if (patches.corners.empty())
    return camera;

  const Box box = bounding_box(patches);
  const auto [direction, up] = fitted_stand(patches);
  camera.up = up;
  camera.target = 0.5 * box.low + 0.5 * box.high;
  raster::View frame;
  make_frame(-direction, camera.up, &frame);
  const double half_height = tangent(kFittedFieldOfView / 2) / kMargin;
  const double half_width = half_height * width / height;
  double distance = 0;
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner = Vec3{k & 1 ? box.high.x : box.low.x, k & 2 ? box.high.y : box.low.y,
                             k & 4 ? box.high.z : box.low.z} -
                        camera.target;
    const double x = std::fabs(glm::dot(corner, frame.axis_x));
    const double y = std::fabs(glm::dot(corner, frame.axis_y));
    const double needed = max_number(x / half_width, y / half_height);
    distance = max_number(distance, needed - glm::dot(corner, frame.axis_z));
  }
  camera.position = camera.target + distance * direction;
  return camera;
}

} // namespace hemicube::radiosity
