#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// Appends an integer, or a floating-point number in the shortest form that reads back the same
/// bits. Independent of the locale.
template <typename Number>
requires std::integral<Number> || std::floating_point<Number>
void append_number(std::string* text, Number value) {
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text->append(digits, end);
}

/// Appends a number as a CSV field: NaN, "not computed", is an empty field.
inline void append_csv_number(std::string* text, double value) {
  if (value == value)
    append_number(text, value);
}

/// Appends text as a CSV field, in quotes if it holds a comma, a quote or a line break (RFC 4180).
inline void append_csv_text(std::string* text, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    text->append(field);
    return;
  }
  text->push_back('"');
  for (const char c : field) {
    if (c == '"')
      text->push_back('"');
    text->push_back(c);
  }
  text->push_back('"');
}

/// A hash as 16 hexadecimal digits.
inline std::string hex(std::uint64_t hash) {
  std::string digits(16, '0');
  for (std::size_t i = 16; i-- > 0; hash >>= 4)
    digits[i] = "0123456789abcdef"[hash & 15];
  return digits;
}

} // namespace hemicube::radiosity
