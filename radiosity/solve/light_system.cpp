#include "radiosity/solve/light_system.h"

#include "radiosity/solve/simd/dispatch.h"
#include "raster/fp_environment.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemicube::radiosity {
namespace {

/// A residual of a few units in the last place: rounding allows no smaller one.
constexpr double kRoundingFloor = 0x1p-48;
/// What is reflected is rounded by as much: a smaller residual is none that is known.
constexpr double kUnknownResidual = 0x1p-52;

/// Calls visit(row number, row, worker) for all rows of a matrix, in parallel.
template <typename Visit>
Status for_each_row(const FormFactorMatrix& matrix, Executor& executor, Visit visit) {
  return matrix.for_each_range([&](std::size_t first, std::size_t last) {
    return executor.for_each(last - first, [&](std::size_t block, std::size_t worker) {
      const FloatEnvironment environment;
      block += first;
      for (std::uint64_t i = matrix.block_begin(block); i < matrix.block_end(block); ++i)
        visit(i, matrix.row(i), worker);
      return Status();
    });
  });
}

LightSystem::InsideRange inside_range(const RowView& row, std::size_t patch) {
  const std::size_t begin = patch - patch % LightSystem::kSweepBlockRows;
  const auto first = std::lower_bound(row.columns.begin(), row.columns.end(), begin);
  const auto last =
      std::lower_bound(first, row.columns.end(), begin + LightSystem::kSweepBlockRows);
  return {static_cast<std::uint32_t>(first - row.columns.begin()),
          static_cast<std::uint32_t>(last - row.columns.begin())};
}

} // namespace

Status LightSystem::init() {
  if (!(options_.tolerance > 0))
    return Status::error(StatusCode::kInvalidArgument, "tolerance ", options_.tolerance,
                         " is not above 0");
  const std::size_t patches = problem_.patch_count(), count = patches * bands_;
  for (Buffer<double>* values : {&fixed_, &source_, &from_source_})
    HC_TRY(values->resize(count));
  HC_TRY(row_sums_.resize(patches));
  HC_TRY(inside_.resize(patches));
  HC_TRY(contraction_.resize(bands_));
  const raster::Kernels& kernels =
      options_.kernels != nullptr ? *options_.kernels : raster::best_kernels();
  HC_TRY(values_.init(patches, bands_, row_kernels(kernels.name)));
  HC_TRY(read_rows());
  for (std::size_t at = 0; at < count; ++at)
    if (reflects(at / bands_))
      source_[at] = problem_.exitance[at] + problem_.reflectance[at] * fixed_[at];
  HC_TRY(find_contraction());
  HC_TRY(gather(source_.span(), &from_source_));
  return check_solvable(matrix_, problem_, enclosures_, source_.span());
}

/// All that is to be known of rows themselves.
Status LightSystem::read_rows() {
  EnclosureFinder finder;
  HC_TRY(finder.init(problem_, executor_.worker_count()));
  Buffer<double> black;
  HC_TRY(black.resize(fixed_.size()));
  bool any_lit = false;
  for (std::size_t i = 0; i < problem_.patch_count(); ++i)
    for (std::uint32_t b = 0; b < bands_ && problem_.is_black(i); ++b) {
      black[i * bands_ + b] = problem_.exitance[i * bands_ + b];
      any_lit = any_lit || black[i * bands_ + b] > 0;
    }
  values_.fill(black.span());
  HC_TRY(for_each_row(matrix_, executor_,
                      [&](std::uint64_t i, const RowView& row, std::size_t worker) {
                        if (problem_.is_black(i))
                          return;
                        finder.add_row(worker, static_cast<std::uint32_t>(i), row);
                        inside_[i] = inside_range(row, i);
                        row_sums_[i] = row_sum(row);
                        double* const fixed = &fixed_[i * bands_];
                        if (any_lit)
                          values_.sum(row, fixed);
                        for (std::uint32_t b = 0; b < bands_; ++b)
                          fixed[b] += row.space * problem_.space_exitance[b];
                      }));
  return finder.finish(&enclosures_);
}

Status LightSystem::find_contraction() {
  Buffer<std::uint8_t> lit; // [enclosure][band]
  HC_TRY(lit.resize(enclosures_.first_patch.size() * bands_));
  const auto lit_at = [&](std::size_t patch, std::uint32_t band) -> std::uint8_t& {
    return lit[std::size_t{enclosures_.of_patch[patch]} * bands_ + band];
  };
  for (std::size_t i = 0; i < problem_.patch_count(); ++i)
    for (std::uint32_t b = 0; b < bands_ && reflects(i); ++b)
      lit_at(i, b) |= source_[i * bands_ + b] > 0;
  for (std::size_t i = 0; i < problem_.patch_count(); ++i)
    for (std::uint32_t b = 0; b < bands_ && reflects(i); ++b)
      if (lit_at(i, b) != 0)
        contraction_[b] =
            std::max(contraction_[b], problem_.reflectance[i * bands_ + b] * row_sums_[i]);
  return {};
}

Status LightSystem::gather(std::span<const double> from, Buffer<double>* into) {
  values_.fill(from);
  return for_each_row(matrix_, executor_, [&](std::uint64_t i, const RowView& row, std::size_t) {
    if (reflects(i))
      values_.sum(row, into->data() + i * bands_);
  });
}

Status LightSystem::first_guess(Buffer<double>* x) const {
  HC_TRY(x->resize(source_.size()));
  for (std::size_t at = 0; at < source_.size(); ++at) // the shape that rescaling scales
    (*x)[at] = source_[at] + problem_.reflectance[at] * from_source_[at];
  return {};
}

Status LightSystem::measure(std::span<const double> x, std::span<const double> gathered,
                            Convergence* convergence) const {
  convergence->residual = convergence->estimated_error = 0;
  for (std::uint32_t b = 0; b < bands_; ++b) {
    double largest = 0, brightest = 0, total = 0;
    for (std::size_t i = 0; i < problem_.patch_count(); ++i) {
      const std::size_t at = i * bands_ + b;
      const double radiosity = reflects(i) ? x[at] : problem_.exitance[at];
      brightest = std::max(brightest, radiosity);
      total += radiosity;
      if (reflects(i))
        largest = std::max(
            largest, std::fabs(source_[at] + problem_.reflectance[at] * gathered[at] - x[at]));
    }
    if (!std::isfinite(total) || !std::isfinite(largest))
      return Status::error(StatusCode::kBadScene, "the light is too bright to be computed: scale ",
                           "the exitances down");
    if (brightest == 0)
      continue;
    const double residual = largest / brightest;
    const double unknown = kUnknownResidual * contraction_[b];
    const double error = contraction_[b] < 1 ? std::max(residual, unknown) / (1 - contraction_[b])
                                             : std::numeric_limits<double>::infinity();
    convergence->residual = std::max(convergence->residual, residual);
    convergence->estimated_error = std::max(convergence->estimated_error, error);
  }
  convergence->rounding_floor =
      convergence->estimated_error > options_.tolerance && convergence->residual <= kRoundingFloor;
  convergence->converged =
      convergence->estimated_error <= options_.tolerance || convergence->rounding_floor;
  return {};
}

Status LightSystem::finish(std::span<const double> x, std::span<const double> gathered,
                           Buffer<double>* radiosity, Buffer<double>* irradiance) const {
  HC_TRY(radiosity->resize(source_.size()));
  HC_TRY(irradiance->resize(source_.size()));
  for (std::size_t at = 0; at < source_.size(); ++at) {
    (*radiosity)[at] = reflects(at / bands_) ? x[at] : problem_.exitance[at];
    (*irradiance)[at] = gathered[at] + fixed_[at];
  }
  return {};
}

Status LightSystem::not_converged(const Convergence& c) const noexcept {
  return Status::error(StatusCode::kNotConverged, "not converged after ", c.sweeps,
                       " sweeps: residual ", c.residual, ", estimated error ", c.estimated_error,
                       ", tolerance ", options_.tolerance);
}

} // namespace hemicube::radiosity
