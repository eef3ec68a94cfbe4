#include "radiosity/output/image_oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

/// Returns an empty string, or what went wrong.
std::string encode(const char* name, int width, int height, int channels, HemicubePixels kind,
                   const void* pixels, const char* description, std::vector<unsigned char>* bytes) {
  OIIO::attribute("threads", 1);
  const auto output = OIIO::ImageOutput::create(name);
  if (!output)
    return OIIO::geterror();
  if (!output->supports("ioproxy"))
    return "this format cannot be encoded in memory; use .png or .exr";
  const OIIO::TypeDesc type = kind == kHemicubeBytes    ? OIIO::TypeDesc::UINT8
                              : kind == kHemicubeFloats ? OIIO::TypeDesc::FLOAT
                                                        : OIIO::TypeDesc::UINT32;
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.attribute("DateTime", "2000:01:01 00:00:00"); // the same picture gives the same file
  spec.attribute("Software", "hemicube");
  spec.attribute("ImageDescription", description);
  if (kind == kHemicubeIds)
    spec.channelnames = {"id"};
  else
    spec.attribute("oiio:ColorSpace", kind == kHemicubeFloats ? "Linear" : "sRGB");
  OIIO::Filesystem::IOVecOutput memory(*bytes);
  if (!output->set_ioproxy(&memory) || !output->open(name, spec) ||
      !output->write_image(type, pixels) || !output->close())
    return output->geterror();
  return {};
}

} // namespace

int hemicube_encode_image(const char* name, int width, int height, int channels,
                          HemicubePixels kind, const void* pixels, const char* description,
                          HemicubeImageSink sink, void* context, char* error,
                          std::size_t error_size) {
  try {
    std::vector<unsigned char> bytes;
    const std::string message =
        encode(name, width, height, channels, kind, pixels, description, &bytes);
    if (message.empty()) {
      sink(context, bytes.data(), bytes.size());
      return 0;
    }
    std::snprintf(error, error_size, "%s", message.c_str());
  } catch (const std::exception& exception) {
    std::snprintf(error, error_size, "%s", exception.what());
  }
  return 1;
}
