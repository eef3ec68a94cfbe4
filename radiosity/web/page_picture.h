#pragma once

#include "radiosity/output/tone.h"
#include "radiosity/radiosity.h"

namespace hemicube::radiosity::web {

/// Where the visitor has gone from the scene's camera.
struct Orbit {
  static constexpr std::uint32_t kFullTurn = 3600; ///< of angles: a tenth of a degree each

  std::uint32_t turn = 0; ///< about the target's vertical, counter-clockwise seen from above
  std::uint32_t tilt = 0; ///< up and over the target; kFullTurn minus what it goes down
  double distance = 1;    ///< from the target, times that of the scene's camera
};

/// The camera there; the scene's own, bit for bit, where nothing was moved.
Camera orbited(const Camera& camera, const Orbit& orbit);

/// Draws a solution in display colours.
/// @param samples  along each side of a pixel
/// @param rgba     receives [row][column][4], rows from the top
/// @return kInvalidArgument for a camera that shows nothing; kOutOfMemory
Status draw_rgba(const Scene& scene, const PatchSet& patches, const Solution& solution,
                 const Camera& camera, std::uint32_t samples, const Tone& tone,
                 Buffer<std::uint8_t>* rgba);

} // namespace hemicube::radiosity::web
