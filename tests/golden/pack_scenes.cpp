// Writes the lines of hashes.txt to standard output, each followed by its scene, for golden_hashes.
#include "radiosity/scene/read_scene.h"
#include "tests/golden/golden_file.h"
#include "tests/golden/packed_scene.h"

#include <cstdio>

int main() {
  using namespace hemicube;
  using namespace hemicube::radiosity;
  for (const test::GoldenCase& golden : test::read_golden_cases()) {
    Scene scene;
    ReadReport report;
    const Status status = read_scene(HC_SOURCE_DIR "/" + golden.scene_file(), &scene, &report);
    if (!status.ok()) {
      std::fprintf(stderr, "pack_scenes: %s\n", std::string(status.message()).c_str());
      return 1;
    }
    if (std::printf("%s\n", test::line_of(golden).c_str()) < 0 ||
        !test::write_packed_scene(scene, stdout)) {
      std::fprintf(stderr, "pack_scenes: writing failed\n");
      return 1;
    }
  }
  return 0;
}
