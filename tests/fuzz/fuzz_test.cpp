// The fuzzers' targets in every run of the tests: all that is in corpus/, what was found among it,
// and some hundred seeded cases. Long runs: make fuzz.

#include "tests/fuzz/raster_case.h"
#include "tests/fuzz/target.h"
#include "tests/support/file_bytes.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace hemicube::test {

static void PrintTo(const FuzzTarget& target, std::ostream* out) {
  *out << target.name;
}

namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(HC_SOURCE_DIR) / "tests" / "fuzz";

std::string bytes_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The files of a target's corpus, in the order of their names.
std::vector<fs::path> corpus_of(const FuzzTarget& target) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kFolder / "corpus" / target.name))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The words of words.dict, which libFuzzer reads too: one in quotes a line, with \xNN for bytes.
std::vector<std::string> dictionary() {
  std::vector<std::string> words;
  std::ifstream file(kFolder / "words.dict");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('"'))
      continue;
    std::string& word = words.emplace_back();
    for (std::size_t k = 1; k + 1 < line.size(); ++k) {
      if (line[k] == '\\' && line[k + 1] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(k + 2, 2), nullptr, 16));
        k += 3;
      } else {
        k += line[k] == '\\';
        word += line[k];
      }
    }
  }
  return words;
}

std::string random_bytes(std::mt19937& random) {
  std::string bytes(8 + random() % (random() % 8 == 0 ? 1500 : 200), '\0');
  for (char& byte : bytes)
    byte = static_cast<char>(random() & 0xff);
  return bytes;
}

/// @param bytes  as many as a case may have are judged
Verdict judge(const FuzzTarget& target, const std::string& bytes) {
  const std::size_t size = std::min(bytes.size(), target.most_bytes);
  return target.judge({reinterpret_cast<const std::uint8_t*>(bytes.data()), size});
}

class Fuzz : public testing::TestWithParam<FuzzTarget> {};

// Catches: what a fuzzer has found once.
TEST_P(Fuzz, CorpusIsJudgedRight) {
  int accepted = 0;
  for (const fs::path& file : corpus_of(GetParam())) {
    const Verdict verdict = judge(GetParam(), bytes_of_file(file));
    EXPECT_EQ(verdict.problem, "") << file;
    accepted += verdict.is_accepted;
  }
  EXPECT_GT(accepted, 0) << "nothing in the corpus is a sound case";
}

// Catches: whatever a fuzzer catches, in the first cases of every change.
TEST_P(Fuzz, SeededCasesAreJudgedRight) {
  const FuzzTarget& target = GetParam();
  const std::vector<std::string> words = dictionary();
  ASSERT_GT(words.size(), 20u);
  std::vector<std::string> files;
  for (const fs::path& file : corpus_of(target))
    files.push_back(bytes_of_file(file));
  std::mt19937 random(20240229);
  int accepted = 0;
  for (int k = 0; k < target.seeded_cases; ++k) {
    const std::string bytes =
        target.takes_files ? radiosity::test::mutated(
                                 files[static_cast<std::size_t>(k) % files.size()], words, random)
                           : random_bytes(random);
    const Verdict verdict = judge(target, bytes);
    ASSERT_EQ(verdict.problem, "") << "case " << k << ":\n" << bytes;
    accepted += verdict.is_accepted;
  }
  // Else they only ever test the first check, or none.
  EXPECT_GT(accepted, target.seeded_cases / 200);
  if (target.takes_files) {
    EXPECT_LT(accepted, target.seeded_cases * 49 / 50);
  }
}

INSTANTIATE_TEST_SUITE_P(, Fuzz, testing::ValuesIn(fuzz_targets().begin(), fuzz_targets().end()),
                         [](const auto& made) { return std::string(made.param.name); });

// Catches: a crash, or a loop without end, on numbers that no reader lets through: they need not be
// drawn well, but must not take the program down.
TEST(RasterFuzz, ImpossibleNumbersDoNoHarm) {
  const double numbers[] = {1e200, -1e308, HUGE_VAL, -HUGE_VAL, NAN, 5e-324, 0x1p100, 0};
  std::mt19937 engine(20240301);
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const std::string bytes = random_bytes(engine);
    RasterFuzzCase fuzz =
        decode_raster_case({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    Random random(seed);
    for (Vec3& vertex : fuzz.polygons.vertices)
      if (random.index(4) == 0)
        vertex[static_cast<int>(random.index(3))] = numbers[random.index(8)];
    if (seed % 4 == 0)
      fuzz.look.view.eye.x = numbers[random.index(8)];
    for (const std::string& isa : kernels_here()) {
      Drawer drawer(fuzz.polygons.view(), *raster::kernels_by_name(isa));
      draw_look(&drawer, fuzz.look);
    }
  }
}

} // namespace
} // namespace hemicube::test
