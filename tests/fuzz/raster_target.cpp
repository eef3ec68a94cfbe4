#include "tests/fuzz/raster_case.h"

#include "tests/fuzz/byte_reader.h"
#include "tests/fuzz/target.h"
#include "tests/support/naive_raster.h"
#include "tests/support/polygon_shapes.h"

#include <algorithm>
#include <cmath>

namespace hemicube::test {
namespace {

constexpr std::uint32_t kMostPolygons = 64;

/// Polygons of a case that is compared with its polygons drawn alone.
constexpr std::uint32_t kMostAlone = 6;

/// Builds polygons in the axes of the view, its eye at 0, its size around 1; then moves them.
class Decoder {
public:
  explicit Decoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  RasterFuzzCase decode();

private:
  void decode_look();
  void decode_place();
  std::vector<Vec3> decode_polygon();
  std::vector<Vec3> copy_of_an_earlier_one();
  std::vector<Vec3> edge_on();
  std::vector<Vec3> on_pixels();

  Vec3 to_world(const Vec3& v) const {
    const raster::View& view = case_.look.view;
    return view.eye + (view.axis_x * v.x + view.axis_y * v.y + view.axis_z * v.z) * scale_;
  }

  ByteReader bytes_;
  RasterFuzzCase case_;
  std::vector<std::vector<Vec3>> local_; ///< [polygon], in the axes of the view
  double scale_ = 1;
};

void Decoder::decode_look() {
  raster::View& view = case_.look.view;
  const std::uint32_t switches = bytes_.byte();
  view.above_horizon = (switches & 1) == 0;
  view.draw_backs = (switches & 2) == 0;
  if ((switches & 4) != 0)
    view.skip = bytes_.below(kMostPolygons); // perhaps of no polygon
  if ((switches & 8) != 0) {
    const int width = 1 + static_cast<int>(bytes_.byte());
    const int height = 1 + static_cast<int>(bytes_.below(64));
    static constexpr double kHalfHeights[] = {0.01, 0.3, 1, 20};
    case_.look.drawings.push_back(
        camera_drawing(width, height, kHalfHeights[bytes_.below(4)], (switches & 16) != 0));
  } else {
    static constexpr std::uint32_t kResolutions[] = {2, 16, 18, 34, 64, 70, 130, 258};
    case_.look.drawings = hemicube_drawings(kResolutions[bytes_.below(8)]);
  }
}

/// Where the view stands, how it is turned, and how large everything is.
void Decoder::decode_place() {
  raster::View& view = case_.look.view;
  switch (bytes_.below(4)) {
  case 0:
  case 1:
    break;
  case 2:
    view.axis_x = {0, 0.8, 0.6};
    view.axis_y = {0, -0.6, 0.8};
    view.axis_z = {1, 0, 0};
    break;
  default: {
    const Vec3 z = unit(bytes_.point() + Vec3(0x1p-20, 0, 3));
    const Vec3 x = unit(glm::cross(Vec3(0, 1, 0x1p-5), z));
    view.axis_x = x;
    view.axis_y = glm::cross(z, x);
    view.axis_z = z;
  }
  }
  static constexpr double kScales[] = {1, 1, 1, 1e-30, 1e29, 0x1p-90, 1e6, 1e-6};
  scale_ = kScales[bytes_.below(8)];
  static constexpr double kOffsets[] = {0, 0, 1, 1e3, 1e6, 1e9};
  const Vec3 eye = bytes_.point();
  view.eye = eye * (scale_ * kOffsets[bytes_.below(6)]);
}

std::vector<Vec3> Decoder::copy_of_an_earlier_one() {
  if (local_.empty())
    return {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  std::vector<Vec3> polygon = local_[bytes_.byte() % local_.size()];
  const std::uint32_t how = bytes_.byte();
  if ((how & 1) != 0)
    polygon = reversed(polygon);
  polygon = turned(polygon, static_cast<int>((how >> 1) % polygon.size()));
  // Nearer or farther by nothing, by a last bit, or by more.
  const double tiny = bytes_.tiny(), tinier = tiny * bytes_.tiny();
  const double by = tinier * bytes_.coarse();
  for (Vec3& corner : polygon)
    corner = corner * (1 + by);
  return polygon;
}

/// Its plane holds the eye, or passes it closely.
std::vector<Vec3> Decoder::edge_on() {
  const Vec3 a = bytes_.point(), b = bytes_.point();
  const Vec3 tiny = bytes_.tiny_point();
  const Vec3 off = tiny * bytes_.tiny();
  const double near = bytes_.tiny();
  return {a * near + off, b * near + off, b + off, a + off};
}

/// A rectangle on pixel borders of a grid of 64.
std::vector<Vec3> Decoder::on_pixels() {
  const auto border = [&] { return static_cast<double>(bytes_.below(68)) / 32 - 1.0625; };
  const auto few = [&] { return (1 + static_cast<double>(bytes_.below(16))) / 32; };
  const double x = border(), y = border(), z = 1 + bytes_.tiny(), width = few(), height = few();
  const int corners = 4 + static_cast<int>(bytes_.below(36));
  return card(x * z, (x + width) * z, y * z, (y + height) * z, z, corners);
}

std::vector<Vec3> Decoder::decode_polygon() {
  switch (bytes_.below(12)) {
  case 0:
    return {bytes_.point(), bytes_.point(), bytes_.point()};
  case 1: { // a parallelogram
    const Vec3 at = bytes_.point(), u = bytes_.point(), v = bytes_.point();
    return {at, at + u, at + u + v, at + v};
  }
  case 2: { // with many corners
    Random random(bytes_.byte());
    const int corners = 3 + static_cast<int>(bytes_.below(38));
    const Vec3 at = bytes_.point();
    return random_ngon(random, corners, at, 2 * bytes_.tiny());
  }
  case 3: { // a sliver
    const Vec3 at = bytes_.point(), u = bytes_.point();
    const Vec3 v = bytes_.tiny_point();
    return {at, at + u, at + u + v, at + v};
  }
  case 4:
    return copy_of_an_earlier_one();
  case 5:
    return edge_on();
  case 6: { // an edge in the plane of the eye, or a corner
    Vec3 at = bytes_.point(), u = bytes_.point();
    const Vec3 v = bytes_.point();
    at.z = 0;
    if (bytes_.below(2) == 0)
      u.z = 0;
    return {at, at + u, at + u + v, at + v};
  }
  case 7: { // around the eye
    const Vec3 u = bytes_.point(), v = bytes_.point();
    const Vec3 off = bytes_.tiny_point();
    return {off - u - v, off + u - v, off + u + v, off - u + v};
  }
  case 8: { // repeated vertices
    const Vec3 a = bytes_.point(), b = bytes_.point(), c = bytes_.point();
    const std::uint32_t which = bytes_.below(4);
    return which == 0   ? std::vector<Vec3>{a, a, b, c}
           : which == 1 ? std::vector<Vec3>{a, b, b, c, c, c}
           : which == 2 ? std::vector<Vec3>{a, b, c, a}
                        : std::vector<Vec3>{a, b, a};
  }
  case 9: { // huge beside the others
    const Vec3 at = bytes_.point(), v = bytes_.point();
    const Vec3 way = bytes_.point();
    const Vec3 u = way / (bytes_.tiny() + 0x1p-40);
    return {at, at + u, at + u + v, at + v};
  }
  case 10: { // tiny beside the others, perhaps close
    const double tiny = bytes_.tiny(), small = tiny * bytes_.tiny();
    const Vec3 at = bytes_.tiny_point(), u = bytes_.point() * small;
    const Vec3 v = bytes_.point() * small;
    return {at, at + u, at + v};
  }
  default:
    return on_pixels();
  }
}

RasterFuzzCase Decoder::decode() {
  decode_look();
  decode_place();
  while (!bytes_.at_end() && local_.size() < kMostPolygons) {
    local_.push_back(decode_polygon());
    std::vector<Vec3> polygon = local_.back();
    for (Vec3& corner : polygon) {
      corner = to_world(corner);
      for (int axis = 0; axis < 3; ++axis) // what readers of scenes let through
        corner[axis] = std::clamp(corner[axis], -0x1p100, 0x1p100);
    }
    case_.polygons.add(polygon);
  }
  return case_;
}

} // namespace

RasterFuzzCase decode_raster_case(std::span<const std::uint8_t> bytes) {
  return Decoder(bytes).decode();
}

/// Compares what was drawn with what the naive oracle sees, where that is certain.
static std::string naive_problem(const RasterFuzzCase& fuzz, const std::vector<DrawnFace>& drawn) {
  const raster::View& view = fuzz.look.view;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const Drawing& drawing = fuzz.look.drawings[k];
    const std::string what =
        difference(naive_image(fuzz.polygons.view(), view, drawing.face, drawing.grid), drawn[k]);
    if (!what.empty())
      return "naive, face " + std::to_string(static_cast<int>(drawing.face)) + ": " + what;
  }
  return "";
}

/// What the oracle knows of: a receiver that is left out with its copies it does not, nor a horizon
/// that pixels look below.
static bool is_for_the_oracle(const RasterFuzzCase& fuzz) {
  std::size_t pixels = 0;
  for (const Drawing& drawing : fuzz.look.drawings)
    pixels += static_cast<std::size_t>(drawing.grid.width) *
              static_cast<std::size_t>(drawing.grid.height);
  const bool is_hemicube = fuzz.look.drawings.size() == raster::kFaceCount;
  return pixels <= 4096 && fuzz.look.view.skip >= fuzz.polygons.count() &&
         (is_hemicube || !fuzz.look.view.above_horizon);
}

std::string check_raster_case(const RasterFuzzCase& fuzz) {
  const auto draw = [&](const std::string& isa, raster::Culling culling) {
    Drawer drawer(fuzz.polygons.view(), *raster::kernels_by_name(isa), culling);
    return draw_look(&drawer, fuzz.look);
  };
  const auto expected = draw("scalar", raster::Culling::kOff);
  for (const std::string& isa : kernels_here()) {
    const std::string what = difference(fuzz.look, expected, draw(isa, raster::Culling::kOn));
    if (!what.empty())
      return isa + ": " + what;
  }
  if (fuzz.polygons.count() > kMostAlone)
    return "";
  const std::string what = difference(fuzz.look, composed_look(fuzz.polygons, fuzz.look), expected);
  if (!what.empty())
    return "polygons drawn alone: " + what;
  return is_for_the_oracle(fuzz) ? naive_problem(fuzz, expected) : "";
}

Verdict judge_raster(Bytes bytes) {
  const RasterFuzzCase fuzz = decode_raster_case(bytes);
  return {check_raster_case(fuzz), fuzz.polygons.count() > 0};
}

} // namespace hemicube::test
