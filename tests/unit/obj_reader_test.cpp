#include "radiosity/scene/obj_reader.h"

#include "tests/support/scene_files.h"

#include <bit>

namespace hemicube::radiosity::test {
namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class ObjReader : public SceneFiles {
protected:
  /// Reads a text as an OBJ file.
  void expect_obj(const std::string& text) {
    write("a.obj", text);
    expect_read("a.obj");
    if (!HasFatalFailure())
      expect_scene_is_sound(scene_);
  }

  /// The text must be refused on a line, with a message that holds `why`.
  void expect_error(const std::string& text, int line, const std::string& why) {
    SCOPED_TRACE(text);
    write("a.obj", text);
    expect_refused("a.obj", "a.obj:" + std::to_string(line) + ": ");
    EXPECT_NE(std::string(read("a.obj").message()).find(why), std::string::npos)
        << read("a.obj").message();
  }
};

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

TEST_F(ObjReader, ReadsPolygonsOfAnySizeInFileOrder) {
  expect_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0.5 0\nf 1 2 3\nf 4 3 2 1\nf 1 2 3 4 5\n");
  EXPECT_EQ(values_of(scene_.corner_offsets), (std::vector<std::uint64_t>{0, 3, 7, 12}));
  EXPECT_EQ(values_of(scene_.corners),
            (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1, 0, 0, 1, 2, 3, 4}));
  EXPECT_EQ(scene_.vertices[4], Vec3(-1, 0.5, 0));
  EXPECT_TRUE(scene_.face_max_edge.empty());
  EXPECT_FALSE(scene_.has_camera);
  EXPECT_EQ(names_of(scene_.bands), (std::vector<std::string>{"r", "g", "b"}));
  EXPECT_EQ(values_of(scene_.space_exitance), (std::vector<double>{0, 0, 0}));
}

TEST_F(ObjReader, NumbersAreTheNearestDoubles) {
  const std::vector<std::pair<std::string, double>> cases = {
      {"0.1", 0.1},
      {"1e-310", 1e-310},
      {"123456789.123456789", 123456789.123456789},
      {"4.9e-324", 4.9e-324},
      {"2.2250738585072011e-308", 2.2250738585072011e-308},
      {"1.7976931348623157e308", 1.7976931348623157e308},
      {"0.1000000000000000055511151231257827", 0.1},
      {"9007199254740993", 9007199254740992.0},
      {"+1.5", 1.5},
      {"-0", -0.0},
      {"1.", 1.0},
      {".5", 0.5},
      {"1E+2", 100.0},
      {"-2.5e-3", -2.5e-3},
      {"1e-400", 0.0},
      {"-1e-400", -0.0},
      {"0.000000000000000000000000000001e-300", 0.0},
      {"1e-99999999999999999999", 0.0},
  };
  for (const auto& [text, value] : cases) {
    expect_obj("v " + text + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(bits(scene_.vertices[0].x), bits(value)) << text;
  }
}

TEST_F(ObjReader, RefusesCoordinatesThatAreNoFiniteNumbers) {
  for (const std::string word : {"nan", "NaN", "-nan", "nan(1)", "inf", "-Inf", "INFINITY", "1e999",
                                 "-1e309", "1e99999999999999999999"})
    expect_error("# c\nv 0 0 " + word + "\n" + kTriangle + "f 1 2 3\n", 2,
                 "vertex coordinate '" + word + "' is not a finite number");
  for (const std::string word :
       {"1.0abc", "abc", "0x10", "1,5", "1e", "-", "+-1", "++1", "1.#QNAN"})
    expect_error("v 0 " + word + " 0\n" + kTriangle + "f 1 2 3\n", 1,
                 "vertex coordinate '" + word + "' is not a number");
  expect_error("v 0 0\n", 1, "3 coordinates, this one has 2");
  expect_error("v # 1 2 3\n", 1, "3 coordinates, this one has 0");
}

TEST_F(ObjReader, ReadsAllFormsOfCornersAndNegativeIndices) {
  expect_obj(kTriangle + "f 1/1 2/2 3/3\nf 1//1 2//2 3//3\nf 1/1/1 2/2/2 3/3/3\nf -3 -2/-1 -1//-1\n"
                         "v 5 5 5\nf +1 2 -1\n");
  EXPECT_EQ(values_of(scene_.corners),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 3}));
}

TEST_F(ObjReader, FacesMayNameLaterVertices) {
  expect_obj("f 1 2 3\n" + kTriangle);
  EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(ObjReader, RefusesBadIndices) {
  expect_error(kTriangle + "f 1 2 0\n", 4, "vertex index 0");
  expect_error(kTriangle + "f 1 2 4\n", 4, "vertex index 4: the file has only 3 vertices");
  expect_error(kTriangle + "f 1 2 -4\nv 1 1 1\n", 4, "vertex index -4: only 3 vertices");
  expect_error("f -1 -2 -3\n" + kTriangle, 1, "vertex index -1: only 0 vertices");
  expect_error(kTriangle + "f 1 2 4294967297\n", 4, "vertex index 4294967297");
  expect_error(kTriangle + "f 1 2 99999999999999999999\n", 4, "'99999999999999999999'");
  expect_error(kTriangle + "f 1 2 -9223372036854775808\n", 4, "-9223372036854775808");
  for (const std::string word : {"3.0", "x", "3a", "/3", "3/x", "3/1/x", "3/1/1/1", "3/1.5"})
    expect_error(kTriangle + "f 1 2 3\nf 1 2 " + word + "\n", 5, "'");
  // The first face with such an index is reported, not the one with the largest.
  expect_error("v 0 0 0\nf 1 2 3\nf 2 3 5\nf 1 4 2\nf 9 9 9\nv 0 0 0\nv 0 0 0\nv 1 1 1\n", 3,
               "vertex index 5: the file has only 4");
}

TEST_F(ObjReader, RefusesFacesOfFewerThanThreeCorners) {
  expect_error(kTriangle + "f 1 2\n", 4, "this one has 2");
  expect_error(kTriangle + "f\n", 4, "this one has 0");
  expect_error(kTriangle + "f 1 2 # 3\n", 4, "this one has 2");
  expect_error(kTriangle + "f 1 2 3\nf 1", 5, "this one has 1"); // cut inside the last line
}

TEST_F(ObjReader, LineEndsCommentsAndContinuations) {
  const std::string unix_text =
      "# comment \\\nv 0 0 0 # origin\n\n\tv\t1 0 0  \nv 0 1 \\\n0\nf 1 \\\n"
      " 2 \\\n 3 #end\nv 1 1 1\nf 1 2 4";
  std::string dos_text, mac_text;
  for (const char c : unix_text) {
    dos_text += c == '\n' ? "\r\n" : std::string(1, c);
    mac_text += c == '\n' ? '\r' : c;
  }
  for (const std::string& text : {unix_text, dos_text, mac_text, "\xef\xbb\xbf" + unix_text}) {
    expect_obj(text);
    EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3}));
    EXPECT_EQ(scene_.vertices[1], Vec3(1, 0, 0));
    EXPECT_EQ(scene_.vertices[2], Vec3(0, 1, 0));
  }
  // Lines are counted through continuations, in all three conventions.
  expect_error("v 0 \\\n 0 0\nv x 0 0\n", 3, "'x'");
  expect_error("v 0 \\\r\n 0 0\r\nv x 0 0\r\n", 3, "'x'");
  expect_error("v 0 \\\r 0 0\rv x 0 0\r", 3, "'x'");
  expect_error("v 0 0 0\nv 0 \\\n x 0\n", 2, "'x'"); // the line on which the statement starts
  expect_error("v 0 0 0\nf 1 2 \\", 2, "this one has 2");
}

TEST_F(ObjReader, GroupsInOrderOfFirstUse) {
  expect_obj("f 1 2 3\ng unused\ng wall  north\nf 1 2 3\ng floor\nf 1 2 3\nf 1 2 3\n"
             "g wall north # again\nf 1 2 3\ng\nf 1 2 3\n" +
             kTriangle);
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{"", "wall north", "floor"}));
  EXPECT_EQ(values_of(scene_.face_group), (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}));
}

TEST_F(ObjReader, CountsWhatItReadsOver) {
  expect_obj(kTriangle +
             "v 1 1 1 1\nv 0 0 1 0.5 0.5 0.5\nvn 0 0 nan\nvn 0 0 1\nvt 0 0\ns off\no x\n"
             "l 1 2\np 1\nvp 0 0\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2 3 4\nblah\nf 1 2 3\n");
  const std::map<std::string, std::uint64_t> expected = {
      {"vertex normals (vn)", 2},
      {"texture coordinates (vt)", 1},
      {"smoothing groups (s)", 1},
      {"object names (o)", 1},
      {"line elements (l)", 1},
      {"point elements (p)", 1},
      {"free-form points (vp)", 1},
      {"free-form curves (curv)", 1},
      {"free-form surfaces (surf)", 1},
      {"other statements (blah)", 1},
      {"vertex weights or colours (v)", 2},
  };
  EXPECT_EQ(report_.skipped, expected);
  EXPECT_EQ(report_.files, std::vector<std::string>{path("a.obj")});
}

TEST_F(ObjReader, CountsKeywordsOnJoinedLines) { // the joined line is scratch memory
  expect_obj(kTriangle + "vn 0 0 \\\n1\nvt 0 \\\n0 aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\nf 1 2 3\n");
  EXPECT_EQ(report_.skipped["vertex normals (vn)"], 1u);
  EXPECT_EQ(report_.skipped["texture coordinates (vt)"], 1u);
}

TEST_F(ObjReader, FacesBeforeAnyMaterialAreGrey) {
  expect_obj(kTriangle + "f 1 2 3\nf 3 2 1\n");
  EXPECT_EQ(report_.faces_without_material, 2u);
  EXPECT_EQ(names_of(scene_.materials), std::vector<std::string>{""});
  EXPECT_EQ(values_of(scene_.reflectance), (std::vector<double>{0.5, 0.5, 0.5}));
  EXPECT_EQ(values_of(scene_.exitance), (std::vector<double>{0, 0, 0}));
}

TEST_F(ObjReader, RefusesWhatIsNoObjFile) {
  expect_error(std::string("v 0 0 0\nv 0\0 0", 14), 2, "does not look like an OBJ file");
  expect_error("\x7f"
               "ELF\x02\x01\n",
               1, "does not look like an OBJ file");
  for (const std::string text : {"", "\n", "# nothing\n", "v 0 0 0\n", "\\", "\\\n"}) {
    write("a.obj", text);
    expect_refused("a.obj", "a.obj: the scene has no faces");
  }
  expect_refused("missing.obj", "missing.obj: does not exist");
  std::filesystem::create_directory(path("folder.obj"));
  expect_refused("folder.obj", "folder.obj: is a directory");
  expect_refused("a.txt", "a.txt: a scene is read from a file named .json, .gltf, .glb, .obj, ");
  expect_refused("obj", "obj: a scene is read from");
  expect_error("usemtl \n", 1, "usemtl without a name");
  expect_error("mtllib # none\n", 1, "mtllib without a name");
}

TEST_F(ObjReader, ExtensionInAnyCaseAndSceneKeptOnError) {
  write("A.ObJ", kTriangle + "f 1 2 3\n");
  expect_read("A.ObJ");
  write("b.obj", "f 1 2\n");
  EXPECT_FALSE(read("b.obj").ok());
  EXPECT_EQ(scene_.face_count(), 1u);
}

TEST_F(ObjReader, RefusesMoreThanTheLimits) {
  write("a.obj", kTriangle + "f 1 2 3\nf 1 2 3\n");
  FileMesh mesh;
  EXPECT_TRUE(read_obj(path("a.obj"), &mesh, &report_, {2, 3}).ok());
  EXPECT_EQ(read_obj(path("a.obj"), &mesh, &report_, {1, 3}).message(),
            path("a.obj") + ":5: more than 1 faces: split the scene into several runs");
  EXPECT_EQ(read_obj(path("a.obj"), &mesh, &report_, {2, 2}).message(),
            path("a.obj") + ":3: more than 2 vertices: split the scene into several runs");
  EXPECT_EQ(MeshLimits().faces, (std::uint64_t{1} << 31) - 2);
  EXPECT_LT(MeshLimits().vertices, std::uint64_t{1} << 32);
}

} // namespace
} // namespace hemicube::radiosity::test
