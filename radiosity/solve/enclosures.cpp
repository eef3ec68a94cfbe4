#include "radiosity/solve/enclosures.h"

namespace hemicube::radiosity {

std::uint32_t EnclosureFinder::Sets::root(std::uint32_t i) noexcept {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

/// @return the root of both
std::uint32_t EnclosureFinder::Sets::join(std::uint32_t a, std::uint32_t b) noexcept {
  a = root(a);
  b = root(b);
  const std::uint32_t low = a < b ? a : b;
  parent[a] = parent[b] = low;
  return low;
}

Status EnclosureFinder::init(const LightProblem& problem, std::size_t worker_count) {
  const std::size_t count = problem.patch_count();
  HC_TRY(of_worker_.init(worker_count));
  for (Sets& sets : of_worker_) {
    HC_TRY(sets.parent.resize(count));
    for (std::size_t i = 0; i < count; ++i)
      sets.parent[i] = problem.is_black(i) ? Enclosures::kNone : static_cast<std::uint32_t>(i);
  }
  is_open_.clear();
  return is_open_.resize(count);
}

void EnclosureFinder::add_row(std::size_t worker, std::uint32_t patch,
                              const RowView& row) noexcept {
  Sets& sets = of_worker_[worker];
  bool sees_black = false;
  std::uint32_t root = sets.root(patch);
  for (const std::uint32_t j : row.columns) {
    const std::uint32_t parent = sets.parent[j];
    if (parent == root)
      continue;
    if (parent == Enclosures::kNone)
      sees_black = true;
    else
      root = sets.join(root, j);
  }
  is_open_[patch] = sees_black || row.space != 0 || row.back_side != 0;
}

Status EnclosureFinder::finish(Enclosures* enclosures) {
  Sets& all = of_worker_[0];
  const std::size_t count = all.parent.size();
  for (std::size_t worker = 1; worker < of_worker_.size(); ++worker)
    for (std::uint32_t i = 0; i < count; ++i)
      if (const std::uint32_t parent = of_worker_[worker].parent[i]; parent != Enclosures::kNone)
        all.join(i, parent);
  enclosures->of_patch.clear();
  enclosures->first_patch.clear();
  HC_TRY(enclosures->of_patch.resize(count, Enclosures::kNone));
  for (std::uint32_t i = 0; i < count; ++i) {
    if (all.parent[i] == Enclosures::kNone)
      continue;
    const std::uint32_t root = all.root(i);
    if (root == i) { // the lowest of its set: seen before all others
      enclosures->of_patch[i] = static_cast<std::uint32_t>(enclosures->first_patch.size());
      HC_TRY(enclosures->first_patch.push_back(i));
    } else {
      enclosures->of_patch[i] = enclosures->of_patch[root];
    }
  }
  enclosures->is_open.swap(is_open_);
  return {};
}

namespace {

/// Spreads, until nothing changes, what is lost: light gets lost in a band where a patch that is
/// seen loses it.
/// @param loses  [patch][band] in: a patch's own reflection or opening loses light
Status spread_losses(const FormFactorMatrix& matrix, std::uint32_t bands,
                     Buffer<std::uint8_t>* loses) {
  const auto keeps_any = [&](std::uint64_t i) {
    for (std::uint32_t b = 0; b < bands; ++b)
      if ((*loses)[i * bands + b] == 0)
        return true;
    return false;
  };
  for (bool changed = true, any_left = true; changed && any_left;) {
    changed = any_left = false;
    HC_TRY(matrix.for_each_range([&](std::size_t first, std::size_t last) {
      for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i) {
        if (!keeps_any(i))
          continue;
        for (const std::uint64_t j : matrix.row(i).columns)
          for (std::uint32_t b = 0; b < bands; ++b)
            if ((*loses)[i * bands + b] == 0 && (*loses)[j * bands + b] != 0)
              (*loses)[i * bands + b] = changed = true;
        any_left = any_left || keeps_any(i);
      }
      return Status();
    }));
  }
  return {};
}

Status refuse(const LightProblem& problem, std::size_t patch, std::uint32_t band) {
  return Status::error(StatusCode::kSingular, "no solution: the enclosure of patch ", patch,
                       " reflects everything in band ",
                       problem.band_names.empty() ? "" : problem.band_names[band],
                       ", is closed, and has light: lower a reflectance below 1, or open it");
}

} // namespace

Status check_enclosures(const LightProblem& problem, const Enclosures& enclosures,
                        std::span<const double> source) {
  const std::uint32_t bands = problem.band_count;
  Buffer<std::uint8_t> loses; // [enclosure][band]
  HC_TRY(loses.resize(enclosures.first_patch.size() * bands));
  for (std::size_t i = 0; i < problem.patch_count(); ++i)
    if (const std::size_t e = enclosures.of_patch[i]; e != Enclosures::kNone)
      for (std::uint32_t b = 0; b < bands; ++b)
        loses[e * bands + b] |=
            problem.reflectance[i * bands + b] < 1 || enclosures.is_open[i] != 0;
  for (std::uint32_t b = 0; b < bands; ++b)
    for (std::size_t i = 0; i < problem.patch_count(); ++i)
      if (const std::size_t e = enclosures.of_patch[i];
          e != Enclosures::kNone && loses[e * bands + b] == 0 && source[i * bands + b] > 0)
        return refuse(problem, i, b);
  return {};
}

Status check_solvable(const FormFactorMatrix& matrix, const LightProblem& problem,
                      const Enclosures& enclosures, std::span<const double> source) {
  const std::uint32_t bands = problem.band_count;
  const std::size_t count = problem.patch_count();
  Buffer<std::uint8_t> loses; // [patch][band]
  HC_TRY(loses.resize(count * bands));
  bool any_keeps = false;
  for (std::size_t i = 0; i < count; ++i)
    for (std::uint32_t b = 0; b < bands; ++b) {
      loses[i * bands + b] = enclosures.of_patch[i] == Enclosures::kNone ||
                             problem.reflectance[i * bands + b] < 1 || enclosures.is_open[i] != 0;
      any_keeps = any_keeps || loses[i * bands + b] == 0;
    }
  if (!any_keeps)
    return {};
  HC_TRY(spread_losses(matrix, bands, &loses));
  for (std::uint32_t band = 0; band < bands; ++band)
    for (std::size_t i = 0; i < count; ++i)
      if (loses[i * bands + band] == 0 && source[i * bands + band] > 0)
        return refuse(problem, i, band);
  return {};
}

} // namespace hemicube::radiosity
