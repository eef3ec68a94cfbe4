#include "radiosity/web/page_picture.h"

#include "radiosity/output/orbit.h"
#include "radiosity/output/picture.h"

namespace hemicube::radiosity::web {

Camera orbited(const Camera& camera, const Orbit& orbit) {
  Camera tilted = camera;
  if (orbit.tilt != 0) {
    // A tilt is a turn about the axis to the right.
    tilted.up = glm::cross(camera.up, camera.target - camera.position);
    tilted = orbit_camera(tilted, orbit.tilt, Orbit::kFullTurn);
    tilted.up = camera.up;
  }
  Camera moved = orbit_camera(tilted, orbit.turn, Orbit::kFullTurn);
  if (orbit.distance != 1)
    moved.position = moved.target + orbit.distance * (moved.position - moved.target);
  return moved;
}

Status draw_rgba(const Scene& scene, const PatchSet& patches, const Solution& solution,
                 const Camera& camera, std::uint32_t samples, const Tone& tone,
                 Buffer<std::uint8_t>* rgba) {
  SerialExecutor executor;
  PictureValues values;
  HC_TRY(displayed_values(patches, solution, &values));
  Picture picture;
  HC_TRY(draw_picture(scene, patches, values, camera, {raster::best_kernels(), samples}, executor,
                      &picture));
  Buffer<std::uint8_t> rgb;
  HC_TRY(tone_map(picture.rgb.span(), tone, &rgb));
  HC_TRY(rgba->resize(rgb.size() / 3 * 4));
  for (std::size_t pixel = 0; pixel < rgb.size() / 3; ++pixel) {
    for (std::size_t channel = 0; channel < 3; ++channel)
      (*rgba)[pixel * 4 + channel] = rgb[pixel * 3 + channel];
    (*rgba)[pixel * 4 + 3] = 255;
  }
  return {};
}

} // namespace hemicube::radiosity::web
