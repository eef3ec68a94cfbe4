// Makes the page, one HTML file that needs no other: make_page MODULE.wasm SCENE SOURCES PAGE.html.
// In SOURCES/page.html each {{name}} is replaced: a file of that folder, the module, the scene as
// the program reads it, or the facts that the page shows beside its own.
#include "radiosity/cli/console.h"
#include "radiosity/cli/load_scene.h"
#include "radiosity/output/file_set.h"
#include "radiosity/output/picture.h"
#include "radiosity/parallel/thread_pool.h"
#include "radiosity/radiosity.h"
#include "radiosity/scene/text_cursor.h"
#include "radiosity/web/page_scene.h"

#include <stdexcept>
#include <string>

namespace {

using namespace hemicube;
using namespace hemicube::radiosity;

constexpr std::uint32_t kResolutions[] = {32, 64, 128, 256, 512};
constexpr std::uint32_t kFirstResolution = 128; ///< of them, the one that the page begins with

void require(const Status& status) {
  if (!status.ok())
    throw std::runtime_error(std::string(status.message()));
}

std::string contents(const std::string& path) {
  std::string bytes;
  require(read_file(path, &bytes));
  return bytes;
}

std::string base64(std::string_view bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::string_view three = bytes.substr(at, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < three.size() ? static_cast<std::uint8_t>(three[k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= three.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// What the page computes, computed here: by the functions behind `hemicube formfactors`.
std::string form_factor_hash(const PatchSet& patches, std::uint32_t resolution,
                             Executor& executor) {
  Options options;
  options.resolution = resolution;
  FormFactorMatrix matrix;
  Certificate certificate;
  require(compute_form_factors(patches, {}, options, executor, nullptr, &matrix, &certificate));
  return hex(certificate.form_factor_hash);
}

/// Of the picture of the light that the page comes to when nothing is changed.
double final_exposure(const Scene& scene, const PatchSet& patches, Executor& executor) {
  Options options;
  options.resolution = kFirstResolution;
  options.solver = SolverKind::kProgressive;
  Solution solution;
  Certificate certificate;
  require(solve_scene(scene, patches, options, executor, nullptr, &solution, &certificate));
  PictureValues values;
  require(displayed_values(patches, solution, &values));
  Picture picture;
  require(draw_picture(scene, patches, values, scene.camera, {raster::best_kernels()}, executor,
                       &picture));
  const Result<double> exposure = choose_exposure(picture);
  require(exposure.status());
  return exposure.value();
}

std::string facts(const PatchSet& patches, Executor& executor) {
  std::string text = "{\"first\": " + std::to_string(kFirstResolution) + ", \"hashes\": {";
  const char* separator = "";
  for (const std::uint32_t resolution : kResolutions) {
    text += separator + ("\"" + std::to_string(resolution) + "\": \"") +
            form_factor_hash(patches, resolution, executor) + "\"";
    separator = ", ";
  }
  return text + "}}";
}

std::string packed(const web::PageScene& page) {
  Buffer<std::byte> bytes;
  require(web::pack_page_scene(page, &bytes));
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void make_page(const std::string& module, const std::string& scene_path, const std::string& sources,
               const std::string& output) {
  cli::LoadedScene loaded;
  RunReport run;
  require(cli::load_scene(scene_path, {}, &loaded, &run));
  if (!loaded.scene.has_camera || loaded.patches.front_count != loaded.patches.patch_count())
    throw std::runtime_error(scene_path + ": the page needs a camera, and materials of one side");
  ThreadPool pool;
  require(pool.init(0));
  const std::string known = facts(loaded.patches, pool);
  web::PageScene page;
  page.exposure = final_exposure(loaded.scene, loaded.patches, pool);
  page.scene = std::move(loaded.scene);
  page.patches = std::move(loaded.patches);

  const auto part = [&](const std::string& name) {
    if (name == "module")
      return base64(contents(module));
    if (name == "scene")
      return base64(packed(page));
    return name == "facts" ? known : contents((sources + "/").append(name));
  };
  std::string html;
  const std::string form = contents(sources + "/page.html");
  for (std::size_t at = 0; at < form.size();) {
    const std::size_t open = form.find("{{", at), close = form.find("}}", open);
    html.append(form, at, open - at);
    if (close == std::string::npos)
      break;
    html += part(form.substr(open + 2, close - open - 2));
    at = close + 2;
  }
  FileSet files;
  std::string name;
  require(files.begin_file(output, &name));
  require(files.add(name, html));
  require(files.commit());
  cli::print(cli::concat(output, ": ", html.size(), " bytes\n"));
}

} // namespace

int main(int count, char** words) {
  if (count != 5) {
    cli::print_message("usage: make_page MODULE.wasm SCENE SOURCES PAGE.html");
    return 2;
  }
  try {
    make_page(words[1], words[2], words[3], words[4]);
    return 0;
  } catch (const std::exception& exception) {
    cli::print_message(exception.what());
    return 1;
  }
}
