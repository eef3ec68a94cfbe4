#include "radiosity/output/ply_writer.h"

#include "radiosity/elementary.h"
#include "radiosity/output/display_bands.h"
#include "radiosity/output/file_writer.h"
#include "radiosity/output/number_text.h"
#include "radiosity/output/tone.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

namespace hemicube::radiosity {
namespace {

template <typename Unsigned> void append_little_endian(std::string* bytes, Unsigned value) {
  for (std::size_t k = 0; k < sizeof value; ++k)
    bytes->push_back(static_cast<char>(value >> (8 * k) & 0xff));
}
void append_float(std::string* bytes, float value) {
  append_little_endian(bytes, std::bit_cast<std::uint32_t>(value));
}

/// The vertices of the file: position and light of every corner, equal ones once.
struct PlyVertices {
  std::size_t width = 0;              ///< floats a vertex: x, y, z, then the bands
  std::vector<float> of_corner;       ///< [corner][width]
  std::vector<std::uint32_t> number;  ///< [corner] its vertex
  std::vector<std::uint32_t> corners; ///< [vertex] the first corner it comes from
};

PlyVertices gather_vertices(const PatchSet& patches, std::span<const float> corner_radiosity,
                            std::uint32_t band_count) {
  PlyVertices out;
  out.width = 3 + std::size_t{band_count};
  const std::size_t corner_count = patches.corners.size();
  out.of_corner.reserve(corner_count * out.width);
  for (std::size_t corner = 0; corner < corner_count; ++corner) {
    const Vec3& v = patches.vertices[patches.corners[corner]];
    for (int axis = 0; axis < 3; ++axis)
      out.of_corner.push_back(static_cast<float>(v[axis]));
    const auto light = corner_radiosity.subspan(corner * band_count, band_count);
    out.of_corner.insert(out.of_corner.end(), light.begin(), light.end());
  }

  const auto compare = [&out](std::uint32_t a, std::uint32_t b) {
    return std::memcmp(out.of_corner.data() + a * out.width, out.of_corner.data() + b * out.width,
                       out.width * sizeof(float));
  };
  std::vector<std::uint32_t> order(corner_count);
  for (std::size_t i = 0; i < corner_count; ++i)
    order[i] = static_cast<std::uint32_t>(i);
  std::sort(order.begin(), order.end(), [&compare](std::uint32_t a, std::uint32_t b) {
    const int difference = compare(a, b);
    return difference != 0 ? difference < 0 : a < b;
  });

  // First to each corner the lowest corner that equals it, then numbers in corner order.
  out.number.resize(corner_count);
  for (std::size_t i = 0; i < corner_count; ++i)
    out.number[order[i]] =
        i != 0 && compare(order[i - 1], order[i]) == 0 ? out.number[order[i - 1]] : order[i];
  for (std::uint32_t corner = 0; corner < corner_count; ++corner) {
    if (out.number[corner] == corner) {
      out.number[corner] = static_cast<std::uint32_t>(out.corners.size());
      out.corners.push_back(corner);
    } else {
      out.number[corner] = out.number[out.number[corner]];
    }
  }
  return out;
}

bool is_word(std::string_view name) {
  const auto is_word_char = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_word_char);
}

std::string header(const Scene& scene, std::size_t vertex_count, std::size_t face_count,
                   bool has_large_faces) {
  bool all_words = true;
  for (std::uint32_t band = 0; band < scene.band_count(); ++band)
    all_words = all_words && is_word(scene.bands[band]);

  std::string text = "ply\nformat binary_little_endian 1.0\n"
                     "comment radiosity in W/m^2; positions in metres\n"
                     "comment red, green, blue: display colours (sRGB) of the radiance\n"
                     "element vertex ";
  append_number(&text, vertex_count);
  text += "\nproperty float x\nproperty float y\nproperty float z\n";
  for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
    text += "property float radiosity_";
    if (all_words)
      text += scene.bands[band];
    else
      append_number(&text, band);
    text += '\n';
  }
  text += "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face ";
  append_number(&text, face_count);
  text += has_large_faces ? "\nproperty list uint int vertex_indices\n"
                          : "\nproperty list uchar int vertex_indices\n";
  text += "property int patch\nend_header\n";
  return text;
}

} // namespace

Status write_ply(FileSet* files, std::string_view name, const Scene& scene, const PatchSet& patches,
                 std::span<const float> corner_radiosity, double exposure) {
  const PlyVertices vertices = gather_vertices(patches, corner_radiosity, scene.band_count());
  bool has_large_faces = false;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    has_large_faces = has_large_faces || patches.corners_of(patch).size() > 255;

  FileWriter writer;
  HC_TRY(writer.open(files->path_for(name), files->shown_path(name)));
  std::string& bytes = writer.text();
  bytes += header(scene, vertices.corners.size(), patches.patch_count(), has_large_faces);

  const DisplayBands display(scene.bands);
  const SrgbEncoder encode;
  for (const std::uint32_t corner : vertices.corners) {
    const float* values = vertices.of_corner.data() + corner * vertices.width;
    for (std::size_t k = 0; k < vertices.width; ++k)
      append_float(&bytes, values[k]);
    const Vec3 radiance = display(values + 3) / kPi;
    for (int channel = 0; channel < 3; ++channel)
      bytes.push_back(static_cast<char>(encode(exposure * radiance[channel])));
    writer.flush_if_large();
  }
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch) {
    const std::uint32_t begin = patches.corner_offsets[patch];
    const std::uint32_t end = patches.corner_offsets[patch + 1];
    if (has_large_faces)
      append_little_endian(&bytes, end - begin);
    else
      bytes.push_back(static_cast<char>(end - begin));
    for (std::uint32_t corner = begin; corner < end; ++corner)
      append_little_endian(&bytes, vertices.number[corner]);
    append_little_endian(&bytes, patch);
    writer.flush_if_large();
  }
  return writer.close();
}

} // namespace hemicube::radiosity
