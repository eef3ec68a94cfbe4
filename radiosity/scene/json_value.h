#pragma once

#include "raster/status.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

/// A JSON value that remembers its line, for messages.
struct JsonValue {
  enum class Kind { kNull, kBoolean, kNumber, kString, kArray, kObject };

  Kind kind = Kind::kNull;
  std::uint64_t line = 0; ///< from 1; of a member of an object, the line of its key
  bool boolean = false;
  double number = 0; ///< the nearest double, always finite
  std::string text;
  std::vector<std::string> keys; ///< of an object, in file order; no key twice
  std::vector<JsonValue> items;  ///< of an array, or of an object, one for each key

  /// The member of an object, or null.
  const JsonValue* find(std::string_view key) const;
};

/// Reads a JSON text (RFC 8259: no comments, no NaN), nested at most 64 deep.
/// @return kBadScene `PATH:LINE: ...`, also for a key given twice or a number too large for a
/// double;
///         kOutOfMemory
Status parse_json(std::string_view text, const std::string& path, JsonValue* root);

} // namespace hemicube::radiosity
