#include "radiosity/solve/enclosures.h"

namespace hemicube::radiosity {
namespace {

/// Union by lowest number, with path halving.
class DisjointSets {
public:
  Status init(std::size_t count) {
    HC_TRY(parent_.resize(count));
    for (std::size_t i = 0; i < count; ++i)
      parent_[i] = static_cast<std::uint32_t>(i);
    return {};
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a < b)
      parent_[b] = a;
    else
      parent_[a] = b;
  }

private:
  Buffer<std::uint32_t> parent_;
};

/// What a patch loses by itself: to space, to back sides, or to black patches.
bool is_open(const RowView& row, const Enclosures& enclosures) {
  if (row.space != 0 || row.back_side != 0)
    return true;
  for (const std::uint32_t column : row.columns)
    if (enclosures.of_patch[column] == Enclosures::kNone)
      return true;
  return false;
}

/// Marks the patches whose light can get lost in a band: their own reflection or opening loses it,
/// or a patch they see does, directly or through others.
Status find_losses(const FormFactorMatrix& matrix, const LightProblem& problem,
                   const Enclosures& enclosures, std::uint32_t band, Buffer<std::uint8_t>* loses) {
  const std::size_t count = problem.patch_count();
  loses->clear();
  HC_TRY(loses->resize(count));
  for (std::size_t i = 0; i < count; ++i)
    (*loses)[i] = enclosures.of_patch[i] == Enclosures::kNone ||
                  problem.reflectance[i * problem.band_count + band] < 1 ||
                  is_open(matrix.row(i), enclosures);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < count; ++i)
      for (const std::uint32_t j : matrix.row(i).columns)
        if ((*loses)[i] == 0 && (*loses)[j] != 0)
          (*loses)[i] = changed = true;
  }
  return {};
}

} // namespace

Status find_enclosures(const FormFactorMatrix& matrix, const LightProblem& problem,
                       Enclosures* enclosures) {
  const std::size_t count = problem.patch_count();
  DisjointSets sets;
  HC_TRY(sets.init(count));
  HC_TRY(enclosures->of_patch.resize(count, Enclosures::kNone));
  for (std::uint32_t i = 0; i < count; ++i) {
    if (problem.is_black(i))
      continue;
    for (const std::uint32_t j : matrix.row(i).columns)
      if (!problem.is_black(j))
        sets.join(i, j);
  }
  enclosures->first_patch.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (problem.is_black(i))
      continue;
    const std::uint32_t root = sets.root(i);
    if (root == i) { // the lowest of its set: seen before all others
      enclosures->of_patch[i] = static_cast<std::uint32_t>(enclosures->first_patch.size());
      HC_TRY(enclosures->first_patch.push_back(i));
    } else {
      enclosures->of_patch[i] = enclosures->of_patch[root];
    }
  }
  return {};
}

Status check_solvable(const FormFactorMatrix& matrix, const LightProblem& problem,
                      const Enclosures& enclosures, std::span<const double> source) {
  const std::uint32_t bands = problem.band_count;
  Buffer<std::uint8_t> loses;
  for (std::uint32_t band = 0; band < bands; ++band) {
    bool any_white = false;
    for (std::size_t i = 0; i < problem.patch_count(); ++i)
      any_white = any_white || problem.reflectance[i * bands + band] == 1;
    if (!any_white)
      continue;
    HC_TRY(find_losses(matrix, problem, enclosures, band, &loses));
    for (std::size_t i = 0; i < problem.patch_count(); ++i)
      if (loses[i] == 0 && source[i * bands + band] > 0)
        return Status::error(StatusCode::kSingular, "no solution: the enclosure of patch ", i,
                             " reflects everything in band ",
                             problem.band_names.empty() ? "" : problem.band_names[band],
                             ", is closed, and has light: lower a reflectance below 1, or open it");
  }
  return {};
}

} // namespace hemicube::radiosity
