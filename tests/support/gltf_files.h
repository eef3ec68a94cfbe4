#pragma once

#include "tests/support/file_bytes.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace hemicube::radiosity::test {

using Json = nlohmann::ordered_json;

inline std::string base64(const std::string& bytes) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (int shift = 18; shift >= 0; shift -= 6)
      text += kDigits[bits >> shift & 63];
  }
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  return text.replace(text.size() - padding, padding, padding, '=');
}

/// A square in the plane z = 0, two triangles, red: node 0 places node 1, which has the mesh.
/// Buffer 0 is `square_bytes()`; its uri is left open.
inline Json square_gltf() {
  return Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "root", "children": [1]}, {"name": "square", "mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0, 1]}}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48},
                    {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "buffers": [{"byteLength": 60}]})");
}

inline std::string square_bytes() {
  return bytes_of({0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 2.f, 0.f, 0.f, 2.f, 0.f}) +
         bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3});
}

/// The text of a .gltf file whose buffer 0 is a data URI.
inline std::string gltf_text(Json json, const std::string& bytes) {
  json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
  return json.dump();
}

/// The bytes of a .glb file.
inline std::string glb(const Json& json, std::string bytes) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  const auto u32 = [](std::size_t n) { return bytes_of(static_cast<std::uint32_t>(n)); };
  std::string file = u32(text.size()) + "JSON" + text;
  if (!bytes.empty())
    file += u32(bytes.size()) + std::string("BIN\0", 4) + bytes;
  return "glTF" + u32(2) + u32(file.size() + 12) + file;
}

} // namespace hemicube::radiosity::test
