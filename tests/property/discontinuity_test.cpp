// Meshes cut along discontinuities: sound whatever the lines are, and no element of a random room
// has the border of a shadow running through it.
#include "radiosity/discontinuity/discontinuity_mesh.h"
#include "radiosity/discontinuity/patch_cutter.h"
#include "radiosity/discontinuity/segment_clip.h"
#include "radiosity/discontinuity/shadow_lines.h"
#include "tests/support/shadow_rooms.h"
#include "tests/support/sound_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace hemicube::radiosity {
namespace {

using test::expect_sound;
using test::fronts_of;
using test::inner_points;
using test::is_hidden;
using test::polygon_of;
using test::Random;
using test::require;

PatchSet cut_by(const PatchSet& patches, std::span<const DiscontinuityLine> lines, double snap) {
  PatchCutter cutter;
  PatchSet cells;
  require(cutter.init(patches));
  for (const DiscontinuityLine& line : lines)
    for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
      cutter.cut(patch, line.begin, line.end, line.light, snap);
  for (const DiscontinuityLine& line : lines)
    for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
      cutter.note_light(patch, line.begin, line.end, line.light, snap);
  require(cutter.make_mesh(&cells));
  EXPECT_EQ(cells.patch_count(), cutter.cell_count());
  return cells;
}

/// Lines over a sheet of triangles and quads, drawn by lot from what makes cutting hard: ends at
/// vertices, through one point, along edges, the same again, nearly the same, without length.
std::vector<DiscontinuityLine> hard_lines(const PatchSet& patches, std::uint32_t seed) {
  Random random(seed);
  std::vector<DiscontinuityLine> lines;
  const auto vertex = [&] {
    return patches.vertices[random.index(static_cast<std::uint32_t>(patches.vertices.size()))];
  };
  const auto inside = [&] {
    const std::uint32_t patch = random.index(patches.patch_count());
    const std::vector<Vec3> corners = polygon_of(patches, patch);
    Vec3 sum(0);
    double weights = 0;
    for (const Vec3& corner : corners) {
      const double weight = random.unit();
      sum += weight * corner;
      weights += weight;
    }
    return sum / weights;
  };
  const Vec3 common = inside();
  for (int k = 0; k < 30; ++k) {
    DiscontinuityLine line;
    line.light = random.index(2) == 0 ? EdgeLight::kBends : EdgeLight::kJumps;
    line.begin = random.index(3) == 0 ? vertex() : inside();
    line.end = random.index(3) == 0 ? vertex() : inside();
    if (random.index(4) == 0)
      line.end = line.begin + 2.0 * (common - line.begin);
    if (!lines.empty() && random.index(5) == 0)
      line = lines[random.index(static_cast<std::uint32_t>(lines.size()))];
    if (random.index(5) == 0)
      line.end += 1e-9 * random.point(-1, 1);
    if (random.index(9) == 0)
      line.end = line.begin;
    lines.push_back(line);
  }
  return lines;
}

TEST(PatchCutter, HardLinesLeaveASoundMesh) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const PatchSet patches = test::patches_of(test::crooked_sheet(seed));
    for (const double snap : {1e-12, 1e-6, 1e-3, 0.05}) {
      const PatchSet cells = cut_by(patches, hard_lines(patches, seed), snap);
      EXPECT_GT(cells.patch_count(), patches.patch_count());
      expect_sound(patches, cells);
      if (testing::Test::HasFailure())
        return;
    }
  }
}

TEST(PatchCutter, NoNewEdgeIsShorterThanTheSnap) {
  const PatchSet patches = test::patches_of(test::crooked_sheet(3));
  constexpr double kSnap = 0.02;
  const PatchSet cells = cut_by(patches, hard_lines(patches, 3), kSnap);
  for (std::uint32_t c = 0; c < cells.patch_count(); ++c) {
    const std::vector<Vec3> points = polygon_of(cells, c);
    for (std::size_t k = 0; k < points.size(); ++k)
      EXPECT_GE(glm::length(points[(k + 1) % points.size()] - points[k]), kSnap) << c;
  }
}

TEST(PatchCutter, PowersOfTwoInScaleChangeNoBit) {
  const PatchSet patches = test::patches_of(test::crooked_sheet(5));
  const std::vector<DiscontinuityLine> lines = hard_lines(patches, 5);
  const PatchSet cells = cut_by(patches, lines, 0x1p-10);
  for (const double scale : {0x1p-20, 0x1p20}) {
    PatchSet scaled = test::patches_of(test::scaled(test::crooked_sheet(5), scale));
    std::vector<DiscontinuityLine> scaled_lines = lines;
    for (DiscontinuityLine& line : scaled_lines) {
      line.begin *= scale;
      line.end *= scale;
    }
    const PatchSet other = cut_by(scaled, scaled_lines, 0x1p-10 * scale);
    ASSERT_EQ(other.corners.size(), cells.corners.size());
    for (std::size_t k = 0; k < cells.corners.size(); ++k)
      ASSERT_EQ(other.vertices[other.corners[k]], scale * cells.vertices[cells.corners[k]]);
  }
}

TEST(PatchCutter, NoCellLiesOnBothSidesOfALine) {
  constexpr double kSnap = 1e-9;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const PatchSet patches = test::patches_of(test::crooked_sheet(seed));
    const std::vector<DiscontinuityLine> lines = hard_lines(patches, seed);
    const PatchSet cells = cut_by(patches, lines, kSnap);
    for (const DiscontinuityLine& line : lines) {
      const double length = glm::length(line.end - line.begin);
      for (std::uint32_t c = 0; c < cells.patch_count() && length > 0; ++c) {
        const Vec3 across = glm::cross(cells.normal[c], (line.end - line.begin) / length);
        // What of the cell lies left of the line and what right, between its ends.
        double most = 0, least = 0;
        const std::vector<Vec3> points = polygon_of(cells, c);
        for (std::size_t k = 0; k < points.size(); ++k) {
          const Vec3 from = points[k] - line.begin,
                     to = points[(k + 1) % points.size()] - line.begin;
          SegmentPart part;
          const double at_from = glm::dot(from, line.end - line.begin) / length;
          const double at_to = glm::dot(to, line.end - line.begin) / length;
          part.keep_positive(at_from - 1e-6, at_to - 1e-6);
          part.keep_positive(length - 1e-6 - at_from, length - 1e-6 - at_to);
          for (const double share : {part.begin, part.end}) {
            const double side = glm::dot(across, from + share * (to - from));
            most = part.is_empty() ? most : std::max(most, side);
            least = part.is_empty() ? least : std::min(least, side);
          }
        }
        EXPECT_LT(std::min(most, -least), 10 * kSnap) << "cell " << c;
      }
    }
  }
}

/// Pairs of inner points of one element that do not see the same corners of an emitter, and how
/// many points were looked at.
struct Sight {
  int differences = 0, points = 0, sees_some = 0, sees_none = 0;
  std::string first; ///< difference
};

Sight compare_sights(const test::Scene& scene, const PatchSet& patches, const PatchSet& elements,
                     double margin, std::uint32_t seed) {
  std::vector<EmitterFace> emitters;
  require(find_emitters(scene, patches, &emitters));
  Random random(seed);
  Sight sight;
  for (std::uint32_t e = 0; e < elements.patch_count(); ++e) {
    std::vector<bool> first;
    Vec3 first_point(0);
    for (const Vec3& point :
         inner_points(polygon_of(elements, e), elements.normal[e], margin, &random)) {
      std::vector<bool> sees;
      bool any = false;
      for (const EmitterFace& emitter : emitters)
        for (const Vec3& corner : emitter.corners) {
          const bool faces = glm::dot(elements.normal[e], corner - point) > 0 &&
                             glm::dot(emitter.normal, point - corner) > 0;
          sees.push_back(faces && !is_hidden(patches, point, corner, 1e-3 * margin));
          any = any || sees.back();
        }
      ++sight.points;
      ++(any ? sight.sees_some : sight.sees_none);
      if (first.empty()) {
        first = sees;
        first_point = point;
      }
      if (sees != first && sight.differences++ == 0) {
        std::ostringstream text;
        text << "element " << e << " of patch " << elements.parent[e] << ", from " << first_point.x
             << " " << first_point.y << " " << first_point.z << ":";
        for (const bool seen : first)
          text << " " << seen;
        text << ", from " << point.x << " " << point.y << " " << point.z << ":";
        for (const bool seen : sees)
          text << " " << seen;
        sight.first = text.str();
      }
    }
  }
  return sight;
}

TEST(Discontinuities, PointsOfAnElementSeeTheSameCornersOfTheEmitter) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const double scale = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 1e-6 : 1e6;
    const test::Scene scene = test::scaled(test::random_box_room(seed), scale);
    const PatchSet patches = fronts_of(scene);
    PatchSet elements;
    DiscontinuityReport report;
    std::vector<DiscontinuityLine> lines;
    DiscontinuityLimits limits;
    limits.snap = 1e-7 * scale;
    limits.max_elements = 100000;
    require(cut_discontinuities(scene, patches, limits, &elements, &lines, &report));
    ASSERT_EQ(report.lines_skipped, 0u);
    const Sight before = compare_sights(scene, patches, patches, 1e-6 * scale, seed);
    const Sight after = compare_sights(scene, patches, elements, 1e-6 * scale, seed);
    EXPECT_GT(before.differences, 0);
    EXPECT_GT(after.sees_some, 100);
    EXPECT_GT(after.sees_none, 0);
    EXPECT_EQ(after.differences, 0) << after.first;
    expect_sound(patches, elements);
  }
}

/// What there is to be afraid of, each with what is expected of its report.
struct HostileRoom {
  const char* name;
  void (*add)(test::SceneBuilder* builder, std::uint32_t lamp, std::uint32_t box);
};

const HostileRoom kHostileRooms[] = {
    {"lamp that lies on the floor",
     [](test::SceneBuilder* b, std::uint32_t lamp, std::uint32_t) {
       b->face(lamp, {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}});
     }},
    {"lamp that stands at a wall, and a box at it",
     [](test::SceneBuilder* b, std::uint32_t lamp, std::uint32_t box) {
       b->face(lamp, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}});
       test::add_box(b, box, {0.25, 0.5, 0}, {Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 0.5)});
     }},
    {"lamp through a box",
     [](test::SceneBuilder* b, std::uint32_t lamp, std::uint32_t box) {
       b->face(lamp, {{1, 1, 1.5}, {1, 2, 1.5}, {2, 2, 1.5}, {2, 1, 1.5}});
       test::add_box(b, box, {1.5, 1.25, 1}, {Vec3(1, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 1)});
     }},
    {"the same box twice, and one that shares a side",
     [](test::SceneBuilder* b, std::uint32_t lamp, std::uint32_t box) {
       b->face(lamp, {{1, 1, 2}, {1, 2, 2}, {2, 2, 2}, {2, 1, 2}});
       for (const double x : {1.5, 1.5, 2.0})
         test::add_box(b, box, {x, 1.25, 0}, {Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 1)});
     }},
    {"slivers, and sheets through one line",
     [](test::SceneBuilder* b, std::uint32_t lamp, std::uint32_t box) {
       b->face(lamp, {{1, 1, 2}, {1, 2, 2}, {2, 2, 2}, {2, 1, 2}});
       b->face(box, {{0.5, 0.5, 1}, {3, 0.5, 1}, {3, 0.5 + 1e-9, 1}});
       b->face(box, {{1, 1, 1}, {2, 1, 1}, {2, 1, 1.5}, {1, 1, 1.5}});
       b->face(box, {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}});
       b->face(box, {{1, 1, 1}, {2, 1, 1}, {2, 0.5, 0.5}, {1, 0.5, 0.5}});
     }},
    {"a star of triangles around one point",
     [](test::SceneBuilder* b, std::uint32_t lamp, std::uint32_t box) {
       b->face(lamp, {{1, 1, 2}, {1, 2, 2}, {2, 2, 2}, {2, 1, 2}});
       for (int k = 0; k < 8; ++k) {
         const double x = (k & 1) != 0 ? 0.5 : -0.5, y = (k & 2) != 0 ? 0.5 : -0.5,
                      z = (k & 4) != 0 ? 0.5 : -0.5;
         b->face(box, {{2, 1.5, 1}, {2 + x, 1.5, 1 + z}, {2, 1.5 + y, 1 + z}});
       }
     }},
    {"no lamp", [](test::SceneBuilder* b, std::uint32_t, std::uint32_t box) {
       test::add_box(b, box, {1, 1, 0}, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
     }}};

TEST(Discontinuities, HostileRoomsHaveASoundMesh) {
  for (const HostileRoom& room : kHostileRooms)
    for (const double scale : {1.0, 1e-6, 1e6}) {
      SCOPED_TRACE(room.name);
      test::SceneBuilder builder(1);
      const std::uint32_t wall = builder.material("wall", 0.5, 0);
      const std::uint32_t lamp = builder.material("lamp", 0.2, 10);
      const std::uint32_t box = builder.material("box", 0.4, 0);
      builder.two_sided(box);
      builder.box({wall, wall, wall, wall, wall, wall}, {0, 0, 0}, {4, 3, 2.5}, {3, 3, 2}, true);
      room.add(&builder, lamp, box);
      const test::Scene scene = test::scaled(builder.finish(), scale);
      const PatchSet patches = fronts_of(scene);
      PatchSet elements;
      DiscontinuityReport report;
      std::vector<DiscontinuityLine> lines;
      require(cut_discontinuities(scene, patches, {}, &elements, &lines, &report));
      expect_sound(patches, elements);
      EXPECT_GT(report.elements, report.patches);
    }
}

TEST(Discontinuities, WithoutAnEmitterOnlyContactsCount) {
  test::SceneBuilder builder(1);
  const std::uint32_t wall = builder.material("wall", 0.5, 0);
  builder.face(wall, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  test::add_box(&builder, wall, {1, 1, 0}, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  const test::Scene scene = builder.finish();
  const PatchSet patches = fronts_of(scene);
  PatchSet elements;
  DiscontinuityReport report;
  std::vector<DiscontinuityLine> lines;
  require(cut_discontinuities(scene, patches, {}, &elements, &lines, &report));
  EXPECT_EQ(report.emitters, 0u);
  EXPECT_EQ(report.wedges, 0u);
  // The floor under the box, by its bottom and by its sides.
  EXPECT_EQ(report.contact_lines, 8u);
  EXPECT_EQ(elements.patch_count(), patches.patch_count() + 4);
  double under = 0, jumps = 0;
  for (std::uint32_t e = 0; e < elements.patch_count(); ++e) {
    const Vec3& c = elements.centre[e];
    if (elements.parent[e] == 0 && c.x > 1 && c.x < 2 && c.y > 1 && c.y < 2)
      under += elements.area[e];
    const auto corners = elements.corners_of(e);
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (elements.parent[e] == 0 &&
          elements.light_across(elements.corner_offsets[e] + k) == EdgeLight::kJumps)
        jumps += glm::length(elements.vertices[corners[(k + 1) % corners.size()]] -
                             elements.vertices[corners[k]]);
  }
  EXPECT_EQ(under, 1);
  EXPECT_EQ(jumps, 8); // four sides, from both sides
}

TEST(Discontinuities, ThousandsOfOccludersMeetTheBudget) {
  Random random(1);
  test::SceneBuilder builder(1);
  const std::uint32_t wall = builder.material("wall", 0.5, 0);
  const std::uint32_t lamp = builder.material("lamp", 0.2, 10);
  builder.box({wall, wall, wall, wall, wall, wall}, {0, 0, 0}, {4, 3, 2.5}, {3, 3, 2}, true);
  builder.face(lamp, {{1, 1, 2}, {1, 2, 2}, {2, 2, 2}, {2, 1, 2}});
  for (int k = 0; k < 1000; ++k) {
    const auto frame = test::random_frame(random);
    test::add_box(&builder, wall, random.point(0.1, 1.9),
                  {0.01 * frame[0], 0.01 * frame[1], 0.01 * frame[2]});
  }
  const test::Scene scene = builder.finish();
  const PatchSet patches = fronts_of(scene);
  PatchSet elements;
  DiscontinuityReport report;
  std::vector<DiscontinuityLine> lines;
  DiscontinuityLimits limits;
  limits.max_wedges = 3000;
  limits.max_elements = 7000;
  require(cut_discontinuities(scene, patches, limits, &elements, &lines, &report));
  EXPECT_LE(report.wedges, limits.max_wedges + 4); // the quarters of a horizon
  EXPECT_GT(report.wedges_skipped, 50000u);
  EXPECT_GT(report.lines_skipped, 0u);
  EXPECT_GE(report.elements, limits.max_elements);
  EXPECT_LT(report.elements, limits.max_elements + 1000); // those of the last line
  EXPECT_EQ(elements.patch_count(), report.elements);
  expect_sound(patches, elements);
}

TEST(Discontinuities, LimitsThatMakeNoSenseAreRefused) {
  const test::Scene scene = test::random_box_room(0);
  const PatchSet patches = fronts_of(scene);
  PatchSet elements;
  DiscontinuityReport report;
  std::vector<DiscontinuityLine> lines;
  for (const double snap : {-1.0, std::nan(""), HUGE_VAL}) {
    DiscontinuityLimits limits;
    limits.snap = snap;
    EXPECT_EQ(cut_discontinuities(scene, patches, limits, &elements, &lines, &report).code(),
              StatusCode::kInvalidArgument);
  }
  DiscontinuityLimits few;
  few.max_elements = patches.patch_count() - 1;
  EXPECT_EQ(cut_discontinuities(scene, patches, few, &elements, &lines, &report).code(),
            StatusCode::kInvalidArgument);
}

} // namespace
} // namespace hemicube::radiosity
