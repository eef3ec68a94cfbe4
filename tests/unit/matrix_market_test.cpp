#include "radiosity/output/matrix_market.h"

#include "tests/unit/output_support.h"

#include <charconv>
#include <sstream>

namespace hemicube::radiosity::test {
namespace {

/// Three patches; row 0 sees patches 1 and 2, row 1 nothing, row 2 patch 0.
struct MatrixMarketTest : OutputFolder {
  MatrixMarketTest() {
    SceneBuilder builder(1);
    const std::uint32_t grey = builder.material("grey", 0.5, 0);
    for (const double z : {0.0, 1.0, 2.0})
      builder.face(grey, {{0, 0, z}, {1 + z, 0, z}, {0, 1, z}});
    patches = patches_of(builder.finish());
  }

  void fill(std::uint64_t rows) {
    require(matrix.init(rows, 3));
    const std::uint32_t columns[] = {1, 2, 0};
    const float values[] = {0.1f, 0.25f, 3};
    RowView row;
    row.columns = std::span(columns).first(2);
    row.values = std::span(values).first(2);
    row.scale = 1.0 / 3;
    row.space = 0.5;
    row.back_side = 0.125;
    require(matrix.append_row(0, row));
    if (rows == 3)
      require(matrix.append_row(0, {}));
    row.columns = std::span(columns).last(1);
    row.values = std::span(values).last(1);
    require(matrix.append_row(0, row));
  }

  /// The lines after the comments.
  std::vector<std::string> body(const std::string& name) {
    std::istringstream stream(read(path(name)));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
      if (!line.starts_with('%'))
        lines.push_back(line);
    return lines;
  }

  static double number(const std::string& line) {
    double value = 0;
    std::from_chars(line.data() + line.rfind(' ') + 1, line.data() + line.size(), value);
    return value;
  }

  PatchSet patches;
  FormFactorMatrix matrix;
  FileSet files;
};

TEST_F(MatrixMarketTest, AllRows) {
  fill(3);
  require(files.begin(folder_.string()));
  require(write_matrix_market(&files, "F.mtx", matrix, patches, {}));
  require(files.commit());
  EXPECT_TRUE(read(path("F.mtx")).starts_with("%%MatrixMarket matrix coordinate real general\n%"));
  const auto lines = body("F.mtx");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "3 3 3");
  EXPECT_TRUE(lines[1].starts_with("1 2 ")) << lines[1];
  EXPECT_EQ(number(lines[1]), 1.0 / 3 * static_cast<double>(0.1f)) << "round trip";
  EXPECT_TRUE(lines[2].starts_with("1 3 ")) << lines[2];
  EXPECT_EQ(lines[3], "3 1 1");
  const auto rows = body("F.rows.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], "patch,area,row_sum,space,back_side");
  EXPECT_TRUE(rows[1].starts_with("0,0.5,0.1166666")) << rows[1];
  EXPECT_TRUE(rows[1].ends_with(",0.5,0.125")) << rows[1];
  EXPECT_TRUE(rows[3].starts_with("2,1.5,1,")) << rows[3];
}

TEST_F(MatrixMarketTest, SomeRowsKeepThePatchNumbers) {
  fill(2);
  require(files.begin(folder_.string()));
  const std::uint32_t rows[] = {2, 1};
  require(write_matrix_market(&files, "part.mtx", matrix, patches, rows));
  require(files.commit());
  const auto lines = body("part.mtx");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "3 3 3");
  EXPECT_TRUE(lines[1].starts_with("3 2 ")) << lines[1];
  EXPECT_EQ(lines[3], "2 1 1");
  EXPECT_TRUE(body("part.rows.csv")[1].starts_with("2,1.5,")) << "id and area of patch 2";
}

TEST_F(MatrixMarketTest, Points) {
  fill(2);
  require(files.begin(folder_.string()));
  require(write_point_matrix_market(&files, "P", matrix));
  require(files.commit());
  EXPECT_EQ(body("P")[0], "2 3 3");
  EXPECT_EQ(body("P.rows.csv")[0], "point,row_sum,space,back_side");
  EXPECT_TRUE(body("P.rows.csv")[2].starts_with("1,1,")) << body("P.rows.csv")[2];
}

} // namespace
} // namespace hemicube::radiosity::test
