#include "radiosity/scene/ply_reader.h"

#include "tests/support/file_bytes.h"
#include "tests/support/scene_files.h"

namespace hemicube::radiosity::test {
namespace {

const std::string kVertexHeader = "property float x\nproperty float y\nproperty float z\n";

/// The header of a file of `vertices` vertices and `faces` faces.
std::string header(const std::string& format, int vertices, int faces,
                   const std::string& vertex = kVertexHeader,
                   const std::string& face = "property list uchar int vertex_indices\n") {
  return "ply\nformat " + format + " 1.0\ncomment made by a test\nelement vertex " +
         std::to_string(vertices) + "\n" + vertex + "element face " + std::to_string(faces) + "\n" +
         face + "end_header\n";
}

const std::string kTextBody = "0 0 0\n1 0 0\n1 1 0\n0 1.25 0\n-1 0.5 0\n3 0 1 2\n4 3 2 1 0\n"
                              "5 0 1 2 3 4\n";
const std::string kText = header("ascii", 5, 3) + kTextBody;

/// The same mesh, binary, with any types: `coordinate`, `count` and `index` write a number.
template <typename Coordinate, typename Count, typename Index>
std::string binary(std::endian order, const std::string& coordinate, const std::string& count,
                   const std::string& index) {
  const std::string format =
      order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
  std::string bytes = header(format, 5, 3,
                             "property " + coordinate + " x\nproperty " + coordinate +
                                 " y\nproperty " + coordinate + " z\n",
                             "property list " + count + " " + index + " vertex_index\n");
  const double xyz[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 2, 0}, {-1, 1, 0}};
  for (const auto& vertex : xyz)
    for (const double value : vertex)
      bytes += bytes_of(static_cast<Coordinate>(value), order);
  const std::vector<std::vector<int>> faces = {{0, 1, 2}, {3, 2, 1, 0}, {0, 1, 2, 3, 4}};
  for (const auto& face : faces) {
    bytes += bytes_of(static_cast<Count>(face.size()), order);
    for (const int corner : face)
      bytes += bytes_of(static_cast<Index>(corner), order);
  }
  return bytes;
}

class PlyReader : public SceneFiles {
protected:
  void expect_ply(const std::string& bytes) {
    write("a.ply", bytes);
    expect_read("a.ply");
    if (!HasFatalFailure())
      expect_scene_is_sound(scene_);
  }

  /// The bytes must be refused at a place such as ":4: " for a reason.
  void expect_error(const std::string& bytes, const std::string& place, const std::string& why) {
    SCOPED_TRACE(bytes);
    write("a.ply", bytes);
    expect_refused("a.ply", "a.ply" + place);
    EXPECT_NE(std::string(read("a.ply").message()).find(why), std::string::npos)
        << read("a.ply").message();
  }

  void expect_the_three_faces() {
    EXPECT_EQ(values_of(scene_.corner_offsets), (std::vector<std::uint64_t>{0, 3, 7, 12}));
    EXPECT_EQ(values_of(scene_.corners),
              (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1, 0, 0, 1, 2, 3, 4}));
  }
};

/// The text with one line, counted from 1, replaced.
std::string with_line(const std::string& text, int number, const std::string& line) {
  std::size_t begin = 0;
  for (int k = 1; k < number; ++k)
    begin = text.find('\n', begin) + 1;
  return text.substr(0, begin) + line + text.substr(text.find('\n', begin));
}

TEST_F(PlyReader, ReadsPolygonsOfAnySizeInFileOrder) {
  expect_ply(kText);
  expect_the_three_faces();
  EXPECT_EQ(scene_.vertices[3], Vec3(0, 1.25, 0));
  EXPECT_EQ(names_of(scene_.materials), (std::vector<std::string>{""}));
  EXPECT_EQ(names_of(scene_.groups), (std::vector<std::string>{""}));
  EXPECT_EQ(values_of(scene_.reflectance), (std::vector<double>{0.5, 0.5, 0.5}));
  EXPECT_EQ(values_of(scene_.exitance), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(report_.faces_without_material, 3u);
  EXPECT_TRUE(report_.skipped.empty());
  EXPECT_EQ(report_.files, (std::vector<std::string>{path("a.ply")}));
}

// Catches: coordinates rounded to float on the way.
TEST_F(PlyReader, DecimalsAreTheNearestDoubles) {
  expect_ply(with_line(kText, 11, "0.1 1e-310 123456789.123456789"));
  EXPECT_EQ(scene_.vertices[0], Vec3(0.1, 1e-310, 123456789.123456789));
}

// Catches: a type read with the width or byte order of another; doubles read as floats.
TEST_F(PlyReader, BinaryFilesOfAllTypesAndBothByteOrdersHoldTheSameMesh) {
  for (const std::endian order : {std::endian::little, std::endian::big})
    for (const std::string& bytes :
         {binary<float, std::uint8_t, std::int32_t>(order, "float", "uchar", "int"),
          binary<double, std::int32_t, std::uint32_t>(order, "double", "int", "uint"),
          binary<std::int8_t, std::int8_t, std::uint16_t>(order, "char", "int8", "ushort"),
          binary<std::int16_t, std::uint16_t, std::int16_t>(order, "int16", "uint16", "short"),
          binary<std::int32_t, std::int16_t, std::uint8_t>(order, "int32", "int16", "uint8"),
          binary<float, std::uint32_t, std::int8_t>(order, "float32", "uint32", "int8")}) {
      SCOPED_TRACE(bytes);
      expect_ply(bytes);
      expect_the_three_faces();
      EXPECT_EQ(scene_.vertices[3], Vec3(0, 2, 0));
      EXPECT_EQ(scene_.vertices[4], Vec3(-1, 1, 0));
    }
}

// Catches: an unsigned number read as a negative one, and the reverse.
TEST_F(PlyReader, IntegersKeepTheirSigns) {
  const auto expect_first = [&](const std::string& type, const std::string& value, double x) {
    std::string bytes = header("binary_little_endian", 3, 1,
                               "property " + type + " x\nproperty float y\nproperty float z\n");
    const std::string zero(value.size(), '\0');
    bytes += value + bytes_of({0.f, 0.f}) + zero + bytes_of({1.f, 0.f}) + zero +
             bytes_of({0.f, 1.f}) + bytes_of(std::uint8_t{3}) + bytes_of({0, 1, 2});
    expect_ply(bytes);
    EXPECT_EQ(scene_.vertices[0].x, x) << type;
  };
  expect_first("uchar", bytes_of(std::uint8_t{200}), 200);
  expect_first("char", bytes_of(std::int8_t{-100}), -100);
  expect_first("ushort", bytes_of(std::uint16_t{40000}), 40000);
  expect_first("short", bytes_of(std::int16_t{-20000}), -20000);
  expect_first("uint", bytes_of(std::uint32_t{3000000000}), 3e9);
  expect_first("int", bytes_of(std::int32_t{-2000000000}), -2e9);
}

TEST_F(PlyReader, DoublesKeepTheirBits) {
  std::string bytes = header("binary_little_endian", 3, 1,
                             "property double x\nproperty double y\nproperty double z\n");
  bytes += bytes_of({0.1, 1.0 / 3, -1e-300, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0});
  bytes += bytes_of(std::uint8_t{3}) + bytes_of({0, 1, 2});
  expect_ply(bytes);
  EXPECT_EQ(scene_.vertices[0], Vec3(0.1, 1.0 / 3, -1e-300));
}

// Catches: values taken for indices because of what stands before them; a list skipped as a number.
TEST_F(PlyReader, OtherPropertiesAndElementsAreReadOverAndCounted) {
  const std::string vertex = "property list uchar float weights\n" + kVertexHeader +
                             "property uchar red\nproperty double quality\n";
  const std::string face = "property list uchar float texcoord\nproperty ushort flags\n"
                           "property list uchar int vertex_indices\nproperty int material\n";
  std::string text = header("ascii", 3, 1, vertex, face);
  text.insert(text.find("element face"), "element edge 2\nproperty int vertex1\n");
  expect_ply(text + "0 0 0 0 255 nan\n2 0.5 0.5 1 0 0 0 inf\n1 9 0 1 0 7 x\n0\n1\n"
                    "2 0.5 0.5 8 3 0 1 2 9\n");
  const std::map<std::string, std::uint64_t> skipped = {
      {"face properties (flags)", 1},     {"face properties (material)", 1},
      {"face properties (texcoord)", 1},  {"other elements (edge)", 2},
      {"vertex properties (quality)", 3}, {"vertex properties (red)", 3},
      {"vertex properties (weights)", 3}};
  EXPECT_EQ(report_.skipped, skipped);
  EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{0, 1, 2}));

  std::string bytes = text;
  bytes.replace(bytes.find("ascii"), 5, "binary_little_endian");
  for (const float x : {0.0f, 1.0f, 2.0f}) {
    bytes += bytes_of(std::uint8_t{2}) + bytes_of({7.0f, 8.0f});
    bytes += bytes_of({x, x * x, 0.0f}) + "r" + bytes_of(0.25);
  }
  bytes += bytes_of({5, 6}) + bytes_of(std::uint8_t{1}) + bytes_of({9.0f});
  bytes +=
      bytes_of(std::uint16_t{3}) + bytes_of(std::uint8_t{3}) + bytes_of({2, 1, 0}) + bytes_of(4);
  expect_ply(bytes);
  EXPECT_EQ(report_.skipped, skipped);
  EXPECT_EQ(values_of(scene_.corners), (std::vector<std::uint32_t>{2, 1, 0}));
  ASSERT_EQ(scene_.vertices.size(), 3u);
  EXPECT_EQ(scene_.vertices[2], Vec3(2, 4, 0));
}

TEST_F(PlyReader, FacesMayComeBeforeVertices) {
  const std::string text = "ply\nformat ascii 1.0\nelement face 1\n"
                           "property list uchar int vertex_indices\nelement vertex 3\n" +
                           kVertexHeader + "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
  expect_ply(text);
  expect_error(with_line(text, 10, "3 0 1 3"), ":10: ", "vertex index 3: the file has 3 vertices");
}

// Catches: the first value of a binary file begins with the LF of a line end that is CR alone.
TEST_F(PlyReader, LineEndsOfAllSystems) {
  const std::string bytes =
      binary<float, std::uint8_t, std::int32_t>(std::endian::little, "float", "uchar", "int");
  const std::size_t head = bytes.find("end_header\n") + 11;
  for (const std::string end : {"\r\n", "\r"}) {
    const auto with_ends = [&](std::string text) {
      for (std::size_t at = text.find('\n'); at < text.size();
           at = text.find('\n', at + end.size()))
        text.replace(at, 1, end);
      return text;
    };
    expect_ply(with_ends(bytes.substr(0, head)) + bytes.substr(head));
    expect_the_three_faces();
    expect_ply(with_ends(kText) + end + end);
    expect_the_three_faces();
  }
  std::string first = header("binary_little_endian", 3, 1) + bytes_of({0x1p-100f, 0.f, 0.f}) +
                      bytes_of({1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) + bytes_of(std::uint8_t{3}) +
                      bytes_of({0, 1, 2});
  const auto values = static_cast<std::ptrdiff_t>(first.find("end_header\n") + 11);
  std::replace(first.begin(), first.begin() + values, '\n', '\r');
  first[static_cast<std::size_t>(values)] = '\n';
  expect_ply(first);
  EXPECT_GT(scene_.vertices[0].x, 0x1p-100);
}

// Catches: faces lost or made up where header and values differ.
TEST_F(PlyReader, CountsThatAreNotThoseOfTheValuesAreRefused) {
  expect_error(header("ascii", 5, 4) + kTextBody, ": ",
               "the header says 4 x 'face', but the file ends after 3");
  expect_error(header("ascii", 5, 2) + kTextBody, ":18: ", "the file ends before this line");
  expect_error(header("ascii", 9, 3) + kTextBody, ":16: ", "more values than the properties");
  const std::string bytes =
      binary<float, std::uint8_t, std::int32_t>(std::endian::little, "float", "uchar", "int");
  expect_error(bytes + "x", ": byte " + std::to_string(bytes.size()) + ": ", "1 bytes follow");
  std::string more = bytes;
  more.replace(more.find("face 3"), 6, "face 9");
  expect_error(more, ": ", "the header says 9 x 'face', but the file ends after 3");
  expect_error(header("ascii", 5, 0) + "0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n", ": ", "no faces");
  // Counts that no memory holds, and lists of which there is nothing.
  for (const std::string count : {"4294967294", "2147483646"}) {
    const bool is_face = count[0] == '2';
    more = bytes;
    more.replace(more.find(is_face ? "face 3" : "vertex 5"), is_face ? 6 : 8,
                 (is_face ? "face " : "vertex ") + count);
    expect_error(more, ": ", "the header says " + count);
    more.replace(more.find(count), count.size(), "9999999999999");
    expect_error(more, is_face ? ":8: " : ":4: ", "9999999999999 x");
  }
  std::string list = header("binary_little_endian", 3, 1, kVertexHeader,
                            "property list uint int vertex_indices\n");
  list += std::string(36, '\0') + bytes_of(std::uint32_t{0xffffffff}) + bytes_of({0, 1, 2});
  expect_error(list, ": ", "the file ends after 0");
}

TEST_F(PlyReader, BadHeadersAreRefused) {
  const std::tuple<int, std::string, std::string> cases[] = {
      {1, "plyx", "this is no PLY file"},
      {2, "format ascii 1.1", "version '1.1' is not known"},
      {2, "format text 1.0", "format 'text' is not known"},
      {3, "format ascii 1.0", "the format is given twice"},
      {3, "elements 5", "'elements' is no statement of a PLY header"},
      {3, "property float x", "a property comes before any element"},
      {4, "element vertex -5", "element 'vertex' has no valid count: '-5'"},
      {4, "element vertex", "element 'vertex' has no valid count: ''"},
      {4, "element vertex 99999999999999999999", "has no valid count"},
      {5, "property half x", "type 'half' is not known"},
      {5, "property float", "property without a name"},
      {5, "property list float int x", "must be of an integer type"},
      {8, "element vertex 3", "element 'vertex' is declared twice, first on line 4"}};
  for (const auto& [line, text, why] : cases)
    expect_error(with_line(kText, line, text), ":" + std::to_string(line) + ": ", why);
  expect_error(with_line(kText, 2, "comment"), ":10: ", "the header has no format");
  expect_error(with_line(kText, 10, "comment"), ":11: ", "'0' is no statement");
  expect_error(kText.substr(0, kText.find("end_header")), ":9: ", "there is no end_header");
  expect_error("", ":1: ", "this is no PLY file");
  expect_error(with_line(kText, 6, "property float a"), ": ", "'vertex' lacks the property 'y'");
  expect_error(with_line(kText, 6, "property float x"), ":4: ", "property 'x' of element 'vertex'");
  expect_error(with_line(kText, 6, "property list uchar float y"), ":4: ", "not a list");
  expect_error(with_line(kText, 9, "property list uchar int strips"), ": ",
               "'face' lacks the property 'vertex_indices'");
  expect_error(with_line(kText, 9, "property int vertex_indices"), ":8: ", "a list of integers");
  expect_error(with_line(kText, 9, "property list int float vertex_index"),
               ":8: ", "a list of integers");
}

TEST_F(PlyReader, BadValuesAreRefusedWhereTheyStand) {
  const std::tuple<int, std::string, std::string> cases[] = {
      {12, "0 nan 0", "vertex coordinate 'nan' is not a finite number"},
      {12, "0 1e999 0", "vertex coordinate '1e999' is not a finite number"},
      {12, "0 a 0", "vertex coordinate 'a' is not a number"},
      {12, "0 0", "fewer values than the properties of element 'vertex'"},
      {12, "0 0 0 0", "more values than the properties of element 'vertex'"},
      {16, "3 0 1", "fewer values than the properties of element 'face'"},
      {16, "2 0 1", "a face needs 3 corners or more, this one has 2"},
      {16, "-3 0 1 2", "a list of -3 values"},
      {16, "3 0 1 5", "vertex index 5: the file has 5 vertices, counted from 0"},
      {16, "3 0 1 -1", "vertex index -1: the file has 5 vertices"},
      {16, "3 0 1 2.0", "vertex index '2.0' is not an integer"},
      {16, "3.0 0 1 2", "the length of a list '3.0' is not an integer"}};
  for (const auto& [line, text, why] : cases)
    expect_error(with_line(kText, line, text), ":" + std::to_string(line) + ": ", why);
  expect_error(kText + std::string(1, '\0'), ":19: ", "a byte of value 0");
  const std::string start = header("binary_little_endian", 3, 1);
  const std::string tail = bytes_of(std::uint8_t{3}) + bytes_of({0, 1, 2});
  expect_error(start + bytes_of({0.f, NAN}) + std::string(28, '\0') + tail,
               ": byte " + std::to_string(start.size() + 8) + ": ", "nan is not a finite number");
  expect_error(start + std::string(36, '\0') + bytes_of(std::uint8_t{3}) + bytes_of({0, 1, -1}),
               ": byte " + std::to_string(start.size() + 49) + ": ", "vertex index -1");
}

TEST_F(PlyReader, FacesThatNameAVertexTwiceKeepTheirNumbers) {
  expect_ply(with_line(kText, 16, "3 0 1 1"));
  EXPECT_EQ(scene_.face_count(), 3u);
}

} // namespace
} // namespace hemicube::radiosity::test
