#pragma once

#include "radiosity/row_run.h"
#include "radiosity/row_sample.h"

namespace hemicube::radiosity {

/// Rows that the error of all is estimated by, or all if there are not more.
inline constexpr std::uint32_t kErrorSampleRows = 64;

/// Light that is good enough to weigh the errors of rows with: what is emitted, and a mean of what
/// is reflected everywhere (the ambient term of Cohen et al. 1988).
/// @param light  out, [patch][band], W/m^2
Status guess_light(const LightProblem& problem, Buffer<double>* light);

/// The same, all bands together: what rows are told of the light (LadderSetup::light).
/// @param light  out, [patch]
Status guess_patch_light(const LightProblem& problem, Buffer<double>* light);

/// Chooses a sample for estimate_radiosity_error: by the light that patches reflect, and by how
/// wrong that may be.
/// @param doubt  [patch], RowFacts::doubt
Status choose_sample(const LightProblem& problem, std::span<const double> radiosity,
                     std::span<const double> doubt, RowSample* sample);

/// Computes the rows of some patches.
/// @param rows  out, row k belongs to patches[k]
/// @param work  RowFacts::work of all of them is added; may be null
Status compute_sampled_rows(RowGeometry* geometry, const RungSetting& setting,
                            const Options& options, Executor& executor,
                            std::span<const std::uint32_t> patches, FormFactorMatrix* rows,
                            std::uint64_t* work = nullptr);

/// Fills a sample's exact rows: with a setting that is so much finer that its error does not count
/// beside that of `setting`.
Status compute_exact_rows(RowGeometry* geometry, const RungSetting& setting, const Options& options,
                          Executor& executor, RowSample* sample);

/// The relative RMS error of B over all bands, area-weighted, that follows from what the sampled
/// rows gather too much: every other patch is given that of the nearest sampled one by number, and
/// the light that all of these make is solved for.
/// @param matrix     rows of all patches that reflect
/// @param radiosity  [patch][band] the solution of `problem` with it
Status estimate_radiosity_error(const RowSample& sample, const FormFactorMatrix& matrix,
                                const LightProblem& problem, std::span<const double> radiosity,
                                Executor& executor, double* error);

} // namespace hemicube::radiosity
