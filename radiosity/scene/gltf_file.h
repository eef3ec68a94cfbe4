#pragma once

#include "radiosity/scene/json_fields.h"
#include "radiosity/scene/read_report.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

/// A glTF 2.0 file, .gltf or .glb, taken apart: its JSON, the references between its parts, and the
/// bytes of its buffers. All errors are kBadScene `PATH:LINE: JSON.path: ...`, LINE being that of
/// the JSON; kIo; kOutOfMemory.
class GltfFile {
public:
  /// @param path  must outlive this
  explicit GltfFile(const std::string& path) : fields_(path) {}

  /// Reads the file. Refuses versions other than 2.0 and extensions that are required and not in
  /// `extensions`.
  Status open(std::initializer_list<std::string_view> extensions, ReadReport* report);

  const JsonFields& fields() const { return fields_; }
  const JsonValue& root() const { return root_; }

  /// An item of a top-level array, and its name in messages, as in "nodes[3]".
  struct Item {
    const JsonValue* value = nullptr;
    std::uint32_t index = 0;
    std::string what;
  };

  /// Finds what a reference names.
  /// @param reference  a JSON value that should be an index
  /// @param what       its name in messages
  /// @param table      the array that it counts in, as in "nodes"
  Status follow(const JsonValue& reference, const std::string& what, const char* table,
                Item* item) const;

  /// The number of items of a top-level array; 0 where it is missing.
  Status count(const char* table, std::size_t* count) const;

  /// A whole number >= 0 that a double holds exactly.
  Status whole_number(const JsonValue& value, const std::string& what, std::uint64_t* out) const;

  /// A member that must be there.
  Status required(const JsonValue& value, const std::string& what, const char* key,
                  const JsonValue** member) const;

  /// The bytes of a buffer, byteLength of them; loaded when first asked for, valid as long as this.
  Status buffer(const Item& item, std::string_view* bytes);

private:
  Status open_glb(std::string_view* json);
  Status check_asset() const;
  Status check_extensions(std::initializer_list<std::string_view> extensions) const;
  Status load_buffer(const Item& item, std::string* bytes);
  Status load_buffer_file(const JsonValue& uri, const std::string& what, std::string* bytes);

  const JsonFields fields_;
  ReadReport* report_ = nullptr;
  std::string bytes_; ///< of a .glb file
  std::optional<std::string_view> binary_chunk_;
  JsonValue root_;
  std::vector<std::optional<std::string>> buffers_;
};

/// Takes the bytes of a data URI: base64.
/// @return false for what is none
bool decode_data_uri(std::string_view uri, std::string* bytes);

} // namespace hemicube::radiosity
