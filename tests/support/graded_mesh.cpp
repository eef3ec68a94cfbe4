#include "tests/support/graded_mesh.h"

#include <cmath>
#include <memory>
#include <set>

namespace hemicube::test {
namespace {

constexpr int kCells = 64; ///< of the finest grid along a side

struct Square {
  int x, y, size; ///< in cells
};

void cut(const Square& square, const std::function<bool(double, double, double)>& splits,
         std::vector<Square>* leaves) {
  const double unit = kCells;
  if (square.size == 1 || !splits(square.x / unit, square.y / unit, square.size / unit)) {
    leaves->push_back(square);
    return;
  }
  const int half = square.size / 2;
  for (const int j : {0, 1})
    for (const int i : {0, 1})
      cut({square.x + i * half, square.y + j * half, half}, splits, leaves);
}

} // namespace

void add_graded_sheet(SceneBuilder* builder, const SheetPlace& place,
                      const std::function<bool(double, double, double)>& splits,
                      const std::function<std::uint32_t(double, double, double)>& material_of) {
  std::vector<Square> leaves;
  cut({0, 0, kCells}, splits, &leaves);
  std::set<std::pair<int, int>> vertices;
  for (const auto& [x, y, size] : leaves)
    vertices.insert({{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}});
  for (const auto& [x, y, size] : leaves) {
    std::vector<Vec3> corners;
    constexpr int kSteps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    int px = x, py = y;
    for (const auto& [dx, dy] : kSteps)
      for (int k = 0; k < size; ++k, px += dx, py += dy)
        if (vertices.contains({px, py}))
          corners.push_back(place.at(px / double{kCells}, py / double{kCells}));
    builder->face(material_of(x / double{kCells}, y / double{kCells}, size / double{kCells}),
                  corners);
  }
}

bool splits_gently(double x, double y, double size) {
  const double dx = x, dy = std::fmax(0, std::fmax(y - 0.5, 0.5 - (y + size)));
  return size > 0.25 || (size > 1.0 / 32 && std::fmax(dx, dy) < 1.5 * size);
}

bool splits_steeply(double x, double y, double size) {
  return size > 0.25 ||
         (size > 1.0 / 32 && x < 0.5 && x + size > 0.375 && y < 0.5 && y + size > 0.375);
}

std::function<bool(double, double, double)> splits_at_random(std::uint32_t seed) {
  return [random = std::make_shared<Random>(seed)](double, double, double size) {
    return size > 0.25 || random->unit() < 0.4;
  };
}

} // namespace hemicube::test
