#pragma once

#include "radiosity/output/number_text.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace hemicube::radiosity::cli {

/// Data for stdout. A failure is remembered for flush_output().
void print(std::string_view text);

/// Sends all output on its way. @return false if any of it could not be written
bool flush_output();

/// One line `hemicube: MESSAGE` on stderr; control characters, as file names may hold, become '?'.
/// It takes no memory.
void print_message(std::string_view message) noexcept;

namespace detail {
inline void append(std::string* text, std::string_view part) {
  text->append(part);
}
inline void append(std::string* text, const char* part) {
  text->append(part);
}
template <typename Number>
requires std::integral<Number> || std::floating_point<Number>
void append(std::string* text, Number part) {
  append_number(text, part);
}
} // namespace detail

/// Text and numbers in a row; numbers in the shortest form that reads back the same.
template <typename... Parts> std::string concat(const Parts&... parts) {
  std::string text;
  (detail::append(&text, parts), ...);
  return text;
}

/// A number for reading, in three significant digits or as a whole number.
std::string rounded(double value);

/// "1 patch", "2 patches".
std::string counted(std::uint64_t count, std::string_view one, std::string_view many);

/// A size in memory, as in "12.3 MB".
std::string memory_text(double bytes);

} // namespace hemicube::radiosity::cli
