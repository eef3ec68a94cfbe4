#include "radiosity/solve/gauss_seidel.h"

#include "radiosity/solve/enclosures.h"
#include "radiosity/solve/rescaling.h"
#include "raster/fp_environment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemicube::radiosity {
namespace {

/// Rows whose sums over their own block are taken in sequence; a multiple of kBlockRows.
constexpr std::size_t kSweepBlockRows = 256;
constexpr std::uint64_t kSweepsPerCheck = 4;

/// A residual of a few units in the last place: rounding allows no smaller one.
constexpr double kRoundingFloor = 0x1p-48;

class GaussSeidel {
public:
  GaussSeidel(const FormFactorMatrix& matrix, const LightProblem& problem,
              const SolverOptions& options, Executor& executor)
      : matrix_(matrix), problem_(problem), options_(options), executor_(executor),
        bands_(problem.band_count) {}

  Status init();
  Status sweep();
  /// Measures the residual; rescales the enclosures if it is not small enough, and measures again.
  Status check(Convergence* convergence);
  Status finish(Buffer<double>* radiosity, Buffer<double>* irradiance);

private:
  bool reflects(std::size_t patch) const {
    return enclosures_.of_patch[patch] != Enclosures::kNone;
  }
  Status gather(const Buffer<double>& from, Buffer<double>* into);
  Status gather_fixed_light();
  Status find_contraction();
  Status sum_outside(std::size_t block_begin, std::size_t block_end);
  void sweep_inside(std::size_t block_begin, std::size_t block_end);
  Status measure(Convergence* convergence) const;

  const FormFactorMatrix& matrix_;
  const LightProblem& problem_;
  const SolverOptions& options_;
  Executor& executor_;
  const std::uint32_t bands_;
  Enclosures enclosures_;
  // [patch][band]; 0 for black patches.
  Buffer<double> x_;      ///< radiosity
  Buffer<double> fixed_;  ///< irradiance from black patches and from space; also of black patches
  Buffer<double> source_; ///< E + rho * fixed
  Buffer<double> from_source_; ///< F source
  Buffer<double> gathered_;    ///< F x
  Buffer<double> outside_;     ///< [row of the block][band]
  Buffer<double> contraction_; ///< [band] max rho * row sum, of the enclosures that have light
  EnclosureRescaling rescaling_;
};

Status GaussSeidel::init() {
  const std::size_t count = problem_.patch_count() * bands_;
  HC_TRY(find_enclosures(matrix_, problem_, &enclosures_));
  for (Buffer<double>* values : {&x_, &fixed_, &source_, &from_source_, &gathered_})
    HC_TRY(values->resize(count));
  HC_TRY(outside_.resize(kSweepBlockRows * bands_));
  HC_TRY(rescaling_.init(enclosures_, bands_));
  HC_TRY(gather_fixed_light());
  for (std::size_t at = 0; at < count; ++at)
    if (reflects(at / bands_))
      source_[at] = problem_.exitance[at] + problem_.reflectance[at] * fixed_[at];
  HC_TRY(find_contraction());
  HC_TRY(gather(source_, &from_source_));
  for (std::size_t at = 0; at < count; ++at) // reflected once: the shape that rescaling scales
    x_[at] = source_[at] + problem_.reflectance[at] * from_source_[at];
  return check_solvable(matrix_, problem_, enclosures_, source_);
}

Status GaussSeidel::find_contraction() {
  Buffer<std::uint8_t> lit; // [enclosure][band]
  HC_TRY(lit.resize(enclosures_.first_patch.size() * bands_));
  HC_TRY(contraction_.resize(bands_));
  const auto lit_at = [&](std::size_t patch, std::uint32_t band) -> std::uint8_t& {
    return lit[std::size_t{enclosures_.of_patch[patch]} * bands_ + band];
  };
  for (std::size_t i = 0; i < problem_.patch_count(); ++i)
    for (std::uint32_t b = 0; b < bands_ && reflects(i); ++b)
      lit_at(i, b) |= source_[i * bands_ + b] > 0;
  for (std::size_t i = 0; i < problem_.patch_count(); ++i) {
    if (!reflects(i))
      continue;
    const double sum = row_sum(matrix_.row(i));
    for (std::uint32_t b = 0; b < bands_; ++b)
      if (lit_at(i, b) != 0)
        contraction_[b] = std::max(contraction_[b], problem_.reflectance[i * bands_ + b] * sum);
  }
  return {};
}

/// into = F from, for reflecting patches.
Status GaussSeidel::gather(const Buffer<double>& from, Buffer<double>* into) {
  return executor_.for_each(matrix_.block_count(), [&](std::size_t block, std::size_t) {
    const FloatEnvironment environment;
    for (std::uint64_t i = matrix_.block_begin(block); i < matrix_.block_end(block); ++i) {
      if (!reflects(i))
        continue;
      const RowView row = matrix_.row(i);
      for (std::uint32_t b = 0; b < bands_; ++b)
        (*into)[i * bands_ + b] = row_dot(row, from.data() + b, bands_);
    }
    return Status();
  });
}

Status GaussSeidel::gather_fixed_light() {
  Buffer<double> black;
  HC_TRY(black.resize(x_.size()));
  bool any_lit = false;
  for (std::size_t i = 0; i < problem_.patch_count(); ++i)
    if (!reflects(i))
      for (std::uint32_t b = 0; b < bands_; ++b) {
        black[i * bands_ + b] = problem_.exitance[i * bands_ + b];
        any_lit = any_lit || black[i * bands_ + b] > 0;
      }
  if (any_lit)
    HC_TRY(gather(black, &fixed_));
  for (std::size_t i = 0; i < problem_.patch_count(); ++i)
    if (reflects(i))
      for (std::uint32_t b = 0; b < bands_; ++b)
        fixed_[i * bands_ + b] += matrix_.row(i).space * problem_.space_exitance[b];
  return {};
}

Status GaussSeidel::sweep() {
  const std::size_t count = problem_.patch_count();
  for (std::size_t begin = 0; begin < count; begin += kSweepBlockRows) {
    const std::size_t end = std::min(begin + kSweepBlockRows, count);
    HC_TRY(sum_outside(begin, end));
    sweep_inside(begin, end);
  }
  return {};
}

struct InsideRange {
  std::size_t first, last;
};

/// The entries of a row whose columns lie in [begin, end).
InsideRange inside_range(const RowView& row, std::size_t begin, std::size_t end) {
  const auto first = std::lower_bound(row.columns.begin(), row.columns.end(), begin);
  const auto last = std::lower_bound(first, row.columns.end(), end);
  return {static_cast<std::size_t>(first - row.columns.begin()),
          static_cast<std::size_t>(last - row.columns.begin())};
}

Status GaussSeidel::sum_outside(std::size_t block_begin, std::size_t block_end) {
  constexpr std::size_t kRows = FormFactorMatrix::kBlockRows;
  const std::size_t parts = (block_end - block_begin + kRows - 1) / kRows;
  return executor_.for_each(parts, [&](std::size_t part, std::size_t) {
    const FloatEnvironment environment;
    const std::size_t begin = block_begin + part * kRows;
    for (std::size_t i = begin; i < std::min(begin + kRows, block_end); ++i) {
      if (!reflects(i))
        continue;
      const RowView row = matrix_.row(i);
      const InsideRange inside = inside_range(row, block_begin, block_end);
      for (std::uint32_t b = 0; b < bands_; ++b)
        outside_[(i - block_begin) * bands_ + b] =
            row_dot(row, x_.data() + b, bands_, 0, inside.first) +
            row_dot(row, x_.data() + b, bands_, inside.last, row.columns.size());
    }
    return Status();
  });
}

void GaussSeidel::sweep_inside(std::size_t block_begin, std::size_t block_end) {
  const FloatEnvironment environment;
  for (std::size_t i = block_begin; i < block_end; ++i) {
    if (!reflects(i))
      continue;
    const RowView row = matrix_.row(i);
    const InsideRange inside = inside_range(row, block_begin, block_end);
    for (std::uint32_t b = 0; b < bands_; ++b) {
      const std::size_t at = i * bands_ + b;
      const double sum = outside_[(i - block_begin) * bands_ + b] +
                         row_dot(row, x_.data() + b, bands_, inside.first, inside.last);
      x_[at] = source_[at] + problem_.reflectance[at] * sum;
    }
  }
}

Status GaussSeidel::measure(Convergence* convergence) const {
  convergence->residual = convergence->estimated_error = 0;
  for (std::uint32_t b = 0; b < bands_; ++b) {
    double largest = 0, brightest = 0, total = 0;
    for (std::size_t i = 0; i < problem_.patch_count(); ++i) {
      const std::size_t at = i * bands_ + b;
      const double radiosity = reflects(i) ? x_[at] : problem_.exitance[at];
      brightest = std::max(brightest, radiosity);
      total += radiosity;
      if (reflects(i))
        largest = std::max(
            largest, std::fabs(source_[at] + problem_.reflectance[at] * gathered_[at] - x_[at]));
    }
    if (!std::isfinite(total) || !std::isfinite(largest))
      return Status::error(StatusCode::kBadScene, "the light is too bright to be computed: scale ",
                           "the exitances down");
    if (largest == 0)
      continue;
    const double residual = largest / brightest;
    const double error = contraction_[b] < 1 ? residual / (1 - contraction_[b])
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

Status GaussSeidel::check(Convergence* convergence) {
  HC_TRY(gather(x_, &gathered_));
  const FloatEnvironment environment;
  HC_TRY(measure(convergence));
  if (convergence->converged)
    return {};
  rescaling_.apply(problem_, enclosures_, source_, from_source_, x_, gathered_);
  return measure(convergence);
}

Status GaussSeidel::finish(Buffer<double>* radiosity, Buffer<double>* irradiance) {
  HC_TRY(radiosity->resize(x_.size()));
  HC_TRY(irradiance->resize(x_.size()));
  for (std::size_t i = 0; i < problem_.patch_count(); ++i)
    for (std::uint32_t b = 0; b < bands_; ++b) {
      const std::size_t at = i * bands_ + b;
      (*radiosity)[at] = reflects(i) ? x_[at] : problem_.exitance[at];
      (*irradiance)[at] = gathered_[at] + fixed_[at];
    }
  return {};
}

} // namespace

Status gauss_seidel(const FormFactorMatrix& matrix, const LightProblem& problem,
                    const SolverOptions& options, Executor& executor, SolverProgress* progress,
                    Buffer<double>* radiosity, Buffer<double>* irradiance,
                    Convergence* convergence) {
  if (!(options.tolerance > 0))
    return Status::error(StatusCode::kInvalidArgument, "tolerance ", options.tolerance,
                         " is not above 0");
  GaussSeidel solver(matrix, problem, options, executor);
  const FloatEnvironment environment;
  HC_TRY(solver.init());
  *convergence = {};
  while (true) {
    HC_TRY(solver.check(convergence));
    if (progress != nullptr && !progress->swept(convergence->sweeps, convergence->estimated_error))
      return Status::error(StatusCode::kCancelled, "interrupted while solving");
    if (convergence->converged || convergence->sweeps >= options.max_sweeps)
      break;
    for (std::uint64_t k = 0; k < kSweepsPerCheck && convergence->sweeps < options.max_sweeps;
         ++k) {
      HC_TRY(solver.sweep());
      ++convergence->sweeps;
    }
  }
  HC_TRY(solver.finish(radiosity, irradiance));
  if (!convergence->converged)
    return Status::error(StatusCode::kNotConverged, "not converged after ", convergence->sweeps,
                         " sweeps: residual ", convergence->residual, ", estimated error ",
                         convergence->estimated_error, ", tolerance ", options.tolerance);
  return {};
}

} // namespace hemicube::radiosity
