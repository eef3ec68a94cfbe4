#pragma once

#include "radiosity/radiosity.h"
#include "tests/support/npy.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hemicube::bench {

/// How far a run is from the truth; what does not apply is NaN.
struct Errors {
  double rms_f = 0;      ///< RMS error of F over all pairs of patches
  double relative_f = 0; ///< the same over the RMS of F
  double relative_b = 0; ///< of B, relative, area-weighted RMS of the worst band, against
                         ///< the solution with exact form factors on the same mesh
  double relative_continuous_b = 0; ///< the same against the means of the solution without a mesh
};

/// What a run took, in seconds of the processor, and came to.
struct Run {
  double form_factor_seconds = 0; ///< set-up and rows
  double total_seconds = 0;       ///< solver included, if there is one
  std::uint64_t hash = 0;         ///< of the form factors
  Errors errors;
};

/// A mesh whose form factors or radiosities are known without this program.
class TruthCase {
public:
  enum class Kind {
    kMatrix,   ///< viewfactors/NAME.F.npy
    kScene,    ///< scenes/NAME.truth.json
    kEnclosure ///< a case of enclosures.json
  };

  /// Reads mesh and truth; throws std::runtime_error if any of it is missing or does not fit.
  TruthCase(Kind kind, const std::string& name);

  const std::string& name() const { return name_; }
  bool is_matrix() const { return kind_ == Kind::kMatrix; }
  std::uint32_t patch_count() const { return patches_.patch_count(); }

  /// Computes the form factors, and the light of a scene, on one thread.
  /// @return nothing if the rows take longer than `limit` seconds
  std::optional<Run> run(const radiosity::Options& options, double limit) const;

private:
  void read_matrix();
  void read_radiosities(const std::string& mesh, const nlohmann::json& constant_elements,
                        const nlohmann::json& continuous);
  std::optional<Run> run_matrix(const radiosity::Options& options, double limit) const;
  std::optional<Run> run_scene(const radiosity::Options& options, double limit) const;

  Kind kind_;
  std::string name_;
  radiosity::Scene scene_;
  radiosity::PatchSet patches_;
  test::SquareMatrix form_factors_;                  ///< of a matrix
  nlohmann::json constant_element_b_, continuous_b_; ///< of a scene, [patch][band]
};

/// All of them: matrices first.
std::vector<TruthCase> all_truth_cases();

} // namespace hemicube::bench
