#include "radiosity/dial.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// A prediction from few rows and guessed light may be too low by this.
constexpr double kMargin = 2;

/// Above this, settings are tried in turn; below, the cheapest of all that do is taken.
constexpr double kFirstTargets[] = {0.5};
constexpr double kFinerTargets[] = {0.1, 0.03, 0.01, 0.003, 0.001};
constexpr std::uint32_t kResolutions[] = {64, 128, 256, 512};

/// The exact rows are this many times more exact than what is wanted, as far as rung adaptive goes:
/// its errors are about a hundredth of its target.
double exact_target(double wanted) {
  const double target = 3 * wanted;
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
  for (const double target : kFirstTargets)
    add(Rung::kAdaptive, wish.resolution, target);
  for (const double target : kFinerTargets)
    add(Rung::kAdaptive, wish.resolution, target);
}

/// Light that is good enough to weigh the errors of rows with: what is emitted, and a mean of what
/// is reflected everywhere (the ambient term of Cohen et al. 1988).
Status Dial::guess_light() {
  const LightProblem& p = *problem_;
  HC_TRY(light_.resize(p.patch_count() * p.band_count));
  for (std::uint32_t b = 0; b < p.band_count; ++b) {
    double emitted = 0, absorbing = 0;
    for (std::size_t i = 0; i < p.patch_count(); ++i) {
      emitted += p.area[i] * p.exitance[i * p.band_count + b];
      absorbing += p.area[i] * (1 - p.reflectance[i * p.band_count + b]);
    }
    const double ambient = (absorbing > 0 ? emitted / absorbing : emitted) + p.space_exitance[b];
    for (std::size_t i = 0; i < p.patch_count(); ++i) {
      const std::size_t at = i * p.band_count + b;
      light_[at] = p.exitance[at] + p.reflectance[at] * ambient;
    }
  }
  return {};
}

/// @param rows  row k belongs to the sample's patch k
double Dial::light_error(const FormFactorMatrix& rows) const {
  const LightProblem& p = *problem_;
  double squares = 0, sampled_area = 0, all = 0, area = 0;
  constexpr std::uint32_t kMostBands = 64;
  double defect[kMostBands];
  if (p.band_count > kMostBands)
    return 1;
  for (std::size_t k = 0; k < sample_.patches().size(); ++k) {
    const std::uint32_t patch = sample_.patches()[k];
    sample_.defect(k, rows.row(k), p, light_.span(), defect);
    for (std::uint32_t b = 0; b < p.band_count; ++b)
      squares += p.area[patch] * defect[b] * defect[b];
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
  Options quiet = options_;
  quiet.hash_items = false;
  RowRun run;
  FormFactorMatrix rows;
  const auto patches = sample_.patches();
  HC_TRY(run.init(geometry_, candidate->setting, quiet, patches.size(), executor_, nullptr));
  HC_TRY(rows.init(patches.size(), geometry_->patches().patch_count()));
  Buffer<std::uint64_t> work;
  HC_TRY(work.resize(patches.size()));
  HC_TRY(run.build(
      patches.size(),
      [&](std::uint64_t k, RowPlace* place) {
        place->patch = patches[k];
        return true;
      },
      [&](std::uint64_t k, const RowView& row, const RowFacts* facts) {
        work[k] = facts->work;
        return rows.append_row(k / FormFactorMatrix::kBlockRows, row);
      }));
  double all_work = 0;
  for (const std::uint64_t of_row : work)
    all_work += static_cast<double>(of_row);
  const double row_count = static_cast<double>(patches.size());
  const double seen = static_cast<double>(sample_.exact.nonzero_count()) / row_count;
  // Pairs that are found once for both rows cost half of what they cost here.
  candidate->cost = candidate->setting.rung == Rung::kAdaptive
                        ? all_work / row_count / 2
                        : hemicube_cost(candidate->setting.resolution, seen) + all_work / row_count;
  candidate->error = problem_ != nullptr
                         ? light_error(rows)
                         : sample_.form_factor_error([&](std::size_t k) { return rows.row(k); },
                                                     [](std::size_t) { return true; });
  candidate->is_judged = true;
  return {};
}

Status Dial::choose(RungSetting* setting) {
  list_candidates(*setting);
  if (candidate_count_ == 1) {
    *setting = candidates_[0].setting;
    return {};
  }
  HC_TRY(sample_.choose(geometry_->patches().patch_count(), kErrorSampleRows));
  sample_target_ = exact_target(options_.error);
  HC_TRY(compute_exact_rows(geometry_, {Rung::kAdaptive, setting->resolution, sample_target_},
                            options_, executor_, &sample_));
  if (problem_ != nullptr)
    HC_TRY(guess_light());
  bool is_finer = false;
  return choose_finer(0, setting, &is_finer);
}

const RowSample* Dial::sample_for(const RungSetting& setting) const noexcept {
  const bool is_finer = sample_target_ > 0 &&
                        (setting.rung != Rung::kAdaptive || setting.target > 4 * sample_target_);
  return is_finer ? &sample_ : nullptr;
}

Status Dial::choose_finer(double found, RungSetting* setting, bool* is_finer) {
  *is_finer = false;
  if (candidate_count_ <= 1)
    return {};
  double below = options_.error;
  if (found > 0) {
    Candidate& last = candidates_[chosen_];
    factor_ = last.error > 0 && found > last.error ? found / last.error : factor_;
    below =
        options_.error < last.error * factor_ / 1.5 ? options_.error : last.error * factor_ / 1.5;
  }
  std::size_t best = candidate_count_, most_exact = 0;
  for (std::size_t k = 0; k < candidate_count_; ++k) {
    Candidate& candidate = candidates_[k];
    const bool is_fine_adaptive =
        candidate.setting.rung == Rung::kAdaptive && candidate.setting.target < kFirstTargets[0];
    if (is_fine_adaptive && best != candidate_count_)
      break; // dearer than what does already
    HC_TRY(judge(&candidate));
    if (candidate.error < candidates_[most_exact].error)
      most_exact = k;
    if (candidate.error * kMargin * factor_ <= below &&
        (best == candidate_count_ || candidate.cost < candidates_[best].cost))
      best = k;
  }
  const std::size_t next = best != candidate_count_ ? best : most_exact;
  *is_finer = found == 0 || next != chosen_;
  chosen_ = next;
  *setting = candidates_[chosen_].setting;
  return {};
}

} // namespace hemicube::radiosity
