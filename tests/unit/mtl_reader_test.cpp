#include "radiosity/scene/mtl_reader.h"

#include "tests/support/scene_files.h"

#include <sys/stat.h>

namespace hemicube::radiosity::test {
namespace {

class MtlReader : public SceneFiles {
protected:
  /// An OBJ file with one face of each material.
  std::string obj(const std::string& head, const std::vector<std::string>& materials) const {
    std::string text = head + "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const std::string& material : materials)
      text += "usemtl " + material + "\nf 1 2 3\n";
    return text;
  }

  /// The library, used by a face of material `red`, must be refused on a line for a reason.
  void expect_error(const std::string& mtl, int line, const std::string& why) {
    SCOPED_TRACE(mtl);
    write("a.mtl", mtl);
    write("a.obj", obj("mtllib a.mtl\n", {"red"}));
    expect_refused("a.obj", "a.mtl:" + std::to_string(line) + ": ");
    EXPECT_NE(std::string(read("a.obj").message()).find(why), std::string::npos)
        << read("a.obj").message();
  }
};

TEST_F(MtlReader, KdIsReflectanceAndKeIsExitance) {
  write("a.mtl", "# c\nnewmtl red\nKd 0.1 0 1\nKe 10 8.5 1e-310\nnewmtl unused\nKd 0.3\n"
                 "newmtl grey\n  Kd 0.7\r\nnewmtl lamp\nKe +2");
  write("a.obj", obj("mtllib a.mtl\n", {"lamp", "red", "grey", "lamp"}));
  expect_read("a.obj");
  expect_scene_is_sound(scene_);
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"lamp", "red", "grey"}));
  EXPECT_EQ(values_of(scene_.face_material), (std::vector<std::uint32_t>{0, 1, 2, 0}));
  EXPECT_EQ(values_of(scene_.reflectance),
            (std::vector<double>{0, 0, 0, 0.1, 0, 1, 0.7, 0.7, 0.7}));
  EXPECT_EQ(values_of(scene_.exitance), (std::vector<double>{2, 2, 2, 10, 8.5, 1e-310, 0, 0, 0}));
  EXPECT_EQ(values_of(scene_.two_sided), (std::vector<std::uint8_t>{0, 0, 0}));
  EXPECT_EQ(report_.files, (std::vector<std::string>{path("a.obj"), path("a.mtl")}));
  EXPECT_EQ(report_.faces_without_material, 0u);
}

TEST_F(MtlReader, CountsWhatItReadsOver) {
  write("a.mtl", "illum 2\nnewmtl red\nKd 0.5\nKa 1 1 1\nKs nan\nd 0.5\nTr 1\nNs 3\nNi 1\n"
                 "map_Kd a b.png\nmap_Bump x\nbump x\nPr 1\n");
  write("a.obj", obj("mtllib a.mtl\n", {"red"}));
  expect_read("a.obj");
  const std::map<std::string, std::uint64_t> expected = {
      {"illumination models (illum)", 1},
      {"ambient colours (Ka)", 1},
      {"specular colours (Ks)", 1},
      {"specular exponents (Ns)", 1},
      {"transparency (d)", 1},
      {"transparency (Tr)", 1},
      {"indices of refraction (Ni)", 1},
      {"textures (map_Kd)", 1},
      {"textures (map_Bump)", 1},
      {"textures (bump)", 1},
      {"other material statements (Pr)", 1},
  };
  EXPECT_EQ(report_.skipped, expected);
}

TEST_F(MtlReader, RefusesValuesOutOfRange) {
  const std::string red = "newmtl red\n";
  expect_error(red + "Kd 0.5 1.2 0\n", 2, "material 'red': reflectance (Kd) 1.2 is outside [0, 1]");
  expect_error(red + "Kd -0.1\n", 2, "material 'red': reflectance (Kd) -0.1 is outside [0, 1]");
  expect_error(red + "Kd 1.0000000000000002\n", 2, "1.0000000000000002 is outside");
  expect_error(red + "Kd 1 1 1\nKe 0 0 -1\n", 3, "material 'red': exitance (Ke) -1 is negative");
  expect_error(red + "Ke nan\n", 2, "exitance (Ke) 'nan' is not a finite number");
  expect_error(red + "Kd 0 inf 0\n", 2, "reflectance (Kd) 'inf' is not a finite number");
  expect_error(red + "Ke 1e999\n", 2, "'1e999' is not a finite number");
  expect_error(red + "Kd 0.5x\n", 2, "'0.5x' is not a number");
  expect_error(red + "Kd\n", 2, "takes 1 value or 3, not 0");
  expect_error(red + "Kd 0.1 0.2\n", 2, "takes 1 value or 3, not 2");
  expect_error(red + "Kd 0.1 0.2 0.3 0.4\n", 2, "takes 1 value or 3, not 4");
  expect_error(red + "Kd spectral a.rfl\n", 2,
               "material 'red': reflectance (Kd) is given as spectral");
  expect_error(red + "Ke xyz 1 1 1\n", 2, "exitance (Ke) is given as xyz");
  expect_error(red + "Kd 0.5\nKd 0.5\n", 3, "is given twice, first on line 2");
  // A material that no face uses is checked all the same.
  expect_error(red + "Kd 0.5\nnewmtl other\nKd 2\n", 4, "material 'other'");
}

TEST_F(MtlReader, RefusesBadStructure) {
  expect_error("Kd 0.5\nnewmtl red\n", 1, "Kd before the first newmtl");
  expect_error("\nnewmtl\n", 2, "newmtl without a name");
  expect_error("newmtl red\nKd 0.5\nnewmtl red\nKd 0.5\n", 3,
               "material 'red' is defined twice, first at " + path("a.mtl") + ":1");
  expect_error("newmtl other\nKd 1\nnewmtl red\nKs 1 1 1\n", 3,
               "material 'red' is used by a face, but has neither Kd (reflectance) nor Ke");
  expect_error(std::string("newmtl red\nKd \0", 15), 2, "does not look like an MTL file");
}

TEST_F(MtlReader, RefusesADefinitionInALaterLibrary) {
  write("a.mtl", "newmtl red\nKd 0.5\n");
  write("b.mtl", "newmtl blue\nKd 0.5\nnewmtl red\nKd 0.5\n");
  write("a.obj", obj("mtllib a.mtl b.mtl\n", {"red"}));
  expect_refused("a.obj",
                 "b.mtl:3: material 'red' is defined twice, first at " + path("a.mtl") + ":1");
}

TEST_F(MtlReader, FindsLibraries) {
  write("my lib.mtl", "newmtl red\nKd 0.5\n");
  write("b.mtl", "newmtl blue\nKd 0.25\n");
  write("c.mtl", "newmtl green wall #2\nKd 0.75\n");
  // A name with spaces, several names, the same name again, and a definition behind its use.
  write("a.obj", obj("mtllib my lib.mtl # spaces\nmtllib b.mtl ./b.mtl\nmtllib  my lib.mtl\n",
                     {"red", "blue", "green wall #2 # comment"}) +
                     "mtllib c.mtl");
  expect_read("a.obj");
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{"red", "blue", "green wall #2"}));
  EXPECT_EQ(report_.files, (std::vector<std::string>{path("a.obj"), path("my lib.mtl"),
                                                     path("b.mtl"), path("c.mtl")}));
}

TEST_F(MtlReader, RefusesMissingLibrariesAndMaterials) {
  write("b.mtl", "newmtl red\nKd 0.5\n");
  write("a.obj", obj("# c\nmtllib b.mtl none.mtl\n", {"red"}));
  expect_refused("a.obj", "a.obj:2: material library 'none.mtl' does not exist (looked for ");
  write("a.obj", obj("mtllib #none.mtl\n", {"red"}));
  expect_refused("a.obj", "a.obj:1: material library '#none.mtl' does not exist");
  write("a.obj", obj("mtllib b.mtl\n", {"red", "blue"}));
  expect_refused("a.obj", "a.obj:7: material 'blue' is used by a face, but no material library");
  write("a.obj", obj("", {"red"}));
  expect_refused("a.obj", "a.obj:4: material 'red' is used by a face, but no material library");
  // The usemtl of the first face that uses it is the one to mend; a name no face uses does no harm.
  write("a.obj", obj("mtllib b.mtl\nusemtl blue\nusemtl none\n", {"red", "blue"}));
  expect_refused("a.obj", "a.obj:9: material 'blue'");
  write("a.obj", obj("mtllib b.mtl\nusemtl none\n", {"red"}));
  expect_read("a.obj");
}

TEST_F(MtlReader, RefusesPipesInsteadOfWaiting) {
  ASSERT_EQ(::mkfifo(path("pipe.mtl").c_str(), 0600), 0);
  write("a.obj", obj("mtllib pipe.mtl\n", {"red"}));
  expect_refused("a.obj", "a.obj:1: material library 'pipe.mtl' is a pipe or device, not a file");
}

// Catches: a message about a folder that does not say which line named it.
TEST_F(MtlReader, RefusesFoldersWithTheLineThatNamesThem) {
  for (const std::string folder : {".", "..", "../..", "/"}) {
    write("a.obj", obj("# c\nmtllib " + folder + "\n", {"red"}));
    expect_refused("a.obj", "a.obj:2: material library '" + folder +
                                "' is a directory, not a file (looked for ");
  }
}

TEST_F(MtlReader, LongPathsAndNamesOnlyCutTheMessage) {
  const std::string longest(200, 'x');
  write("a.mtl", "newmtl " + std::string(100000, 'y') + "\nKd 7\n");
  std::filesystem::create_directories(folder_ / longest / longest);
  const std::string name = longest + "/" + longest + "/a.obj";
  write(name, obj("mtllib ../../a.mtl\n", {"red"}));
  expect_refused(name, "a.mtl:2: material 'yyyy");
  write(name, obj("", {std::string(100000, 'z')}));
  expect_refused(name, name + ":4: material 'zzzz");
}

} // namespace
} // namespace hemicube::radiosity::test
