#pragma once

#include "radiosity/form_factor/balance.h"
#include "radiosity/form_factor/reciprocity.h"
#include "radiosity/form_factor/rung.h"
#include "raster/memory.h"

#include <cstdint>
#include <span>

namespace hemicube::radiosity {

/// Smallest, mean and largest of one quantity over all patches.
struct Range {
  double min = 0, mean = 0, max = 0;
};

/// A fraction that should be small: its area-independent mean over the patches, its largest value
/// and the patches that have most of it.
struct WorstFraction {
  static constexpr std::uint64_t kListed = 10;
  /// Less of a view is what rounding leaves of backs in the receiver's own plane.
  static constexpr double kRounding = 1e-12;
  struct Patch {
    std::uint32_t patch = 0;
    double fraction = 0;
  };

  double mean = 0, max = 0;
  std::uint32_t worst_patch = 0; ///< the lowest that has the largest value
  std::uint64_t count = 0;       ///< patches whose fraction is above kRounding
  Patch worst[kListed];          ///< the first of them: most first, of equal ones the lower patch

  std::span<const Patch> listed() const noexcept {
    return {worst, static_cast<std::size_t>(count < kListed ? count : kListed)};
  }
};

/// Power in W, one band.
struct EnergyBalance {
  double emitted = 0;   ///< sum A E, plus what space sends in
  double absorbed = 0;  ///< sum A (1 - rho) H
  double back_side = 0; ///< sum A b B: sent to back sides, lost
  double escaped = 0;   ///< sum A s B: sent to space, lost
  double cut = 0;       ///< shooting without a matrix: more than a patch can receive, dropped
  double unshot = 0;    ///< shooting without a matrix: sum A (unshot B)
  double imbalance = 0; ///< (emitted - all that follow it) / emitted; 0 if nothing is emitted
};

/// The error report of a run; `result` of report.json. Bit-equal for every thread count,
/// instruction set, compiler and optimisation level.
struct Certificate {
  std::uint64_t patches = 0;
  std::uint64_t hemicubes = 0;        ///< rendered, for black patches too
  std::uint64_t nonzeros = 0;         ///< entries of all rows
  std::uint64_t subpixel_patches = 0; ///< entries of patches that own no pixel of the item buffer

  Range row_sum_raw, row_sum; ///< before and after closure
  WorstFraction space, back_side;

  RungSetting setting; ///< what was asked for or chosen
  bool has_form_factor_error = false, has_radiosity_error = false;
  double form_factor_error = 0; ///< estimate: RMS error of F over all pairs over the RMS of F
  double radiosity_error = 0;   ///< estimate: RMS error of B over its RMS, area-weighted

  bool has_reciprocity = false; ///< all patches have a row, or those that reflect
  Reciprocity reciprocity;
  bool balanced = false; ///< the two fields below are filled, and the form factors are changed
  Reciprocity reciprocity_raw; ///< before
  BalanceReport balance;

  bool solved = false; ///< the fields below are filled
  const char* solver = "";
  bool has_residual = false; ///< residual and estimated error are known: there is a matrix
  bool has_shots = false;    ///< the three below are filled
  std::uint64_t shots = 0;
  double unshot = 0; ///< unshot power over emitted power
  double unshot_bound =
      0; ///< on what unshot light can still add to sum A B, relative; infinity if none is known
  double residual = 0; ///< max|E + rho H - B| / max|B|
  double estimated_error =
      0; ///< bound on the relative error of B from the residual; infinity if none is known
  std::uint64_t sweeps = 0;
  bool converged = false;
  bool rounding_floor = false;  ///< converged because rounding allows no smaller residual
  Buffer<EnergyBalance> energy; ///< [band]; empty without the irradiance of black patches

  std::uint64_t scene_hash = 0, form_factor_hash = 0, radiosity_hash = 0;
  bool has_item_hash = false;
  std::uint64_t item_hash = 0; ///< of all item buffers, with --hash-items only
};

/// How a run went; `run` of report.json. Differs from run to run.
struct RunReport {
  const char* isa = "";
  std::uint32_t threads = 0;
  double read_seconds = 0, mesh_seconds = 0;
  double build_seconds = 0;       ///< from the mesh to the first row: what all rows share
  double form_factor_seconds = 0; ///< of rows alone
  double balance_seconds = 0;     ///< reciprocity before included
  double solve_seconds = 0, write_seconds = 0;
  std::uint64_t peak_memory_bytes = 0;
  std::uint64_t rows_resumed = 0; ///< that were there and not computed
};

} // namespace hemicube::radiosity
