#include "radiosity/elementary.h"
#include "radiosity/output/camera_view.h"
#include "radiosity/parallel/thread_pool.h"
#include "tests/unit/picture_support.h"

#include <cmath>

namespace hemicube::radiosity::test {
namespace {

/// The direction of a pixel centre of a view.
Vec3 direction(const CameraView& view, double x, double y) {
  return (view.grid.x0 + x * view.grid.dx) * view.view.axis_x +
         (view.grid.y0 + y * view.grid.dy) * view.view.axis_y + view.view.axis_z;
}

TEST(CameraView, IsNeitherMirroredNorUpsideDown) {
  Camera camera; // at the origin, looking along -z, up +y
  camera.width = 40;
  camera.height = 20;
  camera.vertical_field_of_view = 90;
  CameraView view;
  require(camera_view(camera, 1, &view));
  EXPECT_EQ(glm::cross(view.view.axis_x, view.view.axis_y), view.view.axis_z) << "right-handed";
  const Vec3 upper_left = direction(view, -0.5, -0.5); // the picture's very corner
  EXPECT_NEAR(upper_left.x, -2, 1e-12);
  EXPECT_NEAR(upper_left.y, 1, 1e-12);
  EXPECT_NEAR(upper_left.z, -1, 1e-12);
  const Vec3 lower_right = direction(view, 39.5, 19.5);
  EXPECT_NEAR(lower_right.x, 2, 1e-12);
  EXPECT_NEAR(lower_right.y, -1, 1e-12);
}

TEST(CameraView, FieldOfViewIsExact) {
  for (const double degrees : {0.001, 1.0, 30.0, 60.0, 89.0, 90.0, 91.0, 120.0, 179.0, 179.99}) {
    Camera camera;
    camera.vertical_field_of_view = degrees;
    CameraView view;
    require(camera_view(camera, 1, &view));
    const double half_height = -(view.grid.y0 - 0.5 * view.grid.dy);
    const double expected = std::tan(degrees / 2 * (kPi / 180));
    EXPECT_NEAR(half_height / expected, 1, 1e-11) << degrees;
  }
}

TEST(CameraView, CamerasThatShowNothingAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](auto&& change) {
    Camera camera;
    change(camera);
    CameraView view;
    const Status status = camera_view(camera, 3, &view);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    return std::string(status.message());
  };
  EXPECT_NE(message([](Camera& c) { c.target = c.position; }).find("same point"),
            std::string::npos);
  EXPECT_NE(message([](Camera& c) { c.up = {0, 0, 4}; }).find("along the view"), std::string::npos);
  EXPECT_NE(message([](Camera& c) { c.up = {0, 0, 0}; }).find("up"), std::string::npos);
  EXPECT_NE(message([&](Camera& c) { c.up.x = nan; }).find("finite"), std::string::npos);
  for (const double bad : {0.0, -10.0, 180.0, nan})
    EXPECT_NE(message([&](Camera& c) { c.vertical_field_of_view = bad; }).find("field of view"),
              std::string::npos);
  EXPECT_EQ(message([](Camera& c) { c.width = 0; }),
            "camera: the width is 0, not 1 to 16384 pixels");
  EXPECT_NE(message([](Camera& c) { c.height = 16385; }).find("height is 16385"),
            std::string::npos);
}

TEST(FitCamera, EverythingIsInViewAndNearlyFillsIt) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    SceneBuilder builder(1);
    const std::uint32_t grey = builder.material("grey", 0.5, 0);
    builder.box({grey, grey, grey, grey, grey, grey}, Vec3{-1, 5, 2} * scale, Vec3{3, 6, 9} * scale,
                {2, 2, 2}, true);
    const PatchSet patches = patches_of(builder.finish());
    for (const std::uint32_t width : {300u, 600u, 100u}) {
      const Camera camera = fit_camera(patches, width, 300);
      CameraView view;
      require(camera_view(camera, 1, &view));
      double largest = 0;
      for (const Vec3& v : patches.vertices) {
        const Vec3 to = v - camera.position;
        const double z = glm::dot(to, view.view.axis_z);
        ASSERT_GT(z, 0);
        const double x =
            std::fabs(glm::dot(to, view.view.axis_x) / z / view.grid.dx) / (width / 2.0);
        const double y = std::fabs(glm::dot(to, view.view.axis_y) / z / view.grid.dy) / 150;
        largest = std::max({largest, x, y});
      }
      EXPECT_LT(largest, 1);
      EXPECT_GT(largest, 0.9);
    }
  }
}

TEST(FitCamera, StandsWhereItSeesFronts) {
  for (const double side : {1.0, -1.0}) {
    SceneBuilder builder(1);
    const std::uint32_t grey = builder.material("grey", 0.5, 0);
    if (side > 0)
      builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}); // front towards +z
    else
      builder.face(grey, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}});
    const Camera camera = fit_camera(patches_of(builder.finish()), 64, 64);
    EXPECT_GT(camera.position.z * side, 0);
  }
}

TEST(FitCamera, LooksIntoAnOpenRoomThroughItsOpening) {
  // The room is open at low y and has its ceiling at high z.
  const Camera camera = fit_camera(patches_of(hemicube::test::cornell_like(4)), 64, 64);
  EXPECT_LT(camera.position.y, -0.5);
  EXPECT_EQ(camera.up, (Vec3{0, 0, 1}));
}

/// A wall in front of the camera, x in -2..2, y in -1..1, radiosity a field.
template <typename Field> Picture draw_wall(int nx, int ny, Field&& field) {
  SceneBuilder builder(1);
  builder.grid(builder.material("grey", 0.5, 0), {-2, -1, -1}, {2, -1, -1}, {2, 1, -1}, {-2, 1, -1},
               nx, ny);
  const Scene scene = builder.finish();
  const PatchSet patches = patches_of(scene);
  const Solution solution = solution_with(scene, patches, [&](std::uint32_t patch, std::uint32_t) {
    return 2 * field(patches.centre[patch]);
  });
  Camera camera;
  camera.vertical_field_of_view = 90;
  camera.width = 200;
  camera.height = 100;
  return draw(scene, patches, solution, camera);
}

TEST(Picture, ALinearFieldComesOutLinear) {
  const auto field = [](const Vec3& p) { return 10 + 2 * p.x + 3 * p.y; };
  const Picture picture = draw_wall(8, 6, field);
  for (std::size_t y = 0; y < 100; ++y)
    for (std::size_t x = 0; x < 200; ++x) {
      const Vec3 p{(static_cast<double>(x) + 0.5 - 100) / 50,
                   (50 - static_cast<double>(y) - 0.5) / 50, -1};
      ASSERT_NEAR(red(picture, x, y), field(p) / kPi, 1e-5) << x << " " << y;
    }
}

TEST(Picture, BackFacesAndSpaceAreBlack) {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.face(grey, {{-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {1, -1, -1}}); // back, near
  builder.face(grey, {{-1, -1, -2}, {0, -1, -2}, {0, 1, -2}, {-1, 1, -2}}); // front, behind it
  const Scene scene = builder.finish();
  const PatchSet patches = patches_of(scene);
  const Solution solution =
      solution_with(scene, patches, [](std::uint32_t, std::uint32_t) { return 0.0; });
  Camera camera;
  camera.vertical_field_of_view = 90;
  camera.width = camera.height = 64;
  const Picture picture = draw(scene, patches, solution, camera);
  EXPECT_NEAR(red(picture, 28, 32), 1 / kPi, 1e-6) << "seen through the back of the near one";
  EXPECT_EQ(picture.kind[32 * 64 + 28], PixelKind::kEmitter);
  EXPECT_EQ(red(picture, 40, 32), 0);
  EXPECT_EQ(picture.kind[32 * 64 + 40], PixelKind::kBackground);
}

TEST(Picture, ThreeBandsAreRedGreenAndBlue) {
  SceneBuilder builder(3);
  const double zero[] = {0, 0, 0}, light[] = {1, 2, 3};
  builder.face(builder.material("light", zero, light),
               {{-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}});
  const Scene scene = builder.finish();
  const PatchSet patches = patches_of(scene);
  const Solution solution =
      solution_with(scene, patches, [](std::uint32_t, std::uint32_t) { return 0.0; });
  Camera camera;
  camera.width = camera.height = 4;
  const Picture picture = draw(scene, patches, solution, camera);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    EXPECT_NEAR(picture.rgb[i], static_cast<double>(i % 3 + 1) / kPi, 1e-6);
}

TEST(Picture, IsTheSameForAllKernelsAndThreads) {
  const Scene scene = hemicube::test::cornell_like(8);
  const PatchSet patches = patches_of(scene);
  const Solution solution = solution_with(scene, patches, [&](std::uint32_t p, std::uint32_t band) {
    return 1 + patches.centre[p].x + 0.1 * band;
  });
  const PictureValues values = values_of(patches, solution);
  const Camera camera = fit_camera(patches, 450, 90);
  SerialExecutor serial;
  Picture scalar;
  require(draw_picture(scene, patches, values, camera, {*raster::kernels_by_name("scalar"), 2},
                       serial, &scalar));
  for (const std::uint32_t threads : {1u, 2u, 3u, 7u}) {
    ThreadPool pool;
    require(pool.init(threads));
    Picture best;
    require(draw_picture(scene, patches, values, camera, {raster::best_kernels(), 2}, pool, &best));
    for (std::size_t i = 0; i < scalar.rgb.size(); ++i)
      ASSERT_EQ(scalar.rgb[i], best.rgb[i]) << threads;
    for (std::size_t i = 0; i < scalar.hits.size(); ++i)
      ASSERT_EQ(scalar.hits[i], best.hits[i]) << threads;
  }
}

/// The inside of a cube of edge 2 around the origin, every wall a grid.
Scene closed_room() {
  SceneBuilder builder(1);
  const std::uint32_t grey = builder.material("grey", 0.5, 1);
  builder.box({grey, grey, grey, grey, grey, grey}, {-1, -1, -1}, {1, 1, 1}, {3, 4, 5}, true);
  return builder.finish();
}

// Catches: samples between the windows or along shared edges that show nothing.
TEST(Picture, AClosedRoomShowsNoBackground) {
  const Scene scene = closed_room();
  const PatchSet patches = patches_of(scene);
  const Solution solution =
      solution_with(scene, patches, [](std::uint32_t, std::uint32_t) { return 1.0; });
  Camera camera;
  camera.position = {0.31, 0.17, 0.53};
  camera.target = {-1, -1, -0.97};
  camera.vertical_field_of_view = 110;
  camera.width = 261;
  camera.height = 130;
  for (const std::uint32_t samples : {1u, 2u, 3u, 8u}) {
    const Picture picture = draw(scene, patches, values_of(patches, solution), camera, samples);
    for (std::size_t i = 0; i < picture.kind.size(); ++i) {
      ASSERT_EQ(picture.kind[i], PixelKind::kEmitter) << samples;
      ASSERT_EQ(picture.hits[i], samples * samples);
      ASSERT_NEAR(picture.rgb[3 * i], 1.5 / kPi, 1e-6);
    }
  }
}

// Catches: samples off the pixel's area, or weighted by anything.
TEST(Picture, TheSamplesOfAPixelAreAveraged) {
  SceneBuilder builder(1);
  const std::uint32_t light = builder.material("light", 0, kPi);
  // Covers the left 5/8 of the middle column of pixels.
  builder.face(light, {{-9, -9, -1}, {0.125 / 3, -9, -1}, {0.125 / 3, 9, -1}, {-9, 9, -1}});
  const Scene scene = builder.finish();
  const PatchSet patches = patches_of(scene);
  const Solution solution =
      solution_with(scene, patches, [](std::uint32_t, std::uint32_t) { return 0.0; });
  Camera camera;
  camera.vertical_field_of_view = 53.13010235415598; // a picture of 1 x 1 at distance 1
  camera.width = camera.height = 3;
  const double expected[] = {0, 1, 0.5, 2 / 3., 0.5, 0.6, 4 / 6., 4 / 7., 0.625};
  for (std::uint32_t samples = 1; samples <= kMaxSamples; ++samples) {
    const Picture picture = draw(scene, patches, values_of(patches, solution), camera, samples);
    EXPECT_NEAR(red(picture, 0, 1), 1, 1e-6);
    EXPECT_NEAR(red(picture, 1, 1), expected[samples], 1e-6) << samples;
    EXPECT_EQ(red(picture, 2, 1), 0);
  }
}

// Catches: a grid beyond what the rasterizer takes, drawn all the same.
TEST(Picture, TheLargestPicturesTakeFewerSamples) {
  Camera camera;
  camera.width = Camera::kMaxSize;
  CameraView view;
  require(camera_view(camera, 7, &view));
  const Status status = camera_view(camera, 8, &view);
  EXPECT_EQ(status.message(), "camera: the width is 16384, not 1 to 16383 pixels");
}

TEST(Exposure, PutsTheBrightSurfacesNearWhiteAndIgnoresEmitters) {
  Picture picture;
  picture.width = 101;
  picture.height = 1;
  for (int i = 0; i <= 100; ++i) { // 0.00 .. 1.00, shuffled: 37 is prime to 101
    const float value = static_cast<float>(i * 37 % 101) / 100.f + 1;
    for (int k = 0; k < 3; ++k)
      require(picture.rgb.push_back(value));
    require(picture.kind.push_back(PixelKind::kSurface));
  }
  const double expected = 0.8 / 1.95;
  EXPECT_NEAR(choose_exposure(picture).value(), expected, 1e-6);
  for (int i = 0; i < 50; ++i) {
    for (int k = 0; k < 3; ++k)
      require(picture.rgb.push_back(1000));
    require(picture.kind.push_back(i % 2 == 0 ? PixelKind::kEmitter : PixelKind::kBackground));
  }
  EXPECT_NEAR(choose_exposure(picture).value(), expected, 1e-6);
  picture.rgb.fill(0);
  EXPECT_EQ(choose_exposure(picture).value(), 1.0);
  picture.kind.fill(PixelKind::kEmitter);
  picture.rgb.fill(4);
  EXPECT_NEAR(choose_exposure(picture).value(), 0.2, 1e-9);
}

} // namespace
} // namespace hemicube::radiosity::test
