#pragma once

#include <cstddef>

/// What the values of an image are.
enum HemicubePixels {
  kHemicubeBytes,  ///< uint8_t, sRGB
  kHemicubeFloats, ///< float, linear
  kHemicubeIds     ///< uint32_t: numbers that say which, in a channel "id"
};

/// Takes the bytes of an image file, all at once.
using HemicubeImageSink = void (*)(void* context, const void* bytes, std::size_t size);

/// The one function of the plug-in hemicube_image_oiio.so, the only part of the program that links
/// OpenImageIO. Encodes an image in the format its name's extension says, into memory: OpenImageIO
/// does not notice a full disk. Rows from the top.
/// @param channels     values a pixel; 3 = red, green, blue
/// @param pixels       [height][width][channels]
/// @param description  stored in the file where the format can
/// @param sink         called once, with context, if all went well
/// @param error        receives a message of at most error_size bytes, zero-terminated
/// @return 0, or 1 on an error
extern "C" __attribute__((visibility("default"))) int
hemicube_encode_image(const char* name, int width, int height, int channels, HemicubePixels kind,
                      const void* pixels, const char* description, HemicubeImageSink sink,
                      void* context, char* error, std::size_t error_size);
