#include "radiosity/output/ply_writer.h"

#include "radiosity/elementary.h"
#include "radiosity/output/display_bands.h"
#include "radiosity/output/file_writer.h"
#include "radiosity/output/little_endian.h"
#include "radiosity/output/number_text.h"
#include "radiosity/output/tone.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

bool is_word(std::string_view name) {
  const auto is_word_char = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_word_char);
}

std::string header(const Scene& scene, PlyColours colours, std::size_t vertex_count,
                   std::size_t face_count, bool has_large_faces) {
  bool all_words = true;
  for (std::uint32_t band = 0; band < scene.band_count(); ++band)
    all_words = all_words && is_word(scene.bands[band]);

  std::string text = "ply\nformat binary_little_endian 1.0\n"
                     "comment radiosity in W/m^2; positions in metres\n"
                     "comment red, green, blue: ";
  text += colours == PlyColours::kDisplay ? "display colours (sRGB) of the radiance"
                                          : "radiance in W/(m^2 sr), linear";
  text += "\nelement vertex ";
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
  for (const char* channel : {"red", "green", "blue"}) {
    text += colours == PlyColours::kDisplay ? "property uchar " : "property float ";
    text += channel;
    text += '\n';
  }
  text += "element face ";
  append_number(&text, face_count);
  text += has_large_faces ? "\nproperty list uint int vertex_indices\n"
                          : "\nproperty list uchar int vertex_indices\n";
  text += "property int patch\nend_header\n";
  return text;
}

} // namespace

Status write_ply(FileSet* files, std::string_view name, const Scene& scene, const PatchSet& patches,
                 const CornerVertices& vertices, PlyColours colours, double exposure) {
  bool has_large_faces = false;
  for (std::uint32_t patch = 0; patch < patches.patch_count(); ++patch)
    has_large_faces = has_large_faces || patches.corners_of(patch).size() > 255;

  FileWriter writer;
  HC_TRY(writer.open(files->path_for(name), files->shown_path(name)));
  std::string& bytes = writer.text();
  bytes += header(scene, colours, vertices.count(), patches.patch_count(), has_large_faces);

  const DisplayBands display(scene.bands);
  const SrgbEncoder encode;
  for (std::size_t vertex = 0; vertex < vertices.count(); ++vertex) {
    for (std::size_t k = 0; k < vertices.width; ++k)
      append_little_endian(&bytes, vertices.position(vertex)[k]);
    const Vec3 radiance = display(vertices.radiosity(vertex)) / kPi;
    for (int channel = 0; channel < 3; ++channel)
      if (colours == PlyColours::kDisplay)
        bytes.push_back(static_cast<char>(encode(exposure * radiance[channel])));
      else
        append_little_endian(&bytes, static_cast<float>(radiance[channel]));
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
      append_little_endian(&bytes, vertices.of_corner[corner]);
    append_little_endian(&bytes, patch);
    writer.flush_if_large();
  }
  return writer.close();
}

} // namespace hemicube::radiosity
