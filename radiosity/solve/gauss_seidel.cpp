#include "radiosity/solve/gauss_seidel.h"

#include "radiosity/solve/light_system.h"
#include "radiosity/solve/rescaling.h"
#include "raster/fp_environment.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

constexpr std::uint64_t kSweepsPerCheck = 4;

class GaussSeidel {
public:
  explicit GaussSeidel(LightSystem* system)
      : system_(*system), matrix_(system->matrix()), problem_(system->problem()),
        bands_(problem_.band_count) {}

  Status init();
  Status sweep();
  /// Measures the residual; rescales the enclosures if it is not small enough, and measures again.
  Status check(Convergence* convergence);
  Status finish(Buffer<double>* radiosity, Buffer<double>* irradiance) const {
    return system_.finish(x_.span(), gathered_.span(), radiosity, irradiance);
  }

private:
  Status sum_outside(std::size_t block_begin, std::size_t block_end);
  void sweep_inside(std::size_t block_begin, std::size_t block_end);
  void fetch_inside(std::size_t patch) const;

  LightSystem& system_;
  const FormFactorMatrix& matrix_;
  const LightProblem& problem_;
  const std::uint32_t bands_;
  Buffer<double> x_;        ///< [patch][band] radiosity; 0 for black patches
  Buffer<double> gathered_; ///< [patch][band] F x
  Buffer<double> outside_;  ///< [row of the block][band]
  Buffer<double> after_;    ///< [row of the block][band] the part of it from higher patches
  Buffer<double> inside_;   ///< [band]
  EnclosureRescaling rescaling_;
};

Status GaussSeidel::init() {
  HC_TRY(system_.first_guess(&x_));
  HC_TRY(gathered_.resize(x_.size()));
  for (Buffer<double>* sums : {&outside_, &after_})
    HC_TRY(sums->resize(LightSystem::kSweepBlockRows * bands_));
  HC_TRY(inside_.resize(bands_));
  return rescaling_.init(system_.enclosures(), bands_);
}

Status GaussSeidel::sweep() {
  system_.values().fill(x_.span());
  return matrix_.for_each_range([&](std::size_t first, std::size_t last) {
    const std::size_t end = matrix_.block_end(last - 1);
    for (std::size_t begin = matrix_.block_begin(first); begin < end;
         begin += LightSystem::kSweepBlockRows) {
      const std::size_t block_end = std::min(begin + LightSystem::kSweepBlockRows, end);
      HC_TRY(sum_outside(begin, block_end));
      sweep_inside(begin, block_end);
    }
    return Status();
  });
}

Status GaussSeidel::sum_outside(std::size_t block_begin, std::size_t block_end) {
  constexpr std::size_t kRows = FormFactorMatrix::kBlockRows;
  const std::size_t parts = (block_end - block_begin + kRows - 1) / kRows;
  return system_.executor().for_each(parts, [&](std::size_t part, std::size_t) {
    const FloatEnvironment environment;
    const std::size_t begin = block_begin + part * kRows;
    for (std::size_t i = begin; i < std::min(begin + kRows, block_end); ++i) {
      if (!system_.reflects(i))
        continue;
      const RowView row = matrix_.row(i);
      const LightSystem::InsideRange inside = system_.inside(i);
      double* const before = &outside_[(i - block_begin) * bands_];
      double* const after = &after_[(i - block_begin) * bands_];
      system_.values().sum(row, 0, inside.first, before);
      system_.values().sum(row, inside.last, row.columns.size(), after);
      for (std::uint32_t b = 0; b < bands_; ++b)
        before[b] += after[b];
    }
    return Status();
  });
}

/// Asks for the inside of a row: short pieces of memory that nobody foresees.
void GaussSeidel::fetch_inside(std::size_t patch) const {
#if defined(__GNUC__)
  constexpr std::uint32_t kPerLine = 16;
  const RowView row = matrix_.row(patch);
  const LightSystem::InsideRange inside = system_.inside(patch);
  for (std::uint32_t k = inside.first; k < inside.last; k += kPerLine) {
    __builtin_prefetch(row.columns.data() + k);
    __builtin_prefetch(row.values.data() + k);
  }
#endif
}

void GaussSeidel::sweep_inside(std::size_t block_begin, std::size_t block_end) {
  constexpr std::size_t kAhead = 3; // rows
  const FloatEnvironment environment;
  for (std::size_t i = block_begin; i < block_end; ++i) {
    if (i + kAhead < block_end)
      fetch_inside(i + kAhead);
    if (!system_.reflects(i))
      continue;
    const LightSystem::InsideRange inside = system_.inside(i);
    system_.values().sum(matrix_.row(i), inside.first, inside.last, inside_.data());
    for (std::uint32_t b = 0; b < bands_; ++b) {
      const std::size_t at = i * bands_ + b;
      const double sum = outside_[(i - block_begin) * bands_ + b] + inside_[b];
      x_[at] = system_.source()[at] + problem_.reflectance[at] * sum;
    }
    system_.values().set(i, &x_[i * bands_]);
  }
}

Status GaussSeidel::check(Convergence* convergence) {
  HC_TRY(system_.gather(x_.span(), &gathered_));
  const FloatEnvironment environment;
  HC_TRY(system_.measure(x_.span(), gathered_.span(), convergence));
  if (convergence->converged)
    return {};
  rescaling_.apply(problem_, system_.enclosures(), system_.source(), system_.from_source(),
                   x_.span(), gathered_.span());
  return system_.measure(x_.span(), gathered_.span(), convergence);
}

} // namespace

Status gauss_seidel(const FormFactorMatrix& matrix, const LightProblem& problem,
                    const SolverOptions& options, Executor& executor, SolverProgress* progress,
                    Buffer<double>* radiosity, Buffer<double>* irradiance,
                    Convergence* convergence) {
  const FloatEnvironment environment;
  LightSystem system(matrix, problem, options, executor);
  HC_TRY(system.init());
  GaussSeidel solver(&system);
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
  return convergence->converged ? Status() : system.not_converged(*convergence);
}

} // namespace hemicube::radiosity
