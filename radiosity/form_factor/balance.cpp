#include "radiosity/form_factor/balance.h"

#include "radiosity/form_factor/exchange_areas.h"
#include "radiosity/form_factor/interleaved_sum.h"
#include "raster/fp_environment.h"

#include <algorithm>
#include <cmath>

namespace hemicube::radiosity {
namespace {

/// Row sums need not come nearer to their shares than float lets the entries be.
constexpr double kClosureTolerance = 1e-8;
/// Rows that are farther off after the last iteration may change their losses.
constexpr double kOpenRow = 1e-6;
constexpr std::uint64_t kMostIterations = 500;
constexpr int kMostRounds = 12;
/// If so many iterations leave more than so much of the residual's squared norm, more are of no
/// use.
constexpr std::uint64_t kPatience = 16;
constexpr double kLeastGain = 0.81;
/// A direction that changes row sums by no more than this, relative to its multipliers (D^-1 (D +
/// W), whose eigenvalues are 0 .. 2), changes them by rounding: to follow it leads beyond all
/// numbers.
constexpr double kNoEffect = 0x1p-40;
/// What one round may do to an entry: bounds that are not met unless a pattern does not close.
constexpr double kLeastFactor = 0.5, kLargestFactor = 2;

/// With multipliers L, S'_ij = S_ij + S_ij^2 (L_i + L_j) is the nearest matrix. Its rows close if
/// (D + W) L = r: W_ij = S_ij^2, D their row sums on the diagonal, r what rows lack. D + W is
/// symmetric with eigenvalues >= 0. Conjugate residuals, preconditioned by D, shrink r D^-1 r in
/// every step, also where no solution exists.
class Balancer {
public:
  Balancer(FormFactorMatrix* matrix, std::span<const double> area, Executor& executor,
           BalanceProgress* progress, BalanceReport* report)
      : matrix_(*matrix), area_(area), executor_(executor), progress_(progress), report_(*report) {}

  Status init();
  Status run();
  Status close();

private:
  template <typename Function> Status for_each_row(Function function);
  /// Fills residual_ and weight_sum_.
  Status measure_rows();
  Status multiply(const Buffer<double>& x, Buffer<double>* product);
  /// @param residual  largest of a row that may be left
  Status find_multipliers(double residual);
  Status apply_multipliers();
  void release_losses(std::uint64_t i);
  void close_row(std::uint64_t i);
  void measure_change(std::uint64_t i);

  double share(std::uint64_t i) const {
    const RowView row = exchange_.row(i);
    return std::max(0.0, 1 - row.space - row.back_side);
  }
  double largest_residual() const;
  /// r D^-1 r
  double residual_norm() const;
  void precondition(const Buffer<double>& from, Buffer<double>* into) const;

  FormFactorMatrix& matrix_; ///< as it was, until close() changes places with exchange_
  const std::span<const double> area_;
  Executor& executor_;
  BalanceProgress* progress_;
  BalanceReport& report_;
  FormFactorMatrix exchange_;
  Buffer<double> relative_area_; ///< A_i over the largest
  // [patch]
  Buffer<double> residual_, weight_sum_, multiplier_;
  Buffer<double> z_, product_, direction_, direction_product_;
  struct Change {
    double max = 0, squares = 0, all = 0;
  };
  Buffer<Change> changes_;        ///< [row]
  Buffer<std::uint8_t> is_bound_; ///< [row] an entry met a bound of its factor in the last round
};

template <typename Function> Status Balancer::for_each_row(Function function) {
  return executor_.for_each(exchange_.block_count(), [&](std::size_t block, std::size_t) {
    const FloatEnvironment environment;
    for (std::uint64_t i = exchange_.block_begin(block); i < exchange_.block_end(block); ++i)
      function(i);
    return Status();
  });
}

Status Balancer::init() {
  const std::uint64_t count = matrix_.row_count();
  double largest = 0;
  for (const double area : area_)
    largest = std::max(largest, area);
  HC_TRY(changes_.resize(count));
  HC_TRY(is_bound_.resize(count));
  for (Buffer<double>* values : {&relative_area_, &residual_, &weight_sum_, &multiplier_, &z_,
                                 &product_, &direction_, &direction_product_})
    HC_TRY(values->resize(count));
  for (std::uint64_t i = 0; i < count; ++i) {
    const RowView row = matrix_.row(i);
    if (!is_computed(row))
      return Status::error(StatusCode::kInvalidArgument, "row ", i,
                           " was not built: only whole matrices can be balanced");
    relative_area_[i] = area_[i] / largest;
  }
  return exchange_areas(matrix_, area_, executor_, &exchange_);
}

Status Balancer::measure_rows() {
  return for_each_row([&](std::uint64_t i) {
    const std::span<const float> values = exchange_.row(i).values;
    residual_[i] = relative_area_[i] * share(i) - row_sum(exchange_.row(i));
    weight_sum_[i] = interleaved_sum(0, values.size(), [&](std::size_t k) {
      const double value = static_cast<double>(values[k]);
      return value * value;
    });
  });
}

double Balancer::largest_residual() const {
  double largest = 0;
  for (std::size_t i = 0; i < residual_.size(); ++i)
    largest = std::max(largest, std::fabs(residual_[i]) / relative_area_[i]);
  return largest;
}

double Balancer::residual_norm() const {
  double sum = 0;
  for (std::size_t i = 0; i < residual_.size(); ++i)
    if (weight_sum_[i] > 0)
      sum += residual_[i] * residual_[i] / weight_sum_[i];
  return sum;
}

void Balancer::precondition(const Buffer<double>& from, Buffer<double>* into) const {
  for (std::size_t i = 0; i < from.size(); ++i)
    (*into)[i] = weight_sum_[i] > 0 ? from[i] / weight_sum_[i] : 0;
}

/// product = (D + W) x
Status Balancer::multiply(const Buffer<double>& x, Buffer<double>* product) {
  ++report_.iterations;
  HC_TRY(for_each_row([&](std::uint64_t i) {
    const RowView row = exchange_.row(i);
    const std::uint32_t* columns = row.columns.data();
    const float* values = row.values.data();
    (*product)[i] =
        weight_sum_[i] * x[i] + interleaved_sum(0, row.columns.size(), [&](std::size_t k) {
          const double value = static_cast<double>(values[k]);
          return value * value * x[columns[k]];
        });
  }));
  if (progress_ != nullptr && !progress_->iterated(report_.iterations, largest_residual()))
    return Status::error(StatusCode::kCancelled, "interrupted while balancing");
  return {};
}

double dot(const Buffer<double>& a, const Buffer<double>& b) {
  return interleaved_sum(0, a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}

Status Balancer::find_multipliers(double residual) {
  multiplier_.fill(0);
  precondition(residual_, &z_);
  HC_TRY(multiply(z_, &product_));
  HC_TRY(direction_.assign(z_.span()));
  HC_TRY(direction_product_.assign(product_.span()));
  double curvature = dot(z_, product_), norm = residual_norm();
  for (std::uint64_t step = 1; curvature > 0; ++step) {
    double square = 0;
    for (std::size_t i = 0; i < z_.size(); ++i)
      if (weight_sum_[i] > 0)
        square += direction_product_[i] * direction_product_[i] / weight_sum_[i];
    if (!(square > kNoEffect * curvature))
      return {};
    const double length = curvature / square;
    for (std::size_t i = 0; i < z_.size(); ++i) {
      multiplier_[i] += length * direction_[i];
      residual_[i] -= length * direction_product_[i];
    }
    if (largest_residual() <= std::max(residual, kClosureTolerance) ||
        report_.iterations >= kMostIterations)
      return {};
    if (step % kPatience == 0) {
      const double before = norm;
      norm = residual_norm();
      if (norm > kLeastGain * before)
        return {};
    }
    precondition(residual_, &z_);
    HC_TRY(multiply(z_, &product_));
    const double next = dot(z_, product_);
    for (std::size_t i = 0; i < z_.size(); ++i) {
      direction_[i] = z_[i] + next / curvature * direction_[i];
      direction_product_[i] = product_[i] + next / curvature * direction_product_[i];
    }
    curvature = next;
  }
  return {};
}

Status Balancer::apply_multipliers() {
  return for_each_row([&](std::uint64_t i) {
    const std::span<const std::uint32_t> columns = exchange_.row(i).columns;
    const std::span<float> values = exchange_.values(i);
    bool is_bound = false;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double value = static_cast<double>(values[k]);
      const double wanted = 1 + value * (multiplier_[i] + multiplier_[columns[k]]);
      const double factor = std::clamp(wanted, kLeastFactor, kLargestFactor);
      is_bound = is_bound || factor != wanted;
      values[k] = static_cast<float>(value * factor);
    }
    is_bound_[i] = is_bound;
  });
}

Status Balancer::run() {
  HC_TRY(measure_rows());
  for (std::uint64_t i = 0; i < residual_.size(); ++i) {
    // Out of reach: its centre sees what most of it does not, say from under a block.
    const double target = relative_area_[i] * share(i), sum = target - residual_[i];
    if (sum < kLeastFactor * target || sum > kLargestFactor * target)
      release_losses(i);
  }
  bool is_bound = false;
  for (int round = 0; round < kMostRounds; ++round) {
    const double before = residual_norm(), residual = largest_residual();
    if (residual <= kClosureTolerance || report_.iterations >= kMostIterations)
      break;
    // What bounds will cut need not be known well.
    HC_TRY(find_multipliers(is_bound ? 0.1 * residual : 0));
    HC_TRY(apply_multipliers());
    HC_TRY(measure_rows());
    is_bound = std::find(is_bound_.begin(), is_bound_.end(), 1) != is_bound_.end();
    if (residual_norm() > kLeastGain * before)
      break;
  }
  report_.closure_residual = largest_residual();
  return {};
}

/// Lets the losses of a row, if it has any, grow by what its sum lacks, or shrink.
void Balancer::release_losses(std::uint64_t i) {
  const RowView row = exchange_.row(i);
  const double losses = row.space + row.back_side;
  if (!(losses > 0))
    return;
  const double released = std::clamp(losses + residual_[i] / relative_area_[i], 0.0, 1.0);
  const double space = released * (row.space / losses);
  exchange_.set_shares(i, 1, space, std::max(0.0, released - space));
  residual_[i] = relative_area_[i] * share(i) - row_sum(row);
}

void Balancer::close_row(std::uint64_t i) {
  if (std::fabs(residual_[i]) > kOpenRow * relative_area_[i])
    release_losses(i);
  const RowView row = exchange_.row(i);
  const double rest = share(i), sum = row_sum(row);
  double scale = sum > 0 ? rest / sum : 1;
  exchange_.set_shares(i, scale, row.space, row.back_side);
  while (row_sum(exchange_.row(i)) > rest) { // by a rounding: light from nothing
    scale *= 1 - 0x1p-53;
    exchange_.set_shares(i, scale, row.space, row.back_side);
  }
}

void Balancer::measure_change(std::uint64_t i) {
  const RowView before = matrix_.row(i), after = exchange_.row(i);
  Change change;
  for (std::size_t k = 0, old = 0; k < after.columns.size(); ++k) {
    double was = 0;
    if (old < before.columns.size() && before.columns[old] == after.columns[k])
      was = before.scale * static_cast<double>(before.values[old++]);
    const double difference = std::fabs(after.scale * static_cast<double>(after.values[k]) - was);
    change.max = std::max(change.max, difference);
    change.squares += difference * difference;
    change.all += was * was;
  }
  const double weight = relative_area_[i] * relative_area_[i];
  changes_[i] = {change.max, weight * change.squares, weight * change.all};
}

Status Balancer::close() {
  HC_TRY(for_each_row([&](std::uint64_t i) {
    close_row(i);
    measure_change(i);
  }));
  Change total;
  for (const Change& change : changes_) {
    total.max = std::max(total.max, change.max);
    total.squares += change.squares;
    total.all += change.all;
  }
  report_.max_change = total.max;
  report_.rms_change = total.all > 0 ? std::sqrt(total.squares / total.all) : 0;
  if (report_.rms_change > kMostBalanceChange)
    return Status::error(
        StatusCode::kBadScene, "balancing would change the form factors by ", report_.rms_change,
        " of themselves (RMS), and no more than ", kMostBalanceChange,
        " is allowed: they are too far from reciprocal to be corrected; cut the patches smaller, "
        "raise the resolution, or do not balance");
  matrix_.swap(exchange_);
  return {};
}

} // namespace

Status balance(FormFactorMatrix* matrix, std::span<const double> area, Executor& executor,
               BalanceProgress* progress, BalanceReport* report) {
  HC_ASSERT(area.size() == matrix->row_count() && matrix->row_count() == matrix->column_count());
  const FloatEnvironment environment;
  *report = {};
  Balancer balancer(matrix, area, executor, progress, report);
  HC_TRY(balancer.init());
  HC_TRY(balancer.run());
  return balancer.close();
}

} // namespace hemicube::radiosity
