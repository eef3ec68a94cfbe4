// Reads what pack_scenes wrote from standard input, lights every scene with the kernels of every
// instruction set that there are here, and prints the hashes on file with the instruction sets that
// have the same. Needs the core alone, and so runs where tests and readers do not.
#include "radiosity/parallel/executor.h"
#include "raster/simd/dispatch.h"
#include "tests/golden/golden_case.h"
#include "tests/golden/packed_scene.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace hemicube;
using namespace hemicube::radiosity;

/// Best first.
std::vector<std::string> kernels_here() {
  std::vector<std::string> names;
  for (std::string_view left = raster::kernel_names(); !left.empty();) {
    const std::string_view name = left.substr(0, left.find(", "));
    left.remove_prefix(name.size() < left.size() ? name.size() + 2 : left.size());
    if (raster::kernels_by_name(name) != nullptr)
      names.emplace_back(name);
  }
  return names;
}

bool read_line(std::FILE* file, std::string* line) {
  line->clear();
  int byte = 0;
  while ((byte = std::getc(file)) != EOF && byte != '\n')
    line->push_back(static_cast<char>(byte));
  return byte != EOF;
}

/// @return what there is instead of the hashes on file, in a line of its own; "" if they are those
std::string difference(const test::GoldenCase& golden, const Scene& scene, const std::string& isa,
                       Executor& executor) {
  test::GoldenCase actual = golden;
  const Status status =
      test::compute_hashes(scene, *raster::kernels_by_name(isa), executor, &actual);
  if (!status.ok())
    return "  but " + isa + " failed: " + std::string(status.message()) + "\n";
  const std::string line = test::line_of(actual);
  return line == test::line_of(golden) ? "" : "  but " + isa + " has " + line + "\n";
}

} // namespace

int main() {
  const std::vector<std::string> isas = kernels_here();
  SerialExecutor executor; // threads are the business of golden_test
  bool all_equal = true;
  int cases = 0;
  for (std::string line; read_line(stdin, &line); ++cases) {
    const test::GoldenCase golden = test::parse_golden_case(line);
    Scene scene;
    if (!test::read_packed_scene(stdin, &scene)) {
      std::fprintf(stderr, "golden_hashes: the scene of %s is cut off\n", golden.scene.c_str());
      return EXIT_FAILURE;
    }
    std::string equal, different;
    for (const std::string& isa : isas) {
      const std::string text = difference(golden, scene, isa, executor);
      different += text;
      if (text.empty())
        equal += " " + isa;
    }
    all_equal = all_equal && different.empty();
    std::printf("%s |%s\n%s", line.c_str(), equal.c_str(), different.c_str());
    std::fflush(stdout);
  }
  return all_equal && cases != 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
