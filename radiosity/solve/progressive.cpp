#include "radiosity/solve/progressive.h"

#include "radiosity/form_factor/matrix_columns.h"
#include "radiosity/solve/light_system.h"
#include "radiosity/solve/rescaling.h"
#include "radiosity/solve/unshot_light.h"

#include <limits>

namespace hemicube::radiosity {

Status check_stop_unshot(double share) noexcept {
  if (share >= 0 && share < 1)
    return {};
  return Status::error(StatusCode::kInvalidArgument, "share of unshot light to stop at: ", share,
                       " is not between 0 and 1");
}

double unshot_bound(double rate, double unshot_power, double total_power) noexcept {
  if (unshot_power == 0)
    return 0;
  return rate < 1 ? rate / (1 - rate) * unshot_power / total_power
                  : std::numeric_limits<double>::infinity();
}

namespace {

/// Shots after which light is gathered in any case, per patch.
constexpr std::uint64_t kShotsPerCheck = 4;

class Progressive {
public:
  Progressive(LightSystem* system, SolverProgress* progress, Convergence* convergence)
      : system_(*system), problem_(system->problem()), options_(system->options()),
        progress_(progress), convergence_(*convergence), bands_(problem_.band_count) {}

  Status init();
  Status run();
  Status finish(Buffer<double>* radiosity, Buffer<double>* irradiance) const {
    return system_.finish(x_.span(), gathered_.span(), radiosity, irradiance);
  }

private:
  Status read_columns();
  Status shoot_until(double share);
  Status shoot(std::uint32_t patch);
  Status tell();
  Status gather();
  void resume();
  void describe();

  LightSystem& system_;
  const LightProblem& problem_;
  const SolverOptions& options_;
  SolverProgress* progress_;
  Convergence& convergence_;
  const std::uint32_t bands_;
  FormFactorMatrix columns_; ///< row j: the rows that see patch j; values without scale
  Buffer<double> scale_;     ///< [patch] of its row
  Buffer<double> rate_;      ///< [band] the largest share of shot power that is reflected
  Buffer<double> x_;         ///< [patch][band] radiosity, unshot included; 0 for black patches
  Buffer<double> gathered_;  ///< [patch][band] F x
  Buffer<double> shot_;      ///< [band]
  UnshotLight unshot_;
  EnclosureRescaling rescaling_;
};

Status Progressive::init() {
  if (!system_.matrix().is_in_memory())
    return Status::error(StatusCode::kOutOfMemory, "shooting needs the form factors in memory, ",
                         2 * system_.matrix().byte_count(), " bytes for rows and columns: allow ",
                         "more with --memory, or take another solver");
  const std::size_t count = problem_.patch_count();
  Buffer<double> emitted;
  HC_TRY(emitted.resize(bands_));
  HC_TRY(x_.resize(count * bands_));
  HC_TRY(gathered_.resize(count * bands_));
  HC_TRY(shot_.resize(bands_));
  for (std::size_t i = 0; i < count; ++i)
    for (std::uint32_t b = 0; b < bands_; ++b) {
      const std::size_t at = i * bands_ + b;
      x_[at] = system_.source()[at];
      emitted[b] += problem_.area[i] * (system_.reflects(i) ? x_[at] : problem_.exitance[at]);
    }
  HC_TRY(unshot_.init(problem_, x_.span(), emitted.span()));
  HC_TRY(rescaling_.init(system_.enclosures(), bands_));
  return read_columns();
}

/// The transposed matrix, and how much of what a patch shoots is reflected.
Status Progressive::read_columns() {
  const FormFactorMatrix& matrix = system_.matrix();
  Executor& executor = system_.executor();
  const std::size_t count = problem_.patch_count();
  Buffer<double> rate_of_patch;
  HC_TRY(rate_of_patch.resize(count * bands_));
  HC_TRY(rate_.resize(bands_));
  HC_TRY(scale_.resize(count));
  HC_TRY(columns_.init(count, static_cast<std::uint32_t>(count)));
  struct Entries {
    Buffer<std::uint32_t> rows;
    Buffer<float> values;
  };
  FixedArray<Entries> of_worker;
  HC_TRY(of_worker.init(executor.worker_count()));
  HC_TRY(matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i)
      scale_[i] = matrix.row(i).scale;
    return Status();
  }));
  const Status status = for_each_block_with_columns(
      matrix, executor, [&](std::size_t block, std::size_t worker, const MatrixColumns& columns) {
        Entries& entries = of_worker[worker];
        for (std::uint64_t j = matrix.block_begin(block); j < matrix.block_end(block); ++j) {
          entries.rows.clear();
          entries.values.clear();
          double* const rate = &rate_of_patch[j * bands_];
          for (const ColumnEntry& entry : columns.column(j)) {
            if (!system_.reflects(j) || !system_.reflects(entry.row))
              continue;
            HC_TRY(entries.rows.push_back(entry.row));
            HC_TRY(entries.values.push_back(entry.value));
            const double arrives = problem_.area[entry.row] / problem_.area[j] * scale_[entry.row] *
                                   static_cast<double>(entry.value);
            for (std::uint32_t b = 0; b < bands_; ++b)
              rate[b] += problem_.reflectance[std::size_t{entry.row} * bands_ + b] * arrives;
          }
          RowView row;
          row.columns = entries.rows.span();
          row.values = entries.values.span();
          HC_TRY(columns_.append_row(block, row));
        }
        return Status();
      });
  HC_TRY(status);
  for (std::size_t at = 0; at < rate_of_patch.size(); ++at)
    rate_[at % bands_] = std::max(rate_[at % bands_], rate_of_patch[at]);
  return {};
}

Status Progressive::shoot(std::uint32_t patch) {
  unshot_.take(patch, shot_.data());
  const RowView column = columns_.row(patch);
  const std::span<double> unshot = unshot_.values();
  for (std::size_t k = 0; k < column.columns.size(); ++k) {
    const std::size_t i = column.columns[k];
    const double form_factor = scale_[i] * static_cast<double>(column.values[k]);
    for (std::uint32_t b = 0; b < bands_; ++b) {
      const std::size_t at = i * bands_ + b;
      const double reflected = problem_.reflectance[at] * (form_factor * shot_[b]);
      x_[at] += reflected;
      unshot[at] += reflected;
    }
  }
  ++convergence_.shots;
  return {};
}

Status Progressive::tell() {
  convergence_.unshot = unshot_.share();
  if (progress_ == nullptr ||
      progress_->shot({convergence_.shots, unshot_.share(), x_.span(), unshot_.ambient()}))
    return {};
  return Status::error(StatusCode::kCancelled, "interrupted after ", convergence_.shots, " shots");
}

/// Shoots until so much is unshot, until nothing is, or for as long as light may go ungathered.
Status Progressive::shoot_until(double share) {
  const std::uint64_t start = convergence_.shots;
  const std::uint64_t most =
      options_.stop_unshot > 0 ? ~std::uint64_t{0} : kShotsPerCheck * problem_.patch_count();
  while (unshot_.share() > share && convergence_.shots < options_.max_shots &&
         convergence_.shots - start < most) {
    std::uint32_t brightest;
    if (unshot_.choose({&brightest, 1}) == 0)
      return {};
    HC_TRY(shoot(brightest));
    unshot_.survey();
    HC_TRY(tell());
  }
  return {};
}

Status Progressive::gather() {
  HC_TRY(system_.gather(x_.span(), &gathered_));
  return system_.measure(x_.span(), gathered_.span(), &convergence_);
}

/// Rescales the enclosures, and takes what has been gathered for what is to be shot.
void Progressive::resume() {
  rescaling_.apply(problem_, system_.enclosures(), system_.source(), system_.from_source(),
                   x_.span(), gathered_.span());
  const std::span<double> unshot = unshot_.values();
  for (std::size_t at = 0; at < x_.size(); ++at) {
    const double exact = system_.source()[at] + problem_.reflectance[at] * gathered_[at];
    unshot[at] = exact - x_[at];
    x_[at] = exact;
  }
  unshot_.survey();
}

void Progressive::describe() {
  convergence_.unshot = unshot_.share();
  convergence_.unshot_bound = 0;
  for (std::uint32_t b = 0; b < bands_; ++b) {
    double total = 0;
    for (std::size_t i = 0; i < problem_.patch_count(); ++i)
      total += problem_.area[i] *
               (system_.reflects(i) ? x_[i * bands_ + b] : problem_.exitance[i * bands_ + b]);
    convergence_.unshot_bound =
        std::max(convergence_.unshot_bound, unshot_bound(rate_[b], unshot_.power(b), total));
  }
}

Status Progressive::run() {
  HC_TRY(tell());
  double share = options_.stop_unshot > 0 ? options_.stop_unshot : options_.tolerance;
  while (true) {
    HC_TRY(shoot_until(share));
    HC_TRY(gather());
    describe();
    const bool is_at_share = options_.stop_unshot > 0 && unshot_.share() <= options_.stop_unshot;
    convergence_.converged = convergence_.converged || is_at_share;
    if (convergence_.converged || convergence_.shots >= options_.max_shots)
      return {};
    if (++convergence_.sweeps >= options_.max_sweeps) // gathered light, once each
      return {};
    resume();
    if (options_.stop_unshot == 0 && unshot_.share() <= share)
      share = unshot_.share() / 4;
  }
}

} // namespace

Status progressive(const FormFactorMatrix& matrix, const LightProblem& problem,
                   const SolverOptions& options, Executor& executor, SolverProgress* progress,
                   Buffer<double>* radiosity, Buffer<double>* irradiance,
                   Convergence* convergence) {
  HC_TRY(check_stop_unshot(options.stop_unshot));
  const FloatEnvironment environment;
  LightSystem system(matrix, problem, options, executor);
  HC_TRY(system.init());
  *convergence = {};
  Progressive solver(&system, progress, convergence);
  HC_TRY(solver.init());
  HC_TRY(solver.run());
  HC_TRY(solver.finish(radiosity, irradiance));
  if (convergence->converged)
    return {};
  return Status::error(StatusCode::kNotConverged, "not converged after ", convergence->shots,
                       " shots: unshot light ", convergence->unshot,
                       " of what is emitted, residual ", convergence->residual, ", tolerance ",
                       options.tolerance);
}

} // namespace hemicube::radiosity
