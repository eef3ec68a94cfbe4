// elements.csv, written and read back, whole and damaged.

#include "radiosity/output/element_table.h"
#include "tests/unit/refine_support.h"

#include <random>

namespace hemicube::test {
namespace {

/// A sheet cut at random, and its table.
struct Tables : testing::Test {
  Tables() : cuttable(mixed_sheet(1)) {
    cuttable.cut(2);
    cuttable.cut_at_random(1, 25);
    table = radiosity::element_table(cuttable.tree);
  }
  /// Reads a table over the patches as they were. @param tree  of them
  Status read(std::string_view text, ElementTree* tree) const {
    require(tree->init(cuttable.scene, cuttable.patches));
    return radiosity::read_element_table(text, "dir/elements.csv", tree);
  }
  void expect_same_mesh(const ElementTree& tree) const {
    PatchSet actual;
    require(tree.make_mesh(&actual));
    const PatchSet expected = cuttable.mesh();
    ASSERT_EQ(actual.patch_count(), expected.patch_count());
    for (std::uint32_t e = 0; e < expected.patch_count(); ++e)
      ASSERT_EQ(polygon_of(actual, e), polygon_of(expected, e)) << "element " << e;
    EXPECT_EQ(radiosity::element_table(tree), table);
  }
  void expect_refused(std::string_view text, const std::string& start) const {
    ElementTree tree;
    const Status status = read(text, &tree);
    EXPECT_EQ(status.code(), StatusCode::kBadScene);
    EXPECT_TRUE(status.message().starts_with("dir/elements.csv:" + start))
        << "expected " << start << "\nactual   " << status.message();
  }

  Cuttable cuttable;
  std::string table;
};

TEST_F(Tables, SayWhichPieceOfWhichPatch) {
  Cuttable one(mixed_sheet(1));
  one.cut(1);
  one.cut(one.tree.child(1, 1));
  EXPECT_EQ(radiosity::element_table(one.tree), "patch,path\n0,\n1,0\n1,1.0\n1,1.1\n2,\n3,\n4,\n");
}

// Catches: a path that leads to another piece, or bits that depend on the order of the cuts.
TEST_F(Tables, ComeBackAsTheSameMesh) {
  ElementTree tree;
  const Status status = read(table, &tree);
  ASSERT_TRUE(status.ok()) << status.message();
  expect_same_mesh(tree);
}

// Catches: a file cut off that is read as a coarser mesh.
TEST_F(Tables, CutOffAreRefused) {
  for (std::size_t size = 0; size < table.size(); ++size) {
    ElementTree tree;
    const Status status = read(table.substr(0, size), &tree);
    ASSERT_EQ(status.code(), StatusCode::kBadScene) << size << " bytes:\n"
                                                    << table.substr(0, size) << "\nof\n"
                                                    << table;
    ASSERT_TRUE(status.message().starts_with("dir/elements.csv:")) << status.message();
  }
}

// Catches: damage that is read as another mesh, or that leads out of the arrays.
TEST_F(Tables, DamagedAreRefusedOrMeanTheSame) {
  std::mt19937 random(20241);
  const std::string_view likely = "0123456789.,-+\n\r\" ex\0\xff";
  int same = 0, refused = 0;
  for (int round = 0; round < 500; ++round) {
    std::string text = table;
    for (std::uint32_t k = 0; k <= random() % 3; ++k) {
      const std::size_t at = random() % text.size();
      const char c = likely[random() % likely.size()];
      const std::uint32_t kind = random() % 4;
      if (kind == 0)
        text[at] = c;
      else if (kind == 1)
        text.insert(at, 1, c);
      else if (kind == 2)
        text.erase(at, 1 + random() % 8);
      else
        text.insert(at, text.substr(random() % text.size(), 12));
    }
    SCOPED_TRACE(text);
    ElementTree tree;
    const Status status = read(text, &tree);
    if (status.ok()) {
      ++same;
      expect_same_mesh(tree);
    } else {
      ++refused;
      EXPECT_EQ(status.code(), StatusCode::kBadScene);
      const std::string_view message = status.message();
      ASSERT_TRUE(message.starts_with("dir/elements.csv:")) << message;
      EXPECT_NE(message.find_first_of("0123456789"), std::string_view::npos) << message;
    }
    if (HasFailure())
      return;
  }
  EXPECT_GT(refused, 400);
  EXPECT_GT(same, 1) << "else nothing is ever read";
}

// Catches: numbers that wrap around or are read in part, pieces there are not, patches there are
// not (a back among them), leaves named twice or left out.
TEST_F(Tables, NameTheLineThatIsWrong) {
  const std::string head = "patch,path\n";
  expect_refused("", "1: the first line");
  expect_refused("path,patch\n", "1: the first line");
  expect_refused(head + "0\n", "2: ");
  expect_refused(head + "0,,\n", "2: ");
  for (const char* patch :
       {"5", "6", "-1", "4294967296", "18446744073709551616", "0x0", "1e0", "", " 0", "+0"})
    expect_refused(head + patch + ",\n", "2: '" + std::string(patch) + "' is no patch");
  for (const char* path : {"4", "-1", "4294967296", "0.", ".0", "0..0", "0.4", "a", "0,0"})
    expect_refused(head + "0," + path + "\n", "2: ");
  expect_refused(head + "0,0.0\n0,0\n1,\n2,\n3,\n4,\n", "3: "); // was cut by the line before
  expect_refused(head + "0,0\n0,1\n0,2\n0,3\n0,3.0\n", "6: ");  // no leaf of an earlier line
  for (const char* rest :
       {"0,\n1,\n2,\n3,\n", "0,\n0,\n1,\n2,\n3,\n4,\n", "1,\n0,\n2,\n3,\n4,\n",
        "0,0\n0,1\n0,2\n1,\n2,\n3,\n4,\n", "0,00\n0,1\n0,2\n0,3\n1,\n2,\n3,\n4,\n"})
    expect_refused(head + rest, "");
}

// Catches: recursion as deep as a path is long; cutting below what doubles resolve; 2^31 pieces.
TEST_F(Tables, PathsWithoutEndAreRefused) {
  std::string path = "0";
  for (int k = 0; k < 100000; ++k)
    path += ".0";
  SceneBuilder builder(1); // a corner at the origin, where doubles can be halved a thousand times
  builder.face(builder.material("grey", 0.5, 1), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  Cuttable square(builder.finish());
  for (Cuttable* made : {&cuttable, &square}) {
    ElementTree tree;
    require(tree.init(made->scene, made->patches));
    const Status status =
        radiosity::read_element_table("patch,path\n0," + path + "\n", "e.csv", &tree);
    EXPECT_EQ(status.code(), StatusCode::kBadScene);
    EXPECT_TRUE(status.message().starts_with("e.csv:2: patch 0 has no element"))
        << status.message();
    EXPECT_LT(tree.node_count(), 3000u);
  }
}

} // namespace
} // namespace hemicube::test
