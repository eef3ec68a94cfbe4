#include "radiosity/cli/console.h"

#include "raster/status.h"

#include <cstdio>

namespace hemicube::radiosity::cli {
namespace {

bool output_failed = false;

} // namespace

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
    output_failed = true;
}

bool flush_output() {
  if (std::fflush(stdout) != 0)
    output_failed = true;
  return !output_failed;
}

void print_message(std::string_view message) noexcept {
  // Without memory of its own, since that may be what the message is about.
  constexpr std::string_view kName = "hemicube: ";
  char line[kName.size() + Status::kCapacity + 1];
  std::size_t size = kName.copy(line, kName.size());
  const auto send = [&] {
    static_cast<void>(std::fwrite(line, 1, size, stderr)); // who could be told?
    size = 0;
  };
  for (const char c : message) {
    if (size + 1 == sizeof line)
      send();
    line[size++] = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  line[size++] = '\n';
  send();
}

std::string rounded(double value) {
  // Thousands in full: 6460, not 6.46e+03.
  const bool is_large = value >= 1000 && value < 1e9;
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, value,
                                 is_large ? std::chars_format::fixed : std::chars_format::general,
                                 is_large ? 0 : 3)
                       .ptr;
  return {digits, end};
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
  return concat(count, " ", count == 1 ? one : many);
}

std::string memory_text(double bytes) {
  const char* const units[] = {" bytes", " kB", " MB", " GB", " TB"};
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < std::size(units); ++unit)
    bytes /= 1000;
  return rounded(bytes) + units[unit];
}

} // namespace hemicube::radiosity::cli
