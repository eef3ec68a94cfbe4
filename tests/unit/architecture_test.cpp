// The house rules that an include can break: which room may look into which, and which files may
// use which library.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file; ///< relative to the checkout
  std::string target;
  int line;
};

/// The folders of `names` that the checkout has.
std::vector<fs::path> folders(const std::vector<const char*>& names) {
  std::vector<fs::path> found;
  for (const char* name : names)
    if (fs::is_directory(fs::path(HC_SOURCE_DIR) / name))
      found.push_back(fs::path(HC_SOURCE_DIR) / name);
  return found;
}

/// Rooms from the bottom up; a file may include its own room and those before it.
const std::vector<std::string> kRooms = {"raster/",
                                         "radiosity/parallel/",
                                         "radiosity/scene/",
                                         "radiosity/mesh/",
                                         "radiosity/hemicube/",
                                         "radiosity/form_factor/",
                                         "radiosity/discontinuity/",
                                         "radiosity/solve/",
                                         "radiosity/refine/",
                                         "radiosity/output/",
                                         "radiosity/c_api/",
                                         "radiosity/cli/",
                                         "radiosity/web/"};

/// Files directly in radiosity/: what every room may use, and the facade that stands above the
/// solver.
const std::vector<std::string> kSharedHeaders = {"radiosity/elementary.h"};
const std::vector<std::string> kFacade = {"radiosity/radiosity.h", "radiosity/light_model.h",
                                          "radiosity/row_run.h", "radiosity/shoot_scene.h"};

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

bool is_adapter(const std::string& file) {
  static const std::regex adapter(
      R"(radiosity/(adaptive|cli/|discontinuity/|refine/|web/make_page|scene/(?!scene\.h|name_table\.h|check_scene\.)|mesh/openmesh_|output/(corner_vertices|csv_reader|display_mesh|element_table|file_set|file_writer|glb_writer|group_matrix|group_table|image_|little_endian|matrix_market|number_text|patch_table|ply_writer|report_json|row_file|solution_files)).*)");
  return std::regex_match(file, adapter);
}

int rank_of(const std::string& path) {
  for (std::size_t k = 0; k < kRooms.size(); ++k)
    if (starts_with(path, kRooms[k]))
      return static_cast<int>(k);
  if (std::find(kSharedHeaders.begin(), kSharedHeaders.end(), path) != kSharedHeaders.end() ||
      path == "radiosity/elementary.cpp")
    return 1;
  // The facade uses everything up to the solver, and the certificate's struct; writers use the
  // facade.
  return static_cast<int>(std::find(kRooms.begin(), kRooms.end(), "radiosity/output/") -
                          kRooms.begin());
}

std::vector<Include> all_includes() {
  std::vector<Include> found;
  const fs::path root = HC_SOURCE_DIR;
  const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)re");
  for (const fs::path& top : folders({"raster", "radiosity"}))
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inl")
        continue;
      std::ifstream in(entry.path());
      std::string line;
      std::smatch match;
      for (int number = 1; std::getline(in, line); ++number)
        if (std::regex_match(line, match, pattern))
          found.push_back({fs::relative(entry.path(), root), match[1], number});
    }
  return found;
}

TEST(Architecture, SourcesAreFound) {
  EXPECT_GT(all_includes().size(), 50u);
}

TEST(Architecture, NoIncludeGoesUpwards) {
  for (const Include& include : all_includes()) {
    if (!starts_with(include.target, "raster/") && !starts_with(include.target, "radiosity/"))
      continue;
    // The certificate is a struct of the core that the facade fills.
    if (include.target == "radiosity/output/certificate.h")
      continue;
    EXPECT_LE(rank_of(include.target), rank_of(include.file))
        << include.file << ":" << include.line << " includes " << include.target;
  }
}

TEST(Architecture, SolversSeeAMatrixAndNoMesh) {
  for (const Include& include : all_includes())
    if (starts_with(include.file, "radiosity/solve/")) {
      EXPECT_FALSE(starts_with(include.target, "radiosity/mesh/") ||
                   starts_with(include.target, "radiosity/scene/"))
          << include.file << ":" << include.line << " includes " << include.target;
    }
}

TEST(Architecture, LibrariesStayInTheirFiles) {
  for (const Include& include : all_includes()) {
    const std::string where = include.file + ":" + std::to_string(include.line);
    if (starts_with(include.target, "glm/")) {
      EXPECT_EQ(include.file, "raster/math.h") << where;
    }
    if (starts_with(include.target, "OpenMesh/")) {
      EXPECT_TRUE(starts_with(include.file, "radiosity/mesh/openmesh_")) << where;
    }
    if (starts_with(include.target, "OpenImageIO/")) {
      EXPECT_TRUE(starts_with(include.file, "radiosity/output/image_oiio")) << where;
    }
    if (starts_with(include.target, "CLI/")) {
      EXPECT_TRUE(starts_with(include.file, "radiosity/cli/")) << where;
    }
    if (starts_with(include.target, "nlohmann/")) {
      EXPECT_TRUE(is_adapter(include.file)) << where;
    }
  }
}

TEST(Architecture, CoreNeitherPrintsNorThrowsNorGrows) {
  const std::vector<std::string> banned = {
      "cstdio", "stdio.h", "iostream",  "fstream",    "sstream",    "vector", "string",
      "map",    "memory",  "stdexcept", "filesystem", "functional", "locale", "unordered_map"};
  for (const Include& include : all_includes())
    if (!is_adapter(include.file)) {
      EXPECT_EQ(std::find(banned.begin(), banned.end(), include.target), banned.end())
          << include.file << ":" << include.line << " includes <" << include.target << ">";
    }
}

TEST(Architecture, IsaFilesIncludeOnlyTheSeam) {
  const std::vector<std::string> allowed = {"raster/kernels.h",
                                            "immintrin.h",
                                            "emmintrin.h",
                                            "arm_neon.h",
                                            "wasm_simd128.h",
                                            "radiosity/solve/row_kernels.h",
                                            "radiosity/solve/simd/ops_neon.h",
                                            "radiosity/solve/simd/ops_sse2.h",
                                            "radiosity/solve/simd/ops_wasm.h",
                                            "radiosity/solve/simd/pair_kernels.inl",
                                            "radiosity/form_factor/interleaved_sum.h",
                                            "raster/simd/kernels.inl",
                                            "raster/simd/lanes_to_front.inl",
                                            "raster/simd/ops_avx2.h",
                                            "raster/simd/ops_avx512.h",
                                            "raster/simd/ops_neon.h",
                                            "raster/simd/ops_scalar.h",
                                            "raster/simd/ops_sse41.h",
                                            "raster/simd/ops_wasm.h"};
  for (const Include& include : all_includes())
    if (starts_with(include.file, "raster/simd/kernels_") ||
        starts_with(include.file, "raster/simd/ops_") ||
        starts_with(include.file, "radiosity/solve/simd/ops_") ||
        starts_with(include.file, "radiosity/solve/simd/row_kernels_")) {
      EXPECT_NE(std::find(allowed.begin(), allowed.end(), include.target), allowed.end())
          << include.file << ":" << include.line << " includes " << include.target;
    }
}

TEST(Architecture, NoLibmTranscendentalsInTheCore) {
  const fs::path root = HC_SOURCE_DIR;
  const std::regex banned(
      R"((^|[^a-z_])(std::)?(sin|cos|tan|asin|acos|atan|atan2|exp|log|log2|log10|pow|cbrt|hypot|fma|rand)f?\()");
  for (const fs::path& top : folders({"raster", "radiosity"}))
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      const std::string file = fs::relative(entry.path(), root);
      const std::string extension = entry.path().extension();
      if ((extension != ".h" && extension != ".cpp" && extension != ".inl") || is_adapter(file))
        continue;
      std::ifstream in(entry.path());
      std::string line;
      for (int number = 1; std::getline(in, line); ++number)
        EXPECT_FALSE(std::regex_search(line.substr(0, line.find("//")), banned))
            << file << ":" << number << ": " << line;
    }
}

TEST(Architecture, FilesStayReadable) {
  const fs::path root = HC_SOURCE_DIR;
  for (const fs::path& top : folders({"raster", "radiosity", "tests", "bench"}))
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inl")
        continue;
      std::ifstream in(entry.path());
      const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
      EXPECT_LE(lines, 420) << fs::relative(entry.path(), root);
    }
}

} // namespace
