// Scenes that cannot be modelled: exit 3 with FILE:LINE, and nothing is written.

#include "tests/cli/cli_case.h"

namespace hemicube::test {
namespace {

class BadSceneTest : public CliCase {
protected:
  /// Every command refuses the scene with exit 3 and a message that holds the parts.
  void expect_bad_scene(const std::string& scene, const std::vector<std::string>& parts) const {
    expect_refused(3, {"solve", scene, "-o", path("out")}, parts);
    expect_refused(3, {"formfactors", scene, "-o", path("f.mtx")}, parts);
    expect_refused(3, {"render", scene, "-o", path("picture.png")}, parts);
    expect_refused(3, {"info", scene}, parts);
    expect_refused(3, {"look", scene, "--patch", "0", "-o", path("look.png")}, parts);
  }
};

/// The room with one line of its OBJ file replaced, by number from 1.
std::string room_with_line(std::size_t number, const std::string& line) {
  std::vector<std::string> lines = lines_of(std::string(kRoomObj));
  lines.at(number - 1) = line;
  std::string text;
  for (const std::string& each : lines)
    text += each + "\n";
  return text;
}

TEST_F(BadSceneTest, MissingFile) {
  expect_bad_scene(path("nowhere.obj"), {path("nowhere.obj")});
  expect_bad_scene(path("nowhere.json"), {path("nowhere.json")});
}

TEST_F(BadSceneTest, FileOfAnUnknownKind) {
  expect_bad_scene(write("room.txt", kRoomObj), {path("room.txt"), ".obj"});
}

TEST_F(BadSceneTest, TruncatedFile) {
  // Cut in the middle of the first face: it has two corners left.
  const std::string_view cut = kRoomObj.substr(0, kRoomObj.find("f 1 2 3 4") + 5);
  expect_bad_scene(write_room(cut), {path("room.obj") + ":11:"});
}

TEST_F(BadSceneTest, TruncatedJson) {
  expect_bad_scene(write("room.json", "{\n\"version\": 1,\n\"meshes\": ["), {path("room.json")});
}

TEST_F(BadSceneTest, BinaryFile) {
  std::string bytes = "\x7f"
                      "ELF\n";
  for (int k = 0; k < 4096; ++k)
    bytes += static_cast<char>(k * 37 % 256);
  expect_bad_scene(write("room.obj", bytes), {path("room.obj") + ":"});
}

TEST_F(BadSceneTest, IndexOutOfRange) {
  expect_bad_scene(write_room(room_with_line(11, "f 1 2 3 9")), {path("room.obj") + ":11:", "9"});
}

TEST_F(BadSceneTest, NotANumber) {
  expect_bad_scene(write_room(room_with_line(3, "v 1 nan 0")), {path("room.obj") + ":3:", "nan"});
}

TEST_F(BadSceneTest, MissingMaterial) {
  expect_bad_scene(write_room(room_with_line(10, "usemtl gold")),
                   {path("room.obj") + ":10:", "gold"});
}

TEST_F(BadSceneTest, ReflectanceAboveOne) {
  expect_bad_scene(write_room(kRoomObj, "newmtl white\nKd 0.5 1.5 0.5\n"),
                   {path("room.mtl") + ":2:", "1.5"});
}

TEST_F(BadSceneTest, NoFaces) {
  expect_bad_scene(write_room("mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\n"), {path("room.obj")});
}

TEST_F(BadSceneTest, OnlyFacesWithoutArea) {
  expect_bad_scene(write_room("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"), {"1 zero area"});
}

TEST_F(BadSceneTest, AFolderInTheFolderIsNoScene) {
  expect_refused(3, {"solve", path("")}, {path("")});
}

TEST_F(BadSceneTest, ASurfaceThatGathersLightForEverHasNoSolution) {
  std::string_view mtl = "newmtl white\nKd 1 1 1\nKe 1 1 1\nnewmtl light\nKd 1 1 1\n"
                         "newmtl red\nKd 1 1 1\n";
  const ProgramResult result = run(1, {"solve", write_room(kRoomObj, mtl), "-o", path("out")});
  EXPECT_TRUE(result.err.starts_with("hemicube: ")) << result.err;
  for (const std::string& name : new_files())
    EXPECT_EQ(name, "out/");
}

TEST_F(BadSceneTest, FacesWithoutAreaAreDroppedAndCounted) {
  const std::string scene = write_room(std::string(kRoomObj) + "f 1 2 2\nv 2 0 0\nf 1 2 9\n");
  const ProgramResult result = run(0, {"solve", scene, "--json"});
  EXPECT_NE(result.err.find("1 face dropped: a vertex is named twice"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("1 face dropped: no area"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("\"dropped_repeated_index\": 1"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\"dropped_zero_area\": 1"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\"patches\": 6"), std::string::npos) << result.out;
}

TEST_F(BadSceneTest, WhatIsReadOverIsCounted) {
  const std::string scene = write_room(kRoomObj, std::string(kRoomMtl) + "map_Kd brick.png\n");
  const ProgramResult result = run(0, {"solve", scene});
  EXPECT_NE(result.err.find("map_Kd"), std::string::npos) << result.err;
  EXPECT_EQ(run(0, {"solve", scene, "--quiet"}).err, "");
}

// All coordinates of the cube at 10^6 are 32-bit floats as well, which are 1/16 apart there.
TEST_F(BadSceneTest, CoordinatesRoundedToFloatsAreNamed) {
  std::string far;
  for (const std::string& line : lines_of(std::string(kRoomObj)))
    far += line.starts_with("v 0") || line.starts_with("v 1") ? "v 100000" + line.substr(2) + "\n"
                                                              : line + "\n";
  const ProgramResult result = run(0, {"info", write_room(far)});
  EXPECT_NE((result.out + result.err).find("rounded to 32-bit floats, which are 0.06"),
            std::string::npos)
      << result.out << result.err;
  const ProgramResult near = run(0, {"info", write_room(kRoomObj)});
  EXPECT_EQ((near.out + near.err).find("32-bit"), std::string::npos) << near.out << near.err;
}

TEST_F(BadSceneTest, ControlCharactersInNamesStayOutOfMessages) {
  const ProgramResult result = run(3, {"solve", path("two\nlines\x1b[2J.obj")});
  EXPECT_EQ(lines_of(result.err).size(), 1u) << result.err;
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
}

} // namespace
} // namespace hemicube::test
