#pragma once

#include "radiosity/output/picture.h"
#include "tests/unit/output_support.h"

namespace hemicube::radiosity::test {

inline PictureValues values_of(const PatchSet& patches, const Solution& solution,
                               Quantity quantity = Quantity::kRadiance, bool flat = false) {
  PictureValues values;
  require(picture_values(patches, solution, quantity, flat, &values));
  return values;
}

inline Picture draw(const Scene& scene, const PatchSet& patches, const PictureValues& values,
                    const Camera& camera, std::uint32_t samples = PictureSetting::kSamples) {
  SerialExecutor serial;
  Picture picture;
  require(draw_picture(scene, patches, values, camera, {raster::best_kernels(), samples}, serial,
                       &picture));
  return picture;
}

inline Picture draw(const Scene& scene, const PatchSet& patches, const Solution& solution,
                    const Camera& camera) {
  return draw(scene, patches, values_of(patches, solution), camera);
}

inline float red(const Picture& picture, std::size_t x, std::size_t y) {
  return picture.rgb[3 * (y * picture.width + x)];
}

/// A floor of 4 x 1 squares with irradiance 1, 2, 3, 4 seen from above, one pixel a square.
struct FloorPicture {
  FloorPicture() {
    SceneBuilder builder(1);
    builder.grid(builder.material("grey", 0.5, 0.25), {-2, -0.5, -1}, {2, -0.5, -1}, {2, 0.5, -1},
                 {-2, 0.5, -1}, 4, 1);
    scene = builder.finish();
    patches = patches_of(scene);
    solution = solution_with(scene, patches, [&](std::uint32_t patch, std::uint32_t) {
      return patches.centre[patch].x + 2.5;
    });
    camera.vertical_field_of_view = 53.13010235415598;
    camera.width = 4;
    camera.height = 1;
  }
  Picture of(Quantity quantity, bool flat) const {
    return draw(scene, patches, values_of(patches, solution, quantity, flat), camera);
  }

  Scene scene;
  PatchSet patches;
  Solution solution;
  Camera camera;
};

} // namespace hemicube::radiosity::test
