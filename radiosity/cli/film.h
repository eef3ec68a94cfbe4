#pragma once

#include "radiosity/cli/session.h"
#include "radiosity/output/color_scale.h"
#include "radiosity/output/file_set.h"

#include <string>

namespace hemicube::radiosity::cli {

/// Draws the picture of `render`, or the frames of its film: what is chosen from a picture, it
/// chooses from the first one, so that nothing flickers.
class Film {
public:
  /// @param session  begun; must outlive the film
  explicit Film(Session* session) : session_(*session), wish_(session->line.picture) {}

  /// Looks whether the scene has the band that is asked for, before the work.
  /// @return kInvalidArgument
  Status find_band();

  /// Takes on a solution, and tells what of it is not known. Not for patch ids.
  Status begin(const Solution& solution);

  /// Draws what a camera sees and writes it aside under a name.
  Status add(const Camera& camera, const std::string& name, FileSet* files);

  std::uint32_t width() const { return width_; } ///< pixels of an image, with its legend
  std::uint32_t height() const { return height_; }
  double exposure() const { return tone_.exposure; }
  const ColorScale& scale() const { return scale_; }

private:
  Status choose(const Picture& picture);

  Session& session_;
  const PictureOptions& wish_;
  PictureValues values_;
  std::uint32_t band_ = PictureSetting::kAllBands;
  bool has_chosen_ = false;
  Tone tone_;
  ColorScale scale_;
  std::uint32_t width_ = 0, height_ = 0;
};

/// The name of a frame: "film.0007.png" of "film.png".
std::string frame_name(const std::string& name, std::uint32_t frame);

} // namespace hemicube::radiosity::cli
