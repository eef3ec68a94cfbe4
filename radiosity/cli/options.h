#pragma once

#include "radiosity/adaptive.h"
#include "radiosity/cli/load_scene.h"
#include "radiosity/output/picture.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemicube::radiosity::cli {

/// The version of the program; the build defines it.
inline constexpr const char* kVersion = HC_VERSION;

enum class Command { kSolve, kFormFactors, kRender, kInfo, kLook, kProbe, kVerify };

/// Which rows of form factors are wanted, `--rows`.
struct RowSelection {
  std::uint64_t every = 1;           ///< 0, every, 2 every, ... if there is no list
  std::vector<std::uint32_t> listed; ///< ascending, no two the same; maybe more than there are
  bool is_all() const { return every == 1 && listed.empty(); }
};

/// `--camera-position` and its like: what takes the place of the scene's own camera.
struct CameraOptions {
  std::optional<Vec3> position, target, up;
  std::optional<double> field_of_view;        ///< degrees
  std::optional<std::uint32_t> width, height; ///< pixels

  bool is_any() const { return position || target || up || field_of_view || width || height; }
};

/// What a picture shows, and how.
struct PictureOptions {
  Quantity quantity = Quantity::kRadiance;
  bool patch_ids = false; ///< instead of a quantity
  bool flat = false;
  std::string band; ///< empty = all
  bool false_color = false;
  std::optional<std::pair<double, double>> range; ///< min < max
  bool log = false;
  std::optional<ToneCurve> tone;
  bool mesh = false;
  bool wedges = false;
  std::optional<std::uint32_t> samples; ///< along each side of a pixel
  std::uint32_t orbit = 0;              ///< frames; 0 = one picture

  std::uint32_t samples_used() const { return samples.value_or(PictureSetting::kSamples); }
};

/// `--adaptive` and what belongs to it.
struct RefinementOptions {
  bool adaptive = false;
  Refinement limits;
  const char* limit_given = nullptr; ///< an option that set one; null = none did
};

struct CheckedRun;

/// One condition of `--require` (requirements.h): a quantity and the most it may be.
struct Requirement {
  std::string_view condition; ///< its name on the command line
  std::string_view quantity;  ///< what messages call it
  double bound;
  /// Nothing if the run does not have the quantity.
  std::optional<double> (*value)(const CheckedRun& run);
  std::string (*advice)(const CheckedRun& run); ///< where it is broken, what to do; may be null
};

/// The command line, checked as far as it can be without the scene. Only the members a command has
/// are filled for it.
struct CommandLine {
  Command command = Command::kInfo;

  // All commands.
  Options options;           ///< kernels is set
  std::uint32_t threads = 0; ///< 0 = cores
  MeshOptions mesh;
  bool json = false;  ///< the report as one JSON object on stdout
  bool quiet = false; ///< no progress, warnings or summary
  std::string input;  ///< SCENE, DIR, or DIR|SCENE
  std::string output; ///< -o; empty = none

  RefinementOptions refinement;             ///< solve, render
  std::string form_factors;                 ///< solve, formfactors: a .hcf; empty = none
  std::uint64_t memory_bytes = 0;           ///< most that may be used; 0 = chosen
  bool by_group = false;                    ///< formfactors --by-group
  std::string points;                       ///< formfactors, probe; empty = rows of patches
  RowSelection rows;                        ///< formfactors --rows
  std::string scene;                        ///< render, probe; empty = none
  CameraOptions camera;                     ///< render
  PictureOptions picture;                   ///< render
  std::vector<Requirement> requirements;    ///< solve, formfactors
  double exposure = 0;                      ///< solve, render; 0 = chosen
  std::optional<std::uint32_t> patch, face; ///< look: one of them
  bool whole_row = false;                   ///< look --all
  bool all_cases = false;                   ///< verify --all
};

/// What parse_command_line leaves to do.
enum class ParseOutcome { kRun, kDone, kUsageError };

/// Reads the command line. Help and version go to stdout (kDone), what is wrong with it to stderr.
ParseOutcome parse_command_line(int argc, char** argv, CommandLine* line);

} // namespace hemicube::radiosity::cli
