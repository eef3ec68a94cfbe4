#include "raster/polygon_groups.h"

#include "raster/kernels.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace hemicube::raster {
namespace {

using Range = std::span<std::uint32_t>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A group that faces in several directions counts as this many of one.
constexpr double kMixed = 1.2;

/// A group that would do as a cluster is divided where that leaves less than this of its cost.
constexpr double kWorthDividing = 0.5;
constexpr std::size_t kSmallestDivided = 8;

/// Larger groups are divided between bins, smaller ones anywhere.
constexpr std::size_t kMostSorted = 256;
constexpr int kBins = 32;

/// Deeper groups are halved: a path down the tree never gets long, whatever the scene.
constexpr int kDeepest = 64;

/// Several polygons.
struct Sum {
  Vec3 low = Vec3(kInfinity), high = Vec3(-kInfinity);
  std::size_t count = 0, facing[kDirections] = {};
  std::uint32_t corner_classes = 0; ///< bits

  void add(const Vec3& other_low, const Vec3& other_high) {
    low = Vec3(std::min(low.x, other_low.x), std::min(low.y, other_low.y),
               std::min(low.z, other_low.z));
    high = Vec3(std::max(high.x, other_high.x), std::max(high.y, other_high.y),
                std::max(high.z, other_high.z));
  }
  void add(const Groupable& polygon) {
    add(polygon.low, polygon.high);
    ++count;
    ++facing[polygon.direction];
    corner_classes |= 1u << polygon.corner_class;
  }
  void add(const Sum& other) {
    add(other.low, other.high);
    count += other.count;
    for (int d = 0; d < kDirections; ++d)
      facing[d] += other.facing[d];
    corner_classes |= other.corner_classes;
  }

  double area() const {
    if (count == 0)
      return 0;
    const Vec3 size = high - low;
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
  /// The surface of the clusters that it will be divided into.
  double cost() const {
    const auto clusters = [](std::size_t polygons) {
      return static_cast<double>((polygons + kBatch - 1) / kBatch);
    };
    double apart = 0;
    for (const std::size_t polygons : facing)
      apart += clusters(polygons);
    return area() * std::min(apart, kMixed * clusters(count));
  }
};

double middle(const Groupable& polygon, int axis) {
  return polygon.low[axis] * 0.5 + polygon.high[axis] * 0.5;
}

/// A way to divide a group in two.
struct Division {
  enum Kind : std::uint8_t { kNone, kSorted, kBinned, kDirection } kind = kNone;
  int axis = 0;          ///< or the direction
  std::size_t begin = 0; ///< rank, or bin, of the first of the second half
  double cost = kInfinity;
};

/// Bins along one axis.
struct Bins {
  double low = 0, per_length = 0;

  int of(double at) const {
    return std::clamp(static_cast<int>((at - low) * per_length), 0, kBins - 1);
  }
};

class Grouper {
public:
  Grouper(std::span<const Groupable> polygons, std::span<std::uint32_t> order,
          Buffer<Group>* groups)
      : polygons_(polygons), order_(order), groups_(*groups) {}

  Status divide(std::size_t first, std::size_t count, int depth, std::uint32_t* index);

private:
  void sort(Range group, int axis) const;
  Bins bins(Range group, int axis) const;
  void try_sorted(Range group, int axis, Division* best) const;
  void try_binned(Range group, int axis, Division* best) const;
  void try_directions(Range group, Division* best) const;
  std::size_t apply(Range group, const Division& division) const;
  std::size_t apart_by_corners(Range group) const;

  std::span<const Groupable> polygons_;
  std::span<std::uint32_t> order_;
  Buffer<Group>& groups_;
};

void Grouper::sort(Range group, int axis) const {
  std::sort(group.begin(), group.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = middle(polygons_[a], axis), at_b = middle(polygons_[b], axis);
    return at_a != at_b ? at_a < at_b : a < b;
  });
}

void Grouper::try_sorted(Range group, int axis, Division* best) const {
  sort(group, axis);
  double costs[kMostSorted];
  Sum sum;
  for (std::size_t k = group.size() - 1; k > 0; --k) {
    sum.add(polygons_[group[k]]);
    costs[k] = sum.cost();
  }
  sum = Sum();
  for (std::size_t k = 1; k < group.size(); ++k) {
    sum.add(polygons_[group[k - 1]]);
    // cppcheck-suppress uninitvar ; the loop above ran over the same k
    if (const double cost = sum.cost() + costs[k]; cost < best->cost)
      *best = {Division::kSorted, axis, k, cost};
  }
}

Bins Grouper::bins(Range group, int axis) const {
  double low = kInfinity, high = -kInfinity;
  for (const std::uint32_t p : group) {
    low = std::min(low, middle(polygons_[p], axis));
    high = std::max(high, middle(polygons_[p], axis));
  }
  return {low, high > low ? kBins / (high - low) : 0};
}

void Grouper::try_binned(Range group, int axis, Division* best) const {
  const Bins bins_of = bins(group, axis);
  Sum bin[kBins];
  for (const std::uint32_t p : group)
    bin[bins_of.of(middle(polygons_[p], axis))].add(polygons_[p]);
  double costs[kBins];
  Sum sum;
  for (int k = kBins - 1; k > 0; --k) {
    sum.add(bin[k]);
    costs[k] = sum.count != 0 ? sum.cost() : kInfinity;
  }
  sum = Sum();
  for (int k = 1; k < kBins; ++k) {
    sum.add(bin[k - 1]);
    if (const double cost = sum.cost() + costs[k]; sum.count != 0 && cost < best->cost)
      *best = {Division::kBinned, axis, static_cast<std::size_t>(k), cost};
  }
}

/// One direction against all others.
void Grouper::try_directions(Range group, Division* best) const {
  Sum of[kDirections];
  for (const std::uint32_t p : group)
    of[polygons_[p].direction].add(polygons_[p]);
  for (int d = 0; d < kDirections; ++d) {
    Sum others;
    for (int k = 0; k < kDirections; ++k)
      if (k != d)
        others.add(of[k]);
    if (of[d].count == 0 || others.count == 0)
      continue;
    if (const double cost = of[d].cost() + others.cost(); cost < best->cost)
      *best = {Division::kDirection, d, 0, cost};
  }
}

/// @return the size of the first half, now at the front
std::size_t Grouper::apply(Range group, const Division& division) const {
  if (division.kind == Division::kSorted) {
    sort(group, division.axis);
    return division.begin;
  }
  const auto to_front = [&](auto is_first) {
    return static_cast<std::size_t>(std::partition(group.begin(), group.end(), is_first) -
                                    group.begin());
  };
  if (division.kind == Division::kDirection)
    return to_front([&](std::uint32_t p) { return polygons_[p].direction == division.axis; });
  if (division.kind == Division::kBinned) {
    const Bins bins_of = bins(group, division.axis);
    return to_front([&](std::uint32_t p) {
      return bins_of.of(middle(polygons_[p], division.axis)) < static_cast<int>(division.begin);
    });
  }
  return group.size() / 2;
}

std::size_t Grouper::apart_by_corners(Range group) const {
  const std::uint8_t corner_class = polygons_[group[0]].corner_class;
  const auto end = std::partition(group.begin(), group.end(), [&](std::uint32_t p) {
    return polygons_[p].corner_class == corner_class;
  });
  return static_cast<std::size_t>(end - group.begin());
}

Status Grouper::divide(std::size_t first, std::size_t count, int depth, std::uint32_t* index) {
  *index = static_cast<std::uint32_t>(groups_.size());
  const Range group = order_.subspan(first, count);
  Sum sum;
  for (const std::uint32_t p : group)
    sum.add(polygons_[p]);
  HC_TRY(groups_.push_back({static_cast<std::uint32_t>(first),
                            static_cast<std::uint32_t>(count),
                            {Group::kNone, Group::kNone},
                            1,
                            sum.area()}));
  std::size_t first_count = 0;
  const bool one_kind = std::popcount(sum.corner_classes) == 1;
  if (count <= kBatch && !one_kind) {
    first_count = apart_by_corners(group);
  } else {
    if (count < kSmallestDivided)
      return {};
    Division best;
    if (depth < kDeepest) {
      try_directions(group, &best);
      for (int axis = 0; axis < 3; ++axis)
        if (count <= kMostSorted)
          try_sorted(group, axis, &best);
        else
          try_binned(group, axis, &best);
    }
    if (count <= kBatch && !(best.cost < kWorthDividing * sum.cost()))
      return {};
    first_count = apply(group, best);
  }
  if (first_count == 0 || first_count == count)
    first_count = count / 2;
  for (int half = 0; half < 2; ++half) {
    std::uint32_t child = 0;
    HC_TRY(divide(half == 0 ? first : first + first_count,
                  half == 0 ? first_count : count - first_count, depth + 1, &child));
    groups_[*index].halves[half] = child;
  }
  const std::uint32_t* halves = groups_[*index].halves;
  groups_[*index].clusters = groups_[halves[0]].clusters + groups_[halves[1]].clusters;
  return {};
}

} // namespace

Status group_polygons(std::span<const Groupable> polygons, std::span<std::uint32_t> order,
                      Buffer<Group>* groups) {
  groups->clear();
  if (order.empty())
    return {};
  std::uint32_t root = 0;
  return Grouper(polygons, order, groups).divide(0, order.size(), 0, &root);
}

} // namespace hemicube::raster
