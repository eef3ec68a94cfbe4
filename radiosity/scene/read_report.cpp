#include "radiosity/scene/read_report.h"

#include "radiosity/scene/float_grid.h"

#include <algorithm>

namespace hemicube::radiosity {

void ReadReport::add_file(const std::string& path) {
  if (std::find(files.begin(), files.end(), path) == files.end())
    files.push_back(path);
}

void ReadReport::add_float_grid(std::span<const Vec3> vertices) {
  float_grid_step = std::max(float_grid_step, radiosity::float_grid_step(vertices));
}

void KeywordCounts::count(std::string_view keyword, std::uint64_t times) {
  const auto entry = counts_.find(keyword);
  if (entry == counts_.end())
    counts_.emplace(keyword, times);
  else
    entry->second += times;
}

void KeywordCounts::add_to(ReadReport* report,
                           std::string_view (*meaning)(std::string_view keyword)) const {
  constexpr std::size_t kLongest = 32;
  for (const auto& [keyword, count] : counts_) {
    std::string printable = keyword.substr(0, kLongest);
    for (char& c : printable)
      if (c <= ' ' || c > '~')
        c = '?';
    report->skipped[std::string(meaning(keyword)) + " (" + printable + ")"] += count;
  }
}

} // namespace hemicube::radiosity
