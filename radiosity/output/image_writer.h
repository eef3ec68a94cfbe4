#pragma once

#include "radiosity/output/file_set.h"
#include "radiosity/output/patch_id_picture.h"
#include "radiosity/output/picture.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity {

/// What an image format holds: linear radiance as floats, or display colours of 8 bit.
enum class ImageKind { kLinear, kDisplay };

/// The kind of an image by its extension: exr and hdr are linear; png, jpg, jpeg, tif, tiff, bmp,
/// tga and ppm are for display.
/// @return kInvalidArgument for any other extension, naming it
Result<ImageKind> image_kind(std::string_view name);

/// Loads the plug-in that writes images, at the first call: from beside the program, from
/// ../lib/hemicube there, from the folder it was installed to, then from the loader's search path.
/// @return kIo, saying where it was searched
Status load_image_plugin();

/// The same from a list of paths.
Status load_image_plugin_from(const std::vector<std::string>& paths);

/// Writes a picture in the format of the name's extension; a display format applies the exposure
/// and the sRGB curve.
Status write_picture(FileSet* files, std::string_view name, const Picture& picture,
                     double exposure);

/// A picture in display colours.
/// @return kOutOfMemory
Status tone_image(const Picture& picture, const Tone& tone, ColorImage* image);

/// Writes display colours.
Status write_display_image(FileSet* files, std::string_view name, const ColorImage& image);

/// Writes which patches are seen: into a display format by their colours, into .exr the numbers, a
/// 32-bit channel "id".
Status write_patch_ids(FileSet* files, std::string_view name, const PatchIdPicture& picture);

} // namespace hemicube::radiosity
