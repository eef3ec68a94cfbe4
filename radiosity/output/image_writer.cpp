#include "radiosity/output/image_writer.h"

#include "radiosity/output/image_oiio.h"
#include "radiosity/output/tone.h"

#include <algorithm>
#include <array>
#include <dlfcn.h>
#include <filesystem>

namespace hemicube::radiosity {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlugin = "hemicube_image_oiio.so";

using EncodeImage = decltype(&hemicube_encode_image);
EncodeImage g_encode_image = nullptr; ///< set once the plug-in is loaded

std::vector<std::string> plugin_paths() {
  std::vector<std::string> paths;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    paths.push_back((program.parent_path() / kPlugin).string());
    paths.push_back((program.parent_path().parent_path() / "lib" / "hemicube" / kPlugin).string());
  }
#ifdef HEMICUBE_PLUGIN_DIR
  paths.push_back((fs::path(HEMICUBE_PLUGIN_DIR) / kPlugin).string());
#endif
  paths.emplace_back(kPlugin);
  return paths;
}

std::string extension_of(std::string_view name) {
  std::string extension = fs::path(name).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

const char* description(Quantity quantity) {
  switch (quantity) {
  case Quantity::kRadiance:
    return "diffuse radiosity; linear radiance B/pi in W/(m^2 sr)";
  case Quantity::kRadiosity:
    return "radiosity B in W/m^2, linear";
  case Quantity::kIrradiance:
    return "irradiance H in W/m^2, linear; what is not known is 0";
  case Quantity::kExitance:
    return "exitance E in W/m^2, linear";
  case Quantity::kError:
    return "variation of B inside a patch over the mean of B - E, linear";
  }
  return "";
}

/// @param pixels  of a kind, [height][width][3]; ids [height][width]
Status write_image(FileSet* files, std::string_view name, std::uint32_t width, std::uint32_t height,
                   HemicubePixels kind, const void* pixels, const char* description) {
  HC_TRY(load_image_plugin());
  std::array<char, 256> error{};
  std::string bytes;
  const auto take = [](void* context, const void* data, std::size_t size) {
    static_cast<std::string*>(context)->assign(static_cast<const char*>(data), size);
  };
  if (g_encode_image(std::string(name).c_str(), static_cast<int>(width), static_cast<int>(height),
                     kind == kHemicubeIds ? 1 : 3, kind, pixels, description, take, &bytes,
                     error.data(), error.size()) == 0)
    return files->add(name, bytes);
  return Status::error(StatusCode::kIo, files->shown_path(name),
                       ": cannot be written: ", error.data());
}

} // namespace

Result<ImageKind> image_kind(std::string_view name) {
  const std::string extension = extension_of(name);
  if (extension == ".exr" || extension == ".hdr")
    return ImageKind::kLinear;
  for (const char* known : {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".tga", ".ppm"})
    if (extension == known)
      return ImageKind::kDisplay;
  return Status::error(StatusCode::kInvalidArgument, name, ": '", extension,
                       "' is no known image format; use .png or .exr (or .hdr .tif .jpg .bmp .tga "
                       ".ppm)");
}

Status load_image_plugin() {
  return g_encode_image != nullptr ? Status{} : load_image_plugin_from(plugin_paths());
}

Status load_image_plugin_from(const std::vector<std::string>& paths) {
  std::string searched;
  for (const std::string& path : paths) {
    void* plugin = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (plugin != nullptr) {
      g_encode_image = reinterpret_cast<EncodeImage>(::dlsym(plugin, "hemicube_encode_image"));
      if (g_encode_image != nullptr)
        return {};
    }
    const char* reason = ::dlerror();
    std::error_code error;
    searched += searched.empty() ? "" : ", ";
    searched += path;
    if (fs::exists(path, error) && reason != nullptr) // there, but it does not load
      searched.append(" (").append(reason).append(")");
  }
  return Status::error(StatusCode::kIo, "images cannot be written: the plug-in ", kPlugin,
                       " is not there; build it by `make` with libopenimageio-dev installed; "
                       "searched: ",
                       searched);
}

Status write_picture(FileSet* files, std::string_view name, const Picture& picture,
                     double exposure) {
  const Result<ImageKind> kind = image_kind(name);
  HC_TRY(kind.status());
  if (kind.value() == ImageKind::kLinear)
    return write_image(files, name, picture.width, picture.height, kHemicubeFloats,
                       picture.rgb.data(), description(picture.quantity));
  ColorImage image;
  HC_TRY(tone_image(picture, {exposure}, &image));
  return write_display_image(files, name, image);
}

Status tone_image(const Picture& picture, const Tone& tone, ColorImage* image) {
  image->width = picture.width;
  image->height = picture.height;
  return tone_map(picture.rgb, tone, &image->rgb);
}

Status write_display_image(FileSet* files, std::string_view name, const ColorImage& image) {
  const Result<ImageKind> kind = image_kind(name);
  HC_TRY(kind.status());
  if (kind.value() != ImageKind::kDisplay)
    return Status::error(StatusCode::kInvalidArgument, name,
                         ": this picture holds display colours; use .png");
  return write_image(files, name, image.width, image.height, kHemicubeBytes, image.rgb.data(),
                     "display colours, sRGB");
}

Status write_patch_ids(FileSet* files, std::string_view name, const PatchIdPicture& picture) {
  const Result<ImageKind> kind = image_kind(name);
  HC_TRY(kind.status());
  if (kind.value() == ImageKind::kLinear)
    return write_image(files, name, picture.width, picture.height, kHemicubeIds, picture.ids.data(),
                       "numbers of patches; background 4294967295");
  ColorImage image;
  HC_TRY(patch_id_image(picture, &image));
  return write_display_image(files, name, image);
}

} // namespace hemicube::radiosity
