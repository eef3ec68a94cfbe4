#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/form_factor/rung.h"
#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/certificate.h"
#include "radiosity/parallel/executor.h"
#include "radiosity/scene/scene.h"
#include "raster/simd/dispatch.h"

namespace hemicube::radiosity {

/// Where a run keeps rows besides memory: so that a run that was killed goes on where it was, and
/// form factors need not fit into memory. Files may be null; they are the caller's, and begun anew
/// where they hold something else (form_factor/matrix_file.h).
struct RunFiles {
  ByteFile* rows = nullptr;
  ByteFile* pairs = nullptr;      ///< what pairs of patches exchange, for rungs that share it
  ByteFile* black_rows = nullptr; ///< of patches that reflect nothing, which `rows` does not hold
  bool keeps_black_rows = false;  ///< `rows` holds them all the same, and becomes a finished .hcf
  bool rows_are_given = false;    ///< `rows` is a finished .hcf: nothing is rendered
  std::uint64_t most_bytes = RowStorage::kUnlimited; ///< of rows in memory
  std::uint64_t range_bytes = RowStorage::kRangeBytes;

  bool rows_are_finished = false; ///< out: `rows` is a finished .hcf
  std::uint64_t rows_resumed = 0; ///< out: rows that need not be computed, as they were there
};

enum class SolverKind { kGaussSeidel, kJacobi, kProgressive };
const char* solver_name(SolverKind solver) noexcept;

/// What the caller chooses. The defaults are those of the command line.
struct Options {
  Rung rung = Rung::kHemicube;
  std::uint32_t resolution = 256; ///< pixels along the hemicube's edge; even, 16..2048
  bool choose_rung = false;       ///< rung is chosen so that `error` is met
  bool choose_resolution = false; ///< the same for resolution
  /// Wanted: of a solution, the RMS error of B over its RMS, area-weighted; of form factors, the
  /// RMS error of F over all pairs over its RMS. What rung adaptive aims at in partly visible
  /// pairs, if it is asked for.
  double error = 0.01;
  bool estimate_error = false; ///< certify the error by a sample of finer rows
  double tolerance = 1e-6;     ///< on the estimated relative error of B
  std::uint64_t max_sweeps = 1000000;
  /// kProgressive works on a matrix with `balance`, or where `files` give or keep all rows; else
  /// each row is made when its patch shoots.
  SolverKind solver = SolverKind::kGaussSeidel;
  double stop_unshot = 0; ///< progressive: stop at this share of unshot light; 0: at the tolerance
                          ///< with all rows, else at 0.001
  std::uint64_t max_shots = ~std::uint64_t{0};
  std::uint64_t snapshot_every = 0; ///< shots between calls of Progress::snapshot; 0 = none
  bool black_irradiance = true;     ///< gather the irradiance of patches that reflect nothing
  bool balance =
      false; ///< make the form factors reciprocal (form_factor/balance.h); takes all rows
  bool hash_items = false;                  ///< hash every item buffer (slow)
  const raster::Kernels* kernels = nullptr; ///< instruction set; null = the best this machine has
  RunFiles* files = nullptr;                ///< null: memory alone
};

struct Solution;

/// Called from time to time, from any worker, never twice at once.
class Progress {
public:
  /// Rows are built in one loop; by solve_scene without balance in two, those of black patches
  /// after the sweeps.
  /// A loop begins and ends with a call, and there are others in between: time between two calls
  /// without a sweeps() in between was spent on rows and nothing else. The first call has
  /// done = 0, all set-up being done; the last has done = total.
  /// @param done, total  rows finished, rows in all
  /// @return false to stop the run: it then ends with kCancelled
  virtual bool rows(std::uint64_t done, std::uint64_t total) noexcept = 0;
  /// With Options::balance, called after the last row with 0 iterations, then after each, and once
  /// more when all is done.
  /// @param closure_residual  how far a row is from closing, at most
  virtual bool balancing(std::uint64_t iterations, double closure_residual) noexcept {
    static_cast<void>(iterations);
    static_cast<void>(closure_residual);
    return true;
  }
  /// Called before the first sweep, with 0, and after every few.
  /// @param error  the estimated relative error after `sweeps` sweeps
  virtual bool sweeps(std::uint64_t sweeps, double error) noexcept = 0;
  /// Progressive refinement: called before the first shot, with 0, and after each.
  /// @param unshot  unshot power over emitted power
  virtual bool shots(std::uint64_t shots, double unshot) noexcept {
    static_cast<void>(shots);
    static_cast<void>(unshot);
    return true;
  }
  /// Progressive refinement: the state after every Options::snapshot_every shots, and before the
  /// first. Of the solution reflectance, exitance, radiosity and ambient are there.
  /// @return what is not ok ends the run
  virtual Status snapshot(std::uint64_t shots, const Solution& solution) noexcept {
    static_cast<void>(shots);
    static_cast<void>(solution);
    return {};
  }

protected:
  ~Progress() = default;
};

/// Light on every patch. Arrays of doubles, [patch][band] unless said otherwise.
struct Solution {
  std::uint32_t band_count = 0;
  Buffer<double> reflectance; ///< 0..1
  Buffer<double> exitance;    ///< W/m^2
  Buffer<double> irradiance;  ///< H, W/m^2; NaN for black patches with black_irradiance off
  Buffer<double> radiosity;   ///< B, W/m^2
  Buffer<double> ambient;     ///< [band] of progressive refinement: a guess of the irradiance that
                              ///< unshot light will make, for display; not in `radiosity`. Or empty
  Buffer<double> row_sum;     ///< [patch] sum of the row of form factors; NaN: none was made
  Buffer<double> space;       ///< [patch] fraction of the hemisphere that sees space
  Buffer<double> back_side;   ///< [patch] fraction that sees back sides
};

/// Computes form factors and light on a mesh of a scene.
/// @param scene     materials, bands and space exitance; its geometry is not read
/// @param patches   the mesh (mesh/build_patches.h)
/// @param progress  may be null
/// @return kInvalidArgument (bad option), kBadScene (balance would change the form factors too
///         much; the certificate's `balance` is filled), kSingular (no solution), kNotConverged
///         (solution and certificate are filled all the same), kOutOfMemory, kCancelled
/// Deterministic: the same bits for any executor and any kernels.
Status solve_scene(const Scene& scene, const PatchSet& patches, const Options& options,
                   Executor& executor, Progress* progress, Solution* solution,
                   Certificate* certificate);

/// Computes light from form factors that are there; of `options`, those of rows do not count.
/// @param setting  how the rows were computed
/// @param rows     of all patches, in memory; changed by Options::balance and by nothing else:
///                 without it several calls may use the same at once
/// @return as solve_scene
Status solve_rows(const Scene& scene, const PatchSet& patches, const RungSetting& setting,
                  FormFactorMatrix* rows, const Options& options, Executor& executor,
                  Progress* progress, Solution* solution, Certificate* certificate);

/// Computes rows of form factors: of the listed patches, or of all if `rows` is empty.
/// @param matrix  row k belongs to patch rows[k]
/// @return kInvalidArgument (bad option, no such row, balance with a selection of rows), kBadScene
///         (as solve_scene), kOutOfMemory, kCancelled
Status compute_form_factors(const PatchSet& patches, std::span<const std::uint32_t> rows,
                            const Options& options, Executor& executor, Progress* progress,
                            FormFactorMatrix* matrix, Certificate* certificate);

/// Takes rows as they are made.
class RowSink {
public:
  /// Called from any worker, never twice at once, in no fixed order.
  /// @param row  valid until this returns
  /// @return what is not ok ends the run
  virtual Status take(std::uint64_t patch, const RowView& row) noexcept = 0;

protected:
  ~RowSink() = default;
};

/// The rows of all patches, given away one by one instead of kept: the same bits as
/// compute_form_factors. Options::files and estimate_error are not looked at, balance is refused.
Status stream_form_factors(const PatchSet& patches, const Options& options, Executor& executor,
                           Progress* progress, RowSink* sink, Certificate* certificate);

/// A place to compute a row at, with the direction it looks to.
struct Receiver {
  Vec3 position; ///< metres, as the patches
  Vec3 normal;   ///< any length > 0
};

/// Computes one row per point: the fraction of the light leaving a small receiver there that
/// arrives at each patch. Nothing is skipped but polygons edge-on to the receiver.
/// Options::balance is refused: points have no area to be reciprocal with.
Status compute_point_form_factors(const PatchSet& patches, std::span<const Receiver> points,
                                  const Options& options, Executor& executor, Progress* progress,
                                  FormFactorMatrix* matrix, Certificate* certificate);

} // namespace hemicube::radiosity
