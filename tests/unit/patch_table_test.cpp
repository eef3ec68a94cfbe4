#include "radiosity/output/patch_table.h"

#include "radiosity/output/csv_reader.h"
#include "radiosity/output/group_table.h"
#include "tests/unit/output_support.h"

#include <cmath>

namespace hemicube::radiosity::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two triangles of a nasty material and a black one, one band.
struct Tables : ::testing::Test {
  Tables() {
    SceneBuilder builder(1);
    const std::uint32_t grey = builder.material("red, \"shiny\"\nwall", 0.1, 1.0 / 3);
    const std::uint32_t black = builder.material("black", 0, 0);
    builder.face(grey, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.face(black, {{0, 0, 1}, {0, 1, 1}, {0.3, 0, 1}});
    builder.face(grey, {{0, 0, 2}, {3, 0, 2}, {0, 1, 2}});
    scene = builder.finish();
    patches = patches_of(scene);
    solution = solution_with(scene, patches, [](std::uint32_t patch, std::uint32_t) {
      return patch == 1 ? kNaN : 0.7 + patch;
    });
  }

  std::string table() const { return patch_table(scene, patches, solution); }

  void expect_refused(const std::string& text, const std::string& start) {
    Solution back;
    const Status status = read_patch_table(text, "p.csv", scene, patches, &back);
    EXPECT_EQ(status.code(), StatusCode::kBadScene);
    EXPECT_TRUE(status.message().starts_with(start))
        << "expected " << start << "\nactual   " << status.message();
  }

  std::string with(const std::string& from, const std::string& to) const {
    std::string text = table();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  Scene scene;
  PatchSet patches;
  Solution solution;
};

TEST_F(Tables, PatchTableHasTheDocumentedColumnsAndQuotes) {
  const std::string text = table();
  EXPECT_TRUE(text.starts_with("patch,face,parent,material,area,cx,cy,cz,nx,ny,nz,"
                               "reflectance_b0,exitance_b0,irradiance_b0,radiosity_b0\n"
                               "0,0,0,\"red, \"\"shiny\"\"\nwall\",0.5,"))
      << text;
  EXPECT_NE(text.find(",0.1,0.3333333333333333,0.7,"), std::string::npos) << text;
  EXPECT_NE(text.find(",0,0,,0\n"), std::string::npos) << "an unknown irradiance is empty\n"
                                                       << text;
}

TEST_F(Tables, PatchTableReadsBackBitForBit) {
  Solution back;
  const Status status = read_patch_table(table(), "p.csv", scene, patches, &back);
  ASSERT_TRUE(status.ok()) << status.message();
  ASSERT_EQ(back.band_count, 1u);
  ASSERT_EQ(back.radiosity.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back.reflectance[i], solution.reflectance[i]);
    EXPECT_EQ(back.exitance[i], solution.exitance[i]);
    EXPECT_EQ(back.radiosity[i], solution.radiosity[i]);
    if (i == 1)
      EXPECT_TRUE(std::isnan(back.irradiance[i]));
    else
      EXPECT_EQ(back.irradiance[i], solution.irradiance[i]);
  }
}

TEST_F(Tables, PatchTableTakesWindowsLineEnds) {
  std::string text;
  for (const char c : table())
    text += c == '\n' && !text.ends_with("\"shiny\"\"") ? std::string("\r\n") : std::string(1, c);
  Solution back;
  const Status status = read_patch_table(text, "p.csv", scene, patches, &back);
  EXPECT_TRUE(status.ok()) << status.message();
}

TEST_F(Tables, PatchTableOfAnotherSceneIsRefused) {
  // The first material's name holds a line break: patch 1 begins on line 4.
  expect_refused("", "p.csv:1: the table is empty");
  expect_refused(with("reflectance_b0", "reflectance_r"),
                 "p.csv:1: column 12 is 'reflectance_r' instead of 'reflectance_b0'");
  expect_refused(with(",radiosity_b0", ""), "p.csv:1: column 15 is 'nothing' instead of");
  expect_refused(with("radiosity_b0", "radiosity_b0,more"), "p.csv:1: unexpected column 'more'");
  expect_refused(with("\n1,1,1,", "\n1,7,1,"), "p.csv:4: face is '7', in the scene it is 1");
  expect_refused(with("1,black", "1,white"), "p.csv:4: material is 'white', in the scene it is");
  expect_refused(with("black,0.15", "black,0.25"), "p.csv:4: area is '0.25', in the scene");
  expect_refused(with("0,0,,0\n", "0,0,,\n"), "p.csv:4: radiosity_b0 is '', which is out of range");
  expect_refused(with("0,0,,0\n", "0,0,,-1\n"), "p.csv:4: radiosity_b0 is '-1', which is out");
  expect_refused(with("0,0,,0\n", "2,0,,0\n"), "p.csv:4: reflectance_b0 is '2', which is out");
  expect_refused(with("0,0,,0\n", "0,0,x,0\n"), "p.csv:4: irradiance_b0 is 'x', not a number");
  expect_refused(with("0,0,,0\n", "0,0,nan,0\n"), "p.csv:4: irradiance_b0 is 'nan', which is out");
  expect_refused(with("0,0,,0\n", "0,0,0\n"), "p.csv:4: has 14 fields instead of 15");
  expect_refused(table() + table().substr(table().find('\n') + 1), "p.csv:7: more patches than");
  expect_refused(table().substr(0, table().find("\n1,1") + 1), "p.csv: ends after 1 patches");
}

TEST_F(Tables, TruncatedTablesNeverPass) {
  const std::string text = table();
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {
    Solution back;
    const Status status =
        read_patch_table(std::string_view(text).substr(0, size), "p.csv", scene, patches, &back);
    // A last number cut to a shorter one is the only loss that a cut can hide.
    EXPECT_TRUE(!status.ok() || size > text.rfind(',')) << size;
  }
}

TEST_F(Tables, GroupsAddUpPerMaterialInOrderOfAppearance) {
  const std::string text = group_table(scene, patches, solution);
  CsvReader csv(text);
  std::vector<std::string> fields;
  ASSERT_TRUE(csv.next(&fields));
  EXPECT_EQ(fields, (std::vector<std::string>{"group", "material", "patches", "area", "emitted_b0",
                                              "absorbed_b0", "received_b0"}));
  ASSERT_TRUE(csv.next(&fields));
  EXPECT_EQ(fields[0], "");
  EXPECT_EQ(fields[1], "red, \"shiny\"\nwall");
  EXPECT_EQ(fields[2], "2");
  EXPECT_EQ(fields[3], "2");
  EXPECT_NEAR(std::stod(fields[4]), 2.0 / 3, 1e-15);
  const double received = 0.5 * 0.7 + 1.5 * 2.7;
  EXPECT_NEAR(std::stod(fields[5]), 0.9 * received, 1e-14);
  EXPECT_NEAR(std::stod(fields[6]), received, 1e-14);
  ASSERT_TRUE(csv.next(&fields));
  EXPECT_EQ(fields[1], "black");
  EXPECT_EQ(fields[4], "0");
  EXPECT_EQ(fields[5], "") << "the irradiance of the black patch is not known";
  EXPECT_EQ(fields[6], "");
  EXPECT_FALSE(csv.next(&fields));
}

TEST(CsvReader, HandlesQuotesLineBreaksAndCounts) {
  CsvReader csv("a,\"b,\"\"c\nd\",\n\n\r\nlast");
  std::vector<std::string> fields;
  ASSERT_TRUE(csv.next(&fields));
  EXPECT_EQ(fields, (std::vector<std::string>{"a", "b,\"c\nd", ""}));
  EXPECT_EQ(csv.line(), 1u);
  ASSERT_TRUE(csv.next(&fields));
  EXPECT_EQ(fields, std::vector<std::string>{"last"});
  EXPECT_EQ(csv.line(), 5u);
  EXPECT_FALSE(csv.next(&fields));
}

TEST(CsvReader, AnUnclosedQuoteEnds) {
  CsvReader csv("a,\"b\nc");
  std::vector<std::string> fields;
  ASSERT_TRUE(csv.next(&fields));
  EXPECT_EQ(fields, (std::vector<std::string>{"a", "b\nc"}));
  EXPECT_FALSE(csv.next(&fields));
}

} // namespace
} // namespace hemicube::radiosity::test
