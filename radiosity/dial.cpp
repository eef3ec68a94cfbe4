#include "radiosity/dial.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

constexpr std::uint32_t kDialRows = 16;

/// A prediction from few rows and guessed light may be too low by this.
constexpr double kMargin = 2;

/// Of rung adaptive; the first looks at each partly visible pair once.
constexpr double kTargets[] = {0.5, 0.1, 0.03, 0.01, 0.003, 0.001};
constexpr std::uint32_t kResolutions[] = {64, 128, 256, 512};

/// The exact rows are this many times more exact than what is wanted, as far as rung adaptive goes:
/// its errors are about a hundredth of its target.
double exact_target(double wanted) {
  const double target = 10 * wanted;
  return target > 0.1 ? 0.1 : target < 0.001 ? 0.001 : target;
}

/// Nanoseconds of a hemicube, roughly: what a machine of 2022 takes. A constant of the program, not
/// of the machine it runs on: the choice must not depend on that.
double hemicube_cost(double resolution, double seen_patches) {
  return 15e3 + 80 * seen_patches + 2.4 * resolution * resolution;
}

} // namespace

void Dial::list_candidates(const RungSetting& wish) {
  candidate_count_ = 0;
  const auto add = [&](Rung rung, std::uint32_t resolution, double target) {
    candidates_[candidate_count_++].setting = {rung, resolution, target};
  };
  const auto add_resolutions = [&](Rung rung) {
    for (const std::uint32_t resolution : kResolutions)
      if (options_.choose_resolution)
        add(rung, resolution, wish.target);
    if (!options_.choose_resolution)
      add(rung, wish.resolution, wish.target);
  };
  if (!options_.choose_rung) {
    if (wish.rung <= Rung::kArea)
      add_resolutions(wish.rung);
    else
      add(wish.rung, wish.resolution, wish.target);
    return;
  }
  add_resolutions(Rung::kHemicube);
  for (const double target : kTargets)
    add(Rung::kAdaptive, wish.resolution, target);
}

/// @param rows  row k belongs to the sample's patch k
double Dial::light_error(const FormFactorMatrix& rows) {
  const LightProblem& p = *problem_;
  double squares = 0, sampled_area = 0, all = 0, area = 0;
  for (std::size_t k = 0; k < sample_.patches().size(); ++k) {
    const std::uint32_t patch = sample_.patches()[k];
    sample_.defect(k, rows.row(k), p, light_.span(), defect_.data());
    for (std::uint32_t b = 0; b < p.band_count; ++b)
      squares += p.area[patch] * defect_[b] * defect_[b];
    sampled_area += p.area[patch];
  }
  for (std::size_t i = 0; i < p.patch_count(); ++i) {
    area += p.area[i];
    for (std::uint32_t b = 0; b < p.band_count; ++b)
      all += p.area[i] * light_[i * p.band_count + b] * light_[i * p.band_count + b];
  }
  return all > 0 ? std::sqrt(squares / sampled_area * area / all) : 0;
}

Status Dial::judge(Candidate* candidate) {
  if (candidate->is_judged)
    return {};
  FormFactorMatrix rows;
  HC_TRY(compute_sampled_rows(geometry_, candidate->setting, options_, executor_, sample_.patches(),
                              &rows));
  candidate->error = problem_ != nullptr
                         ? light_error(rows)
                         : sample_.form_factor_error([&](std::size_t k) { return rows.row(k); });
  candidate->is_judged = true;
  return {};
}

Status Dial::choose(RungSetting* setting) {
  list_candidates(*setting);
  if (candidate_count_ == 1) {
    *setting = candidates_[0].setting;
    return {};
  }
  HC_TRY(sample_.choose(geometry_->patches().patch_count(), kDialRows));
  std::uint64_t work = 0;
  HC_TRY(compute_sampled_rows(geometry_,
                              {Rung::kAdaptive, setting->resolution, exact_target(options_.error)},
                              options_, executor_, sample_.patches(), &sample_.exact, &work));
  const double rows = static_cast<double>(sample_.patches().size());
  order_by_cost(static_cast<double>(work) / rows,
                static_cast<double>(sample_.exact.nonzero_count()) / rows);
  if (problem_ != nullptr) {
    HC_TRY(guess_light(*problem_, &light_));
    HC_TRY(defect_.resize(problem_->band_count));
  }
  HC_TRY(find_cheapest(options_.error / kMargin, &chosen_));
  *setting = candidates_[chosen_].setting;
  return {};
}

/// The first candidate, by cost, whose predicted error is below a bound; else the most exact one.
Status Dial::find_cheapest(double bound, std::size_t* found) {
  std::size_t most_exact = candidate_count_;
  const Candidate* coarser = nullptr; // the same rung with fewer pixels
  for (std::size_t k = 0; k < candidate_count_; ++k) {
    Candidate& candidate = candidates_[k];
    const bool by_pixels = candidate.setting.rung <= Rung::kArea;
    // More pixels help as long as pixels are what is wrong.
    if (by_pixels && coarser != nullptr && coarser->error > 4 * bound)
      continue;
    HC_TRY(judge(&candidate));
    if (by_pixels)
      coarser = &candidate;
    if (most_exact == candidate_count_ || candidate.error < candidates_[most_exact].error)
      most_exact = k;
    if (candidate.error <= bound) {
      *found = k;
      return {};
    }
  }
  *found = most_exact;
  return {};
}

/// What a row costs, guessed from the exact ones; cheapest first.
void Dial::order_by_cost(double exact_work, double seen) {
  for (std::size_t k = 0; k < candidate_count_; ++k) {
    Candidate& candidate = candidates_[k];
    // Pairs that are found once for both rows cost half; finer targets cost more and more.
    candidate.cost = candidate.setting.rung == Rung::kAdaptive
                         ? exact_work / 2 * (1 + 0.01 / candidate.setting.target)
                         : hemicube_cost(candidate.setting.resolution, seen) +
                               (candidate.setting.rung == Rung::kHemicube ? 0 : exact_work);
    for (std::size_t m = k; m > 0 && candidates_[m].cost < candidates_[m - 1].cost; --m)
      std::swap(candidates_[m], candidates_[m - 1]);
  }
}

Status Dial::choose_finer(double found, RungSetting* setting, bool* is_finer) {
  *is_finer = false;
  if (candidate_count_ <= 1)
    return {};
  const Candidate& last = candidates_[chosen_];
  const double factor = last.error > 0 ? found / last.error : 1;
  std::size_t next = 0;
  HC_TRY(find_cheapest(options_.error / (factor > kMargin ? factor : kMargin), &next));
  *is_finer = candidates_[next].error < last.error;
  if (*is_finer)
    chosen_ = next;
  *setting = candidates_[chosen_].setting;
  return {};
}

} // namespace hemicube::radiosity
