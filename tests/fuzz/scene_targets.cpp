// Bytes as scene files: each format with the other files that it names beside it.

#include "radiosity/mesh/build_patches.h"
#include "radiosity/scene/read_scene.h"
#include "tests/fuzz/target.h"
#include "tests/support/scene_checks.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace hemicube::test {
namespace {

namespace fs = std::filesystem;

/// A folder for the files of this process, with what cases may name.
class Folder {
public:
  Folder() : path_(fs::temp_directory_path() / ("hemicube_fuzz_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
    write("m.mtl", "newmtl red\nKd 0.5 0.25 1\nnewmtl lamp\nKe 10\nKd 0.1\n");
    write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.001 1 1.5\nusemtl red\n"
                   "f 1 2 3\nusemtl lamp\nf 1 2 3 4\n");
    write("uses_a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"
                        "usemtl lamp\nf 3 2 1\n");
    write("m.bin", std::string(64, '\0'));
  }
  Folder(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  std::string path(std::string_view name) const { return path_ / name; }

  void write(std::string_view name, std::string_view bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

private:
  fs::path path_;
};

const Folder& folder() {
  static const Folder folder;
  return folder;
}

/// One line that begins with the name of a file, and holds nothing that a terminal would obey.
bool is_message(std::string_view text) {
  const bool is_plain = std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  const std::string start = folder().path("");
  return is_plain && text.starts_with(start) && text.find(": ", start.size()) != text.npos;
}

/// Reads what is there, and makes patches of it.
Verdict judge(std::string_view name) {
  radiosity::Scene scene;
  radiosity::ReadReport read_report;
  const Status read = radiosity::read_scene(folder().path(name), &scene, &read_report);
  if (!read.ok())
    return {read.code() == StatusCode::kBadScene && is_message(read.message())
                ? ""
                : "message: " + std::string(read.message()),
            false};
  const std::string unsound = scene_problem(scene);
  if (!unsound.empty())
    return {"scene: " + unsound};
  radiosity::PatchSet patches;
  radiosity::MeshReport mesh_report;
  Status meshed = radiosity::build_patches(scene, &patches, &mesh_report);
  if (meshed.ok())
    meshed = radiosity::add_back_sides(scene, &patches);
  if (!meshed.ok())
    return {meshed.code() == StatusCode::kBadScene && !meshed.message().empty()
                ? ""
                : "mesh: " + std::string(meshed.message())};
  const std::string bad = mesh_problem(scene, patches);
  return {bad.empty() ? "" : "patches: " + bad};
}

std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Verdict judge(std::string_view name, Bytes bytes) {
  folder().write(name, text_of(bytes));
  return judge(name);
}

} // namespace

Verdict judge_obj(Bytes bytes) {
  return judge("a.obj", bytes);
}

/// A library beside an OBJ file that uses two of its materials.
Verdict judge_mtl(Bytes bytes) {
  folder().write("a.mtl", text_of(bytes));
  return judge("uses_a.obj");
}

Verdict judge_json(Bytes bytes) {
  return judge("a.json", bytes);
}
Verdict judge_ply(Bytes bytes) {
  return judge("a.ply", bytes);
}
Verdict judge_off(Bytes bytes) {
  return judge("a.off", bytes);
}
Verdict judge_stl(Bytes bytes) {
  return judge("a.stl", bytes);
}
Verdict judge_gltf(Bytes bytes) {
  return judge("a.gltf", bytes);
}
Verdict judge_glb(Bytes bytes) {
  return judge("a.glb", bytes);
}

} // namespace hemicube::test
