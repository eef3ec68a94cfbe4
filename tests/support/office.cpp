#include "tests/support/office.h"

#include <algorithm>
#include <cmath>

namespace hemicube::test {
namespace {

constexpr double kRoomX = 4.1, kRoomY = 5.3, kRoomZ = 2.8, kWall = 0.15, kSlab = 0.3;
constexpr double kDoorWidth = 0.93, kDoorHeight = 2.07, kGap = 0.004;

class OfficeBuilder {
public:
  explicit OfficeBuilder(double cell) : cell_(cell) {
    plaster_ = scene_.material("plaster", 0.7, 0);
    wood_ = scene_.material("wood", 0.4, 0);
    carpet_ = scene_.material("carpet", 0.25, 0);
    lamp_ = scene_.material("lamp", 0.8, 1);
  }

  void room(const OfficePlan& plan, int i, int j, int storey);

  Scene finish() { return scene_.finish(); }

private:
  int cells(double length) const {
    return std::max(1, static_cast<int>(std::ceil(length / cell_ - 1e-9)));
  }

  void rectangle(std::uint32_t material, const Vec3& corner, const Vec3& u, const Vec3& v) {
    scene_.grid(material, corner, corner + u, corner + u + v, corner + v, cells(glm::length(u)),
                cells(glm::length(v)));
  }

  /// A wall seen from the side cross(along, up), with or without a doorway.
  void wall(const Vec3& corner, const Vec3& along, double door_begin, bool door);

  /// The inner faces of a doorway through a wall.
  void doorway(const Vec3& corner, const Vec3& along, const Vec3& through, double door_begin);

  /// A closed box seen from outside. @param turn  cosine and sine of its turn about the upright
  void box(std::uint32_t material, const Vec3& corner, const Vec3& size, double cosine = 1,
           double sine = 0);

  void desk(const Vec3& at, double cosine, double sine);
  void shelf(const Vec3& at, int boards);

  SceneBuilder scene_{1};
  double cell_;
  std::uint32_t plaster_ = 0, wood_ = 0, carpet_ = 0, lamp_ = 0;
};

void OfficeBuilder::wall(const Vec3& corner, const Vec3& along, double door_begin, bool door) {
  const Vec3 up{0, 0, kRoomZ};
  if (!door) {
    rectangle(plaster_, corner, up, along);
    return;
  }
  const double length = glm::length(along);
  const Vec3 begin = along * (door_begin / length);
  const Vec3 end = along * ((door_begin + kDoorWidth) / length);
  const Vec3 lintel{0, 0, kDoorHeight};
  rectangle(plaster_, corner, up, begin);
  rectangle(plaster_, corner + end, up, along - end);
  rectangle(plaster_, corner + begin + lintel, up - lintel, end - begin);
}

void OfficeBuilder::doorway(const Vec3& corner, const Vec3& along, const Vec3& through,
                            double door_begin) {
  const double length = glm::length(along);
  const Vec3 begin = corner + along * (door_begin / length);
  const Vec3 end = corner + along * ((door_begin + kDoorWidth) / length);
  const Vec3 up{0, 0, kDoorHeight};
  rectangle(wood_, begin, end - begin, through);      // threshold, seen from above
  rectangle(wood_, begin + up, through, end - begin); // lintel, seen from below
  rectangle(wood_, begin, through, up);
  rectangle(wood_, end, up, through);
}

void OfficeBuilder::box(std::uint32_t material, const Vec3& corner, const Vec3& size, double cosine,
                        double sine) {
  const Vec3 x = Vec3(cosine, sine, 0) * size.x, y = Vec3(-sine, cosine, 0) * size.y,
             z = Vec3(0, 0, size.z);
  rectangle(material, corner, y, x);
  rectangle(material, corner + z, x, y);
  rectangle(material, corner, x, z);
  rectangle(material, corner + y, z, x);
  rectangle(material, corner, z, y);
  rectangle(material, corner + x, y, z);
}

// Parts of furniture stand kGap apart: two faces in one place would each hide the other.

void OfficeBuilder::desk(const Vec3& at, double cosine, double sine) {
  const Vec3 x(cosine, sine, 0), y(-sine, cosine, 0), z(0, 0, 1);
  for (const double px : {0.02, 1.53})
    for (const double py : {0.02, 0.73})
      box(wood_, at + x * px + y * py + z * kGap, {0.05, 0.05, 0.7}, cosine, sine);
  box(wood_, at + z * 0.71, {1.6, 0.8, 0.03}, cosine, sine);
  box(plaster_, at + x * 0.5 + y * 0.5 + z * 0.78, {0.55, 0.04, 0.35}, cosine, sine);
  box(wood_, at + x * 1.1 + y * 0.1 + z * 0.02, {0.4, 0.6, 0.6}, cosine, sine);
  box(carpet_, at + x * 0.4 - y * 0.6 + z * 0.45, {0.5, 0.5, 0.08}, cosine, sine);
  box(carpet_, at + x * 0.4 - y * 0.7 + z * 0.53, {0.5, 0.06, 0.5}, cosine, sine);
}

void OfficeBuilder::shelf(const Vec3& at, int boards) {
  box(wood_, at + Vec3(0, 0, kGap), {0.03, 0.35, 1.9});
  box(wood_, at + Vec3(1.17, 0, kGap), {0.03, 0.35, 1.9});
  for (int k = 0; k < boards; ++k) {
    const Vec3 board = at + Vec3(0.03 + kGap, 0, 0.05 + k * (1.8 / boards));
    box(wood_, board, {1.14 - 2 * kGap, 0.35, 0.03});
    box(carpet_, board + Vec3(0.1, 0.05, 0.03 + kGap), {0.3 + 0.1 * (k % 4), 0.25, 0.2});
  }
}

void OfficeBuilder::room(const OfficePlan& plan, int i, int j, int storey) {
  const Vec3 at(i * (kRoomX + kWall), j * (kRoomY + kWall), storey * (kRoomZ + kSlab));
  const Vec3 x(kRoomX, 0, 0), y(0, kRoomY, 0), z(0, 0, kRoomZ);
  // Every third door is shut.
  const auto door_x = [&](int a) { return a >= 0 && a + 1 < plan.rooms_x && (a + j) % 3 != 2; };
  const auto door_y = [&](int b) { return b >= 0 && b + 1 < plan.rooms_y && (b + i) % 3 != 1; };
  const double door_at_x = 1.3, door_at_y = 2.9;
  rectangle(carpet_, at, x, y);
  rectangle(plaster_, at + z, y, x);
  wall(at + x, y, door_at_y, door_x(i));
  wall(at + y, -y, kRoomY - door_at_y - kDoorWidth, door_x(i - 1));
  wall(at + y + x, -x, kRoomX - door_at_x - kDoorWidth, door_y(j));
  wall(at, x, door_at_x, door_y(j - 1));
  if (door_x(i))
    doorway(at + x + y, -y, {kWall, 0, 0}, kRoomY - door_at_y - kDoorWidth);
  if (door_y(j))
    doorway(at + y, x, {0, kWall, 0}, door_at_x);

  const int kind = (i * 7 + j * 3 + storey * 5) % 4;
  for (int lamp = 0; lamp < 2; ++lamp)
    box(lamp_, at + Vec3(0.9 + 1.7 * lamp, 2, kRoomZ - 0.14), {0.6, 1.2, 0.08});
  desk(at + Vec3(0.3, 3.1, 0), 1, 0);
  desk(at + Vec3(2.6, 1.1, 0), 0.8, 0.6);
  if (kind != 0)
    desk(at + Vec3(0.2, 1.3, 0), 12.0 / 13, -5.0 / 13);
  shelf(at + Vec3(0.05, 4.9, 0), 4 + kind);
  shelf(at + Vec3(2.8, 4.9, 0), 5);
  box(wood_, at + Vec3(0.05, 0.1, 0.01), {0.45, 0.9, 1.3 + 0.2 * kind});
}

} // namespace

Scene office(const OfficePlan& plan) {
  OfficeBuilder builder(plan.cell);
  for (int storey = 0; storey < plan.storeys; ++storey)
    for (int j = 0; j < plan.rooms_y; ++j)
      for (int i = 0; i < plan.rooms_x; ++i)
        builder.room(plan, i, j, storey);
  return builder.finish();
}

} // namespace hemicube::test
