#pragma once

#include "tests/golden/golden_case.h"

#include <fstream>
#include <vector>

namespace hemicube::radiosity::test {

inline const std::string kGoldenFile = HC_SOURCE_DIR "/tests/golden/hashes.txt";

inline std::vector<GoldenCase> read_golden_cases() {
  std::vector<GoldenCase> cases;
  std::ifstream in(kGoldenFile);
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#')
      cases.push_back(parse_golden_case(line));
  return cases;
}

} // namespace hemicube::radiosity::test
