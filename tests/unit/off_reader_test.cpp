#include "radiosity/scene/off_reader.h"

#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

const std::string kVertices = "0 0 0\n1 0 0\n1 1 0\n0 0.1 0\n";
const std::string kFaces = "3 0 1 2\n4 3 2 1 0\n";

class OffReader : public SceneFiles {
protected:
  void expect_off(const std::string& text) {
    SCOPED_TRACE(text);
    write("a.off", text);
    expect_read("a.off");
    if (HasFatalFailure())
      return;
    expect_scene_is_sound(scene_);
    EXPECT_EQ(values_of(scene_.corner_offsets), (std::vector<std::uint64_t>{0, 3, 7}));
    EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1, 0}));
    EXPECT_EQ(scene_.vertices[3], Vec3(0, 0.1, 0));
  }

  void expect_error(const std::string& text, const std::string& place, const std::string& why) {
    SCOPED_TRACE(text);
    write("a.off", text);
    expect_refused("a.off", "a.off" + place);
    EXPECT_NE(std::string(read("a.off").message()).find(why), std::string::npos)
        << read("a.off").message();
  }
};

// Catches: counts looked for where another writer does not put them.
TEST_F(OffReader, CountsStandWhereWritersPutThem) {
  for (const std::string head :
       {"OFF\n4 2 5\n", "OFF\n4 2\n", "OFF 4 2 0\n", "OFF4 2 0\n",
        "OFF # made by x\n\n# y\n4 2 0 # z\n", "# first\n\n  OFF\r\n4\t2 0\r\n"})
    expect_off(head + kVertices + kFaces);
  EXPECT_TRUE(report_.skipped.empty());
  EXPECT_EQ(report_.faces_without_material, 2u);
}

// Catches: colours taken for the next face; faces lost behind a comment.
TEST_F(OffReader, CommentsAreReadOverAndColoursCounted) {
  expect_off("OFF\n4 2 0\n0 0 0\n1 0 0 # here\n# there\n\n1 1 0\n0 0.1 0\n3 0 1 2 255 0 0\n"
             "4 3 2 1 0 0.5 0.5 0.5 1\n");
  EXPECT_EQ(report_.skipped, (std::map<std::string, std::uint64_t>{{"face colours", 2}}));
  expect_off("STCNOFF\n4 2 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 0.1 0 0 0 1\n" +
             kFaces);
  EXPECT_EQ(report_.skipped, (std::map<std::string, std::uint64_t>{
                                 {"vertex colours, normals or texture coordinates", 4}}));
}

TEST_F(OffReader, CountsThatAreNotThoseOfTheLinesAreRefused) {
  expect_error("OFF\n4 3 0\n" + kVertices + kFaces, ": ",
               "the file says 3 faces, but ends after 2");
  expect_error("OFF\n4 1 0\n" + kVertices + kFaces, ":8: ", "has 1 faces, but this line is one mo");
  expect_error("OFF\n4 2 0\n0 0 0\n1 0 0\n", ": ", "the file says 4 vertices, but ends after 2");
  expect_error("OFF\n4294967294 2147483646 0\n" + kVertices, ": ", "4294967294 vertices");
  expect_error("OFF\n5 2 0\n" + kVertices + kFaces, ": ",
               "the file says 2 faces, but ends after 1");
  expect_error("OFF\n4 4294967295 0\n", ":2: ", "4 vertices and 4294967295 faces");
  expect_error("OFF\n3 0 0\n0 0 0\n1 0 0\n1 1 0\n", ": ", "no faces");
  expect_error("OFF\n", ": ", "the file ends before its counts");
  expect_error("", ": ", "the file is empty");
}

TEST_F(OffReader, WhatIsWrongIsRefusedWhereItStands) {
  const auto with = [](const std::string& vertex, const std::string& face) {
    return "OFF\n4 2 0\n0 0 0\n" + vertex + "\n1 1 0\n0 1 0\n" + face + "\n3 0 1 2\n";
  };
  const std::string good = "4 0 1 2 3";
  expect_error(with("1 nan 0", good), ":4: ", "vertex coordinate 'nan' is not a finite number");
  expect_error(with("1 1e999 0", good), ":4: ", "'1e999' is not a finite number");
  expect_error(with("1 x 0", good), ":4: ", "vertex coordinate 'x' is not a number");
  expect_error(with("1 0", good), ":4: ", "a vertex needs 3 coordinates, this one has 2");
  expect_error(with("1 0 0", "3 0 1 4"), ":7: ", "vertex index 4: the file has 4 vertices");
  expect_error(with("1 0 0", "3 0 -1 2"), ":7: ", "vertex index -1");
  expect_error(with("1 0 0", "3 0 1 2.5"), ":7: ", "vertex index '2.5' is not an integer");
  expect_error(with("1 0 0", "4 0 1 2"), ":7: ", "the face should have 4 corners, but has 3");
  expect_error(with("1 0 0", "9223372036854775807 0 1 2"), ":7: ", "corners, but has 3");
  expect_error(with("1 0 0", "2 0 1"), ":7: ", "a face needs 3 corners or more, this one has 2");
  expect_error(with("1 0 0", "x"), ":7: ", "begins with the number of its corners, not 'x'");
  expect_error("OFF\n4 2 0 0\n", ":2: ", "counts must be those of vertices, faces and edges");
  expect_error("OFF\n4 -2 0\n", ":2: ", "not '-2'");
  expect_error("OFF\n4\n", ":2: ", "counts of vertices and faces are needed");
  expect_error("OFG\n4 2 0\n", ":1: ", "this is no OFF file: it begins with 'OFG'");
  expect_error("4 2 0\n", ":1: ", "this is no OFF file: it begins with '4'");
  expect_error("4OFF\n4 2 0\n", ":1: ", "vertices of '4OFF' are not in three dimensions");
  expect_error("OFF BINARY\n", ":1: ", "binary OFF is not read");
  expect_error("OFF\n4 2 0\n" + kVertices + std::string(1, '\x01'), ":7: ", "a byte of value 1");
}

} // namespace
} // namespace hemicube::radiosity::test
