// What JavaScript calls. One page, one scene: the state is the module's. Functions return 0, or the
// code of a Status whose text is at page_message(); pointers are offsets into the module's memory.
#include "radiosity/web/page_picture.h"
#include "radiosity/web/page_solver.h"

#include <algorithm>

#define HC_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace hemicube;
using namespace hemicube::radiosity;
using namespace hemicube::radiosity::web;

struct Module {
  Buffer<std::byte> scene;
  PageSolver solver;
  Solution shown;
  Buffer<std::uint8_t> rgba;
  char message[Status::kCapacity] = "";
};

Module& module() {
  static Module instance;
  return instance;
}

int report(const Status& status) {
  const std::string_view text = status.message();
  char* const end = std::copy(text.begin(), text.end(), module().message);
  *end = '\0';
  return static_cast<int>(status.code());
}

} // namespace

/// Room for the scene's bytes, to be filled before page_open(); 0: there is no memory.
HC_EXPORT(page_scene_bytes) void* page_scene_bytes(std::size_t size) {
  module().scene.clear();
  return module().scene.resize(size).ok() ? module().scene.data() : nullptr;
}

/// Zero-terminated: why the last call failed.
HC_EXPORT(page_message) const char* page_message() {
  return module().message;
}

HC_EXPORT(page_open) int page_open() {
  return report(module().solver.open(module().scene.span()));
}

/// All rows are to be made anew. Call page_set_light() next.
HC_EXPORT(page_set_resolution) int page_set_resolution(std::uint32_t resolution) {
  return report(module().solver.set_resolution(resolution));
}

/// Begins anew, with reflectance and light times what the scene says; rows stay.
HC_EXPORT(page_set_light) int page_set_light(double reflectance, double light) {
  return report(module().solver.set_light(reflectance, light));
}

/// One shot, if it is not converged.
HC_EXPORT(page_shoot) int page_shoot() {
  return report(module().solver.shoot());
}

/// One of the rows that no shot has needed.
HC_EXPORT(page_fill) int page_fill() {
  return report(module().solver.fill());
}

HC_EXPORT(page_is_converged) bool page_is_converged() {
  return module().solver.is_converged();
}

HC_EXPORT(page_shots) double page_shots() {
  return static_cast<double>(module().solver.shots());
}

/// Power that is not yet shot over power emitted.
HC_EXPORT(page_unshot) double page_unshot() {
  return module().solver.unshot();
}

HC_EXPORT(page_patches) std::uint32_t page_patches() {
  return module().solver.patch_count();
}

/// Rows of form factors that are there.
HC_EXPORT(page_rows) std::uint32_t page_rows() {
  return module().solver.row_count();
}

/// Of all rows, as the program prints it; 0 while some are missing.
HC_EXPORT(page_hash) std::uint64_t page_hash() {
  return module().solver.form_factor_hash();
}

HC_EXPORT(page_width) std::uint32_t page_width() {
  return module().solver.page().scene.camera.width;
}

HC_EXPORT(page_height) std::uint32_t page_height() {
  return module().solver.page().scene.camera.height;
}

/// Draws the light as it is now, for page_rgba(). @param turn, tilt, distance  see Orbit
HC_EXPORT(page_draw)
int page_draw(std::uint32_t turn, std::uint32_t tilt, double distance, std::uint32_t samples) {
  Module& m = module();
  const PageScene& page = m.solver.page();
  const Status taken = m.solver.displayed(&m.shown);
  if (!taken.ok())
    return report(taken);
  const Camera camera = orbited(page.scene.camera, {turn, tilt, distance});
  return report(
      draw_rgba(page.scene, page.patches, m.shown, camera, samples, {page.exposure}, &m.rgba));
}

/// [row][column][4] of the last page_draw(); valid until the next call.
HC_EXPORT(page_rgba) const std::uint8_t* page_rgba() {
  return module().rgba.data();
}
