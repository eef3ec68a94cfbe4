#include "radiosity/refine/element_rows.h"

#include "radiosity/form_factor/area_to_area.h"
#include "radiosity/form_factor/lambert.h"
#include "raster/fp_environment.h"

#include <algorithm>

namespace hemicube::radiosity {
namespace {

/// Beyond so many times the size of a patch, its elements and those that see it are points.
constexpr double kFar = 3;
/// Relative, of what two elements exchange when it is a share only.
constexpr double kShareError = 1e-2;

/// The elements of each patch, as senders.
class Senders {
public:
  Senders(const ElementTree& tree, const PatchSet& elements) {
    const std::vector<std::uint32_t> leaves = tree.leaves();
    std::vector<std::size_t> offsets; // [element] corners
    std::vector<Vec3> corners;
    std::uint32_t patch = ElementTree::kNone;
    std::size_t leaf = 0;
    for (std::uint32_t element = 0; element < elements.patch_count(); ++element) {
      if (elements.parent[element] != patch) {
        patch = elements.parent[element];
        first_.push_back(element);
      }
      const bool is_back = element >= elements.front_count;
      leaf = element == elements.front_count ? 0 : leaf;
      while (is_back && tree.side_count(leaves[leaf]) == 1)
        ++leaf;
      tree.corners_of(leaves[leaf++], &corners);
      if (is_back)
        std::reverse(corners.begin(), corners.end());
      offsets.push_back(corners_.size());
      corners_.insert(corners_.end(), corners.begin(), corners.end());
    }
    first_.push_back(elements.patch_count());
    offsets.push_back(corners_.size());
    for (std::uint32_t e = 0; e < elements.patch_count(); ++e)
      areas_.push_back(prepare_area({corners_.data() + offsets[e], offsets[e + 1] - offsets[e]},
                                    elements.normal[e]));
    for (std::size_t p = 0; p + 1 < first_.size(); ++p) {
      Vec3 low = corners_[offsets[first_[p]]], high = low;
      for (std::size_t c = offsets[first_[p]]; c < offsets[first_[p + 1]]; ++c) {
        low = glm::min(low, corners_[c]);
        high = glm::max(high, corners_[c]);
      }
      middles_.push_back(0.5 * (low + high));
      sizes_.push_back(glm::length(high - low));
    }
  }

  std::uint32_t first(std::uint32_t patch) const { return first_[patch]; }
  std::uint32_t count(std::uint32_t patch) const { return first_[patch + 1] - first_[patch]; }

  /// What a receiver gets from each element of a patch, if nothing is in between, but for a factor.
  /// @param seen  receives it; not all are 0
  void exchange(std::uint32_t receiver, std::uint32_t patch, std::span<double> seen) const {
    const PreparedArea& area = areas_[receiver];
    const Vec3 away = middles_[patch] - area.centre;
    const double far = kFar * std::max(sizes_[patch], 2 * area.radius);
    const bool is_far = glm::dot(away, away) > far * far;
    const bool is_integrated =
        !is_far && area.corners.size() <= std::size_t{ConvexPolygon::kMaxCorners};
    bool is_seen = false;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const PreparedArea& sender = areas_[first(patch) + k];
      seen[k] = is_integrated ? exchange_area(area, sender, kShareError).value
                : is_far      ? between_centres(area, sender)
                              : point_to_polygon(area.centre, area.normal, sender.corners);
      seen[k] = std::max(seen[k], 0.0);
      is_seen = is_seen || seen[k] > 0;
    }
    for (std::size_t k = 0; k < seen.size() && !is_seen; ++k) // the pixels know better
      seen[k] = areas_[first(patch) + k].area;
  }

private:
  /// What two small areas exchange, but for a factor.
  static double between_centres(const PreparedArea& a, const PreparedArea& b) {
    const Vec3 way = b.centre - a.centre;
    const double squared = glm::dot(way, way);
    const double cosines =
        std::max(0.0, glm::dot(a.normal, way)) * std::max(0.0, -glm::dot(b.normal, way));
    return cosines * b.area / (squared * squared);
  }

  std::vector<std::uint32_t> first_; ///< [patch + 1] elements
  std::vector<Vec3> corners_;
  std::vector<PreparedArea> areas_; ///< [element]
  std::vector<Vec3> middles_;       ///< [patch]
  std::vector<double> sizes_;       ///< [patch]
};

} // namespace

/// A row over elements from one over patches. One per worker.
class ElementRows::Divider {
public:
  void begin(const Senders& senders) { senders_ = &senders; }

  /// @param known  shares found before; those that are still good are used again
  /// @param row    receives what is valid until the next call
  Status divide(std::uint32_t receiver, const RowView& gathered, Shares* known, RowView* row) {
    columns_.clear();
    values_.clear();
    shares_.counts.clear();
    shares_.values.clear();
    std::size_t at = 0;
    for (std::size_t k = 0; k < gathered.columns.size(); ++k) {
      const std::uint32_t patch = gathered.columns[k];
      const std::uint32_t first = senders_->first(patch), count = senders_->count(patch);
      const std::uint32_t old = k < known->counts.size() ? known->counts[k] : 1;
      HC_TRY(shares_.counts.push_back(count));
      if (count == 1) {
        HC_TRY(columns_.push_back(first));
        HC_TRY(values_.push_back(gathered.values[k]));
        continue;
      }
      const std::size_t begin = shares_.values.size();
      HC_TRY(shares_.values.resize(begin + count));
      const auto shares = shares_.values.span().subspan(begin, count);
      if (old == count) // patches are never put together again
        std::copy_n(known->values.begin() + at, count, shares.begin());
      else
        HC_TRY(share(receiver, patch, shares));
      at += old > 1 ? old : 0;
      for (std::uint32_t e = 0; e < count; ++e) {
        const float value = gathered.values[k] * shares[e];
        if (value > 0) {
          HC_TRY(columns_.push_back(first + e));
          HC_TRY(values_.push_back(value));
        }
      }
    }
    known->counts.swap(shares_.counts);
    known->values.swap(shares_.values);
    *row = gathered;
    row->columns = columns_.span();
    row->values = values_.span();
    if (columns_.size() != gathered.columns.size())
      fit_scale(1 - row->space - row->back_side, row);
    return {};
  }

private:
  /// @param shares  receives what an element of the patch sends of what all of it does
  Status share(std::uint32_t receiver, std::uint32_t patch, std::span<float> shares) {
    HC_TRY(seen_.resize(shares.size()));
    senders_->exchange(receiver, patch, seen_.span());
    double sum = 0;
    for (const double seen : seen_)
      sum += seen;
    for (std::size_t k = 0; k < shares.size(); ++k)
      shares[k] = static_cast<float>(seen_[k] / sum);
    return {};
  }

  const Senders* senders_ = nullptr;
  Buffer<double> seen_; ///< [element of the patch at hand]
  Buffer<std::uint32_t> columns_;
  Buffer<float> values_;
  Shares shares_;
};

Status ElementRows::begin_round(std::uint64_t row_count, std::uint32_t patch_count,
                                FormFactorMatrix** rows) {
  rounds_.push_back(std::make_unique<Round>());
  rounds_.back()->shares.resize(row_count);
  *rows = &rounds_.back()->rows;
  return rounds_.back()->rows.init(row_count, patch_count);
}

void ElementRows::assign(std::uint32_t node, unsigned side, std::uint64_t index) {
  std::vector<Place>& places = places_[side];
  if (places.size() <= node)
    places.resize(std::size_t{node} + 1);
  places[node] = {static_cast<std::uint32_t>(rounds_.size() - 1), index};
}

Status ElementRows::make_matrix(const ElementTree& tree, const PatchSet& elements,
                                Executor& executor, FormFactorMatrix* matrix) {
  const std::uint32_t count = elements.patch_count();
  const Senders senders(tree, elements);
  std::vector<Place> places; // [element]
  for (const unsigned side : {0u, 1u})
    for (const std::uint32_t leaf : tree.leaves())
      if (side < tree.side_count(leaf))
        places.push_back(places_[side][leaf]);
  std::vector<Divider> dividers(executor.worker_count());
  for (Divider& divider : dividers)
    divider.begin(senders);
  HC_TRY(matrix->init(count, count));
  return executor.for_each(matrix->block_count(), [&](std::size_t block, std::size_t worker) {
    const FloatEnvironment environment;
    for (std::uint64_t i = matrix->block_begin(block); i < matrix->block_end(block); ++i) {
      const Place& place = places[i];
      Round& round = *rounds_[place.round];
      RowView row;
      HC_TRY(dividers[worker].divide(static_cast<std::uint32_t>(i), round.rows.row(place.index),
                                     &round.shares[place.index], &row));
      HC_TRY(matrix->append_row(block, row, round.rows.facts(place.index)));
    }
    return Status();
  });
}

} // namespace hemicube::radiosity
