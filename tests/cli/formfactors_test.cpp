// `hemicube formfactors`: the Matrix Market file, --rows and --points.

#include "tests/cli/cli_case.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>

namespace hemicube::test {
namespace {

using Json = nlohmann::json;

/// What a Matrix Market file of the coordinate format holds.
struct MatrixFile {
  std::size_t rows = 0, columns = 0, entries = 0;
  std::map<std::pair<std::size_t, std::size_t>, double> values; ///< counted from 1
};

MatrixFile parse_matrix(const std::string& text) {
  MatrixFile matrix;
  bool has_size = false;
  EXPECT_TRUE(text.starts_with("%%MatrixMarket matrix coordinate real general\n"));
  for (const std::string& line : lines_of(text)) {
    std::istringstream words(line);
    if (line.starts_with("%"))
      continue;
    std::size_t i = 0, j = 0;
    double value = 0;
    if (!has_size) {
      words >> matrix.rows >> matrix.columns >> matrix.entries;
      has_size = true;
    } else if (words >> i >> j >> value) {
      matrix.values[{i, j}] = value;
    } else {
      ADD_FAILURE() << line;
    }
  }
  EXPECT_EQ(matrix.values.size(), matrix.entries);
  return matrix;
}

class FormFactorsTest : public CliCase {
protected:
  std::string points(const std::string& lines) {
    return write("p.csv", "x,y,z,nx,ny,nz\n" + lines);
  }
};

TEST_F(FormFactorsTest, WritesTheMatrixAndItsRows) {
  const ProgramResult result = run(0, {"formfactors", write_room(), "-o", path("f.mtx")});
  EXPECT_EQ(new_files(), (std::set<std::string>{"f.mtx", "f.rows.csv"}));
  const MatrixFile matrix = parse_matrix(read("f.mtx"));
  EXPECT_EQ(matrix.rows, 6u);
  EXPECT_EQ(matrix.columns, 6u);
  EXPECT_EQ(matrix.entries, 30u); // every wall sees every other one
  // Opposite faces of a cube in closed form, Howell C-11: what is chosen by itself is exact where
  // that costs little.
  EXPECT_NEAR((matrix.values.at({1, 2})), 0.19982489569838738, 2e-8);
  EXPECT_EQ(column_of(read("f.rows.csv"), "patch"),
            (std::vector<std::string>{"0", "1", "2", "3", "4", "5"}));
  EXPECT_EQ(lines_of(result.out).size(), 2u) << result.out;
}

// Catches: an option that is read and not passed on, or passed on where it means nothing.
TEST_F(FormFactorsTest, BalanceIsForWholeMatrices) {
  const std::string scene = write_room(), points_file = points("0.5,0.5,0.5,0,0,1\n");
  const Json report = Json::parse(run(0, {"formfactors", scene, "--balance", "--json"}).out);
  EXPECT_LE(report["result"]["reciprocity"]["max"], 1e-6);
  EXPECT_TRUE(report["result"].contains("reciprocity_raw"));
  EXPECT_TRUE(report["result"].contains("balance"));
  EXPECT_TRUE(report["run"]["seconds"].contains("balance"));
  expect_refused(2, {"formfactors", scene, "--balance", "--rows", "1,4"}, {"all patches"});
  expect_refused(2, {"formfactors", scene, "--balance", "--points", points_file}, {"points"});
}

TEST_F(FormFactorsTest, TheReportCountsTheRows) {
  const Json report =
      Json::parse(run(0, {"formfactors", write_room(), "--rows", "1,4", "--json"}).out);
  EXPECT_EQ(report["result"]["hemicubes"], 2);
  EXPECT_EQ(report["result"]["patches"], 6);
  EXPECT_EQ(report["result"]["hashes"].value("form_factors", "").size(), 16u);
  EXPECT_NE(report["result"]["hashes"].value("scene", ""), "0000000000000000");
  EXPECT_FALSE(report["result"].contains("sweeps"));
  EXPECT_FALSE(report["run"]["seconds"].contains("solve"));
  EXPECT_EQ(new_files(), std::set<std::string>());
}

// What it takes to time rows from outside: how many, how long, on what, and which result.
TEST_F(FormFactorsTest, TheReportTellsTheTimeOfTheRows) {
  const std::string scene = write_room(),
                    points_file = points("0.5,0.5,0.5,0,0,1\n0.5,0.5,0,0,0,1\n");
  const std::vector<std::vector<std::string>> kinds = {
      {"--rows", "every:5"}, {"--rows", "0,5"}, {"--rung", "hemicube", "--points", points_file}};
  for (const std::vector<std::string>& kind : kinds) {
    std::vector<std::string> arguments = {"formfactors", scene,    "--json", "--threads",  "2",
                                          "--isa",       "scalar", "-o",     path("f.mtx")};
    arguments.insert(arguments.end(), kind.begin(), kind.end());
    const Json report = Json::parse(run(0, arguments).out);
    EXPECT_EQ(report["result"]["hemicubes"], 2) << kind.back();
    EXPECT_EQ(report["result"]["hashes"].value("form_factors", "").size(), 16u) << kind.back();
    EXPECT_EQ(report["run"]["threads"], 2) << kind.back();
    EXPECT_EQ(report["run"]["isa"], "scalar") << kind.back();
    for (const char* key : {"read", "mesh", "build", "form_factors", "write"})
      EXPECT_GT(report["run"]["seconds"].value(key, 0.0), 0.0) << kind.back() << " " << key;
  }
}

// Catches: time that is charged to two parts. The rows are most of this run.
TEST_F(FormFactorsTest, ThePartsTakeNoLongerThanTheWhole) {
  const std::string scene = write_room();
  const auto start = std::chrono::steady_clock::now();
  const Json report = Json::parse(
      run(0, {"formfactors", scene, "--json", "--max-edge", "0.25", "--resolution", "1024"}).out);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  double parts = 0;
  for (const auto& [part, seconds] : report["run"]["seconds"].items())
    parts += seconds.get<double>();
  EXPECT_LE(parts, whole.count()) << report["run"]["seconds"];
}

TEST_F(FormFactorsTest, EveryNthRowIsTheListOfThem) {
  const std::string scene = write_room();
  const auto result = [&](const std::string& rows) {
    return Json::parse(run(0, {"formfactors", scene, "--json", "--max-edge", "0.5", "--resolution",
                               "64", "--rows", rows})
                           .out)["result"];
  };
  EXPECT_EQ(result("every:7").dump(), result("0,7,14,21").dump());
  EXPECT_EQ(result("every:23").dump(), result("23,0").dump());
  EXPECT_NE(result("every:7")["hashes"], result("every:8")["hashes"]);
  // 24 patches: a step beyond the last one leaves the first.
  const std::string first = result("0").dump();
  for (const std::string step : {"24", "4294967295", "4294967296", "18446744073709551615"})
    EXPECT_EQ(result("every:" + step).dump(), first) << step;
  EXPECT_EQ(result("every:1")["hemicubes"], 24);
}

TEST_F(FormFactorsTest, SelectedRowsAreTheRowsOfTheWholeMatrix) {
  const std::string scene = write_room();
  run(0,
      {"formfactors", scene, "-o", path("all.mtx"), "--rung", "hemicube", "--resolution", "256"});
  run(0, {"formfactors", scene, "-o", path("list.mtx"), "--rows", "4,1"});
  run(0, {"formfactors", scene, "-o", path("every.mtx"), "--rows", "every:4"});
  EXPECT_EQ(column_of(read("list.rows.csv"), "patch"), (std::vector<std::string>{"1", "4"}));
  EXPECT_EQ(column_of(read("every.rows.csv"), "patch"), (std::vector<std::string>{"0", "4"}));
  const MatrixFile all = parse_matrix(read("all.mtx")), list = parse_matrix(read("list.mtx"));
  EXPECT_EQ(list.rows, 6u);
  EXPECT_EQ(list.entries, 10u);
  for (const auto& [place, value] : list.values)
    EXPECT_EQ(all.values.at(place), value) << place.first << "," << place.second;
}

TEST_F(FormFactorsTest, BadRowsAreRefused) {
  const std::string scene = write_room();
  for (const std::string rows : {"every:0", "every:", "every:x", "every:-1", "", "1,", ",1", "1,,2",
                                 "a", "1;2", "-1", "1.5", "99999999999"})
    expect_refused(2, {"formfactors", scene, "-o", path("f.mtx"), "--rows", rows},
                   {"--rows " + rows});
  for (const std::string step : {"0", "x", "", "1.5", "+2", " 2", "18446744073709551616"})
    expect_refused(2, {"formfactors", scene, "--json", "--rows", "every:" + step},
                   {"--rows every:" + step + ": must be every:N with a whole number N, 1.."});
  expect_refused(2, {"formfactors", scene, "-o", path("f.mtx"), "--rows", "3,1,3"}, {"3 twice"});
  expect_refused(2, {"formfactors", scene, "-o", path("f.mtx"), "--rows", "2,6"},
                 {"6 does not exist", "6 patches"});
}

TEST_F(FormFactorsTest, OnlyMatrixMarketIsWritten) {
  expect_refused(2, {"formfactors", write_room(), "-o", path("f.txt")}, {path("f.txt"), ".mtx"});
}

TEST_F(FormFactorsTest, AFileThatCannotBeWrittenIsFoundBeforeTheWork) {
  expect_refused(1,
                 {"formfactors", write_room(), "-o", path("room.mtl") + "/f.mtx", "--resolution",
                  "2048", "--max-edge", "0.01"},
                 {path("room.mtl")});
}

TEST_F(FormFactorsTest, PointsGetARowEach) {
  const std::string scene = write_room();
  // The centre of the floor looking up is where patch 0 has its hemicube, but it sees patch 0
  // edge-on.
  run(0, {"formfactors", scene, "-o", path("p.mtx"), "--points",
          points("0.5,0.5,0,0,0,1\r\n0.5,0.5,0.5,0,0,-2.5e0\n")});
  const MatrixFile matrix = parse_matrix(read("p.mtx"));
  EXPECT_EQ(matrix.rows, 2u);
  EXPECT_EQ(matrix.columns, 6u);
  EXPECT_NEAR((matrix.values.at({1, 2})), 0.2395, 1e-3);
  EXPECT_EQ(matrix.values.count({1, 1}), 0u);
  EXPECT_GT((matrix.values.at({2, 1})), 0.5);
  EXPECT_EQ(column_of(read("p.rows.csv"), "point"), (std::vector<std::string>{"0", "1"}));
}

TEST_F(FormFactorsTest, PointsOfASpreadsheetAreRead) {
  // A byte order mark, blanks in the header, a normal whose square is out of range.
  const std::string file =
      write("s.csv", "\xef\xbb\xbfx, y, z, nx, ny, nz\r\n0.5,0.5,0,0,0,1e-200\r\n");
  run(0, {"formfactors", write_room(), "-o", path("p.mtx"), "--points", file});
  EXPECT_NEAR((parse_matrix(read("p.mtx")).values.at({1, 2})), 0.2395, 1e-3);
}

TEST_F(FormFactorsTest, BadPointsAreRefusedWithTheirLine) {
  const std::string scene = write_room();
  const auto refused = [&](int exit, const std::string& file,
                           const std::vector<std::string>& parts) {
    expect_refused(exit, {"formfactors", scene, "-o", path("f.mtx"), "--points", file}, parts);
  };
  const std::string file = path("p.csv");
  refused(3, points("0,0,0,0,0,1\n0,0,zero,0,0,1\n"), {file + ":3:", "z is", "zero"});
  refused(3, points("0,0,0,0,0,nan\n"), {file + ":2:", "nan"});
  refused(3, points("0,0,0,0,0\n"), {file + ":2:", "5 fields"});
  refused(3, points("0,0,0,0,0,0\n"), {file + ":2:", "normal"});
  refused(3, points(""), {file, "no points"});
  refused(3, write("p.csv", "0,0,0,0,0,1\n"), {file + ":1:", "x,y,z,nx,ny,nz"});
  refused(3, write("p.csv", ""), {file + ":1:"});
  refused(3, path("nowhere.csv"), {path("nowhere.csv")});
}

TEST_F(FormFactorsTest, RowsAndPointsExcludeEachOther) {
  expect_refused(2,
                 {"formfactors", write_room(), "--rows", "1", "--points", points("0,0,0,0,0,1\n")},
                 {"--rows", "--points"});
}

TEST_F(FormFactorsTest, MaterialsAreNotNeeded) {
  const std::string scene =
      write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 0 1\n"
                        "f 1 2 3\nf 4 5 6\n");
  const ProgramResult result = run(0, {"formfactors", scene, "-o", path("f.mtx")});
  EXPECT_EQ(parse_matrix(read("f.mtx")).entries, 2u);
  EXPECT_NE(result.err.find("2 faces without a material"), std::string::npos) << result.err;
}

} // namespace
} // namespace hemicube::test
