#pragma once

#include <string_view>

namespace hemicube::radiosity::cli {

/// An option of the command line as a row of a table.
template <typename Target> struct TableOption {
  const char* names;       ///< "--a", or "--a,--b" for two spellings
  const char* placeholder; ///< of its value; null = it has none
  const char* description;
  /// Takes the value. Throws BadValue.
  void (*set)(std::string_view text, Target* target);
};

} // namespace hemicube::radiosity::cli
