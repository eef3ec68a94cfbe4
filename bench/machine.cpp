#include "bench/machine.h"

#include <cctype>
#include <fstream>

namespace hemicube::bench {

std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  std::string name = "cpu";
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  for (char& c : name)
    c = std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(c)) : '-';
  return name;
}

} // namespace hemicube::bench
