#include "radiosity/scene/stl_reader.h"

#include "tests/support/file_bytes.h"
#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

/// A triangle of a text file.
std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\n  outer loop\n    vertex " + a + "\n    vertex " + b +
         "\n    vertex " + c + "\n  endloop\nendfacet\n";
}

const std::string kText = "solid left wall\n" + facet("0 0 0", "1 0 0", "0 0.1 0") +
                          facet("1 0 0", "1 0 0", "0 0 1e-3") + "endsolid left wall\n";

/// A binary file of triangles, nine coordinates each.
std::string binary(const std::vector<std::vector<float>>& triangles,
                   const std::string& title = "made by a test") {
  std::string bytes = title + std::string(80 - title.size(), ' ') +
                      bytes_of(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    bytes += std::string(12, '\0');
    for (const float value : triangle)
      bytes += bytes_of(value);
    bytes += "at";
  }
  return bytes;
}

const std::vector<std::vector<float>> kTriangles = {{0, 0, 0, 1, 0, 0, 0, 0.1f, 0},
                                                    {1, 0, 0, 1, 0, 0, 0, 0, 1e-3f}};

class StlReader : public SceneFiles {
protected:
  void expect_stl(const std::string& bytes) {
    SCOPED_TRACE(bytes);
    write("a.stl", bytes);
    expect_read("a.stl");
    if (!HasFatalFailure())
      expect_scene_is_sound(scene_);
  }

  void expect_error(const std::string& bytes, const std::string& place, const std::string& why) {
    SCOPED_TRACE(bytes);
    write("a.stl", bytes);
    expect_refused("a.stl", "a.stl" + place);
    EXPECT_NE(std::string(read("a.stl").message()).find(why), std::string::npos)
        << read("a.stl").message();
  }
};

// Catches: a triangle with two equal corners lost, and the numbers of all others with it.
TEST_F(StlReader, TextGivesAllTrianglesInFileOrder) {
  expect_stl(kText);
  EXPECT_EQ(values_of(scene_.corner_offsets), (std::vector<std::uint64_t>{0, 3, 6}));
  EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(
      values_of(scene_.vertices),
      (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 1e-3}}));
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"left wall"}));
  EXPECT_EQ(report_.faces_without_material, 2u);
}

TEST_F(StlReader, SolidsAreGroups) {
  expect_stl("solid a\nendsolid a\n" + kText + "\nSOLID\n" + facet("0 0 0", "1 0 0", "0 1 0") +
             "ENDSOLID\n" + kText);
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"left wall", ""}));
  EXPECT_EQ(values_of(scene_.face_group), (std::vector<std::uint32_t>{0, 0, 1, 0, 0}));
}

// Catches: a binary file taken for text because it begins with 'solid'.
TEST_F(StlReader, BinaryGivesFloatsAsTheyAre) {
  for (const std::string title : {"made by a test", "solid ", ""}) {
    expect_stl(binary(kTriangles, title));
    EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(scene_.vertices[2], Vec3(0, static_cast<double>(0.1f), 0));
    EXPECT_EQ(scene_.vertices[5], Vec3(0, 0, static_cast<double>(1e-3f)));
    EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{""}));
  }
}

TEST_F(StlReader, BinaryFilesOfAnotherSizeThanTheySayAreRefused) {
  const std::string bytes = binary(kTriangles);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    write("a.stl", bytes.substr(0, size));
    expect_refused("a.stl", "a.stl: ");
  }
  expect_error(bytes + "x", ": ", "the file says 2 triangles, which are 184 bytes, but it has 185");
  std::string huge = bytes;
  huge.replace(80, 4, "\xff\xff\xff\xff");
  expect_error(huge, ": ", "4294967295 triangles, which are 214748364834 bytes, but it has 184");
  expect_error(binary({}), ": ", "no faces");
  expect_error(binary(kTriangles, "solid").substr(0, 150), ":1: ", "not that of a binary one");
  expect_error("facet", ": ", "this is no STL file");
  const float nan = std::nanf("");
  expect_error(binary({{0, 0, 0, 1, 0, nan, 0, 1, 0}}),
               ": byte 116: ", "nan is not a finite number");
}

TEST_F(StlReader, TextThatBreaksOffIsRefused) {
  std::size_t refused = 0;
  for (std::size_t size = 0; size < kText.size(); ++size) {
    write("a.stl", kText.substr(0, size));
    refused += read("a.stl").code() == StatusCode::kBadScene ? 1u : 0u;
  }
  // Whole only when nothing but the name behind endsolid is cut.
  EXPECT_EQ(refused, kText.size() - std::string("left wall\n").size() - 1);
}

TEST_F(StlReader, WhatIsWrongIsRefusedWhereItStands) {
  const auto with = [](const std::string& vertex) {
    return "solid\n" + facet("0 0 0", vertex, "0 1 0") + "endsolid\n";
  };
  expect_error(with("1 nan 0"), ":5: ", "vertex coordinate 'nan' is not a finite number");
  expect_error(with("1 x 0"), ":5: ", "vertex coordinate 'x' is not a number");
  expect_error(with("1 0"), ":5: ", "a vertex needs 3 coordinates, this one has 2");
  expect_error(with("1 0 0\nvertex 1 1 0"), ":7: ", "should begin with 'endloop'");
  expect_error("solid\nfacet\nouter loop\nvertex 0 0 0\nendloop\n", ":5: ", "begin with 'vertex'");
  expect_error("solid\nfacet\nouter\n", ":3: ", "should begin with 'outer loop'");
  expect_error("solid\nfoo\n", ":2: ", "should begin with 'facet' or 'endsolid': 'foo'");
  expect_error(kText + "foo\n", ":17: ", "should begin with 'solid': 'foo'");
  expect_error("solid a\nendsolid a\n", ": ", "no faces");
}

} // namespace
} // namespace hemicube::radiosity::test
