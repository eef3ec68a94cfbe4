#include "radiosity/form_factor/row_accumulator.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace hemicube::radiosity {
namespace {

/// Up to this many ids have a slot of their own.
constexpr std::uint64_t kMostSlots = std::uint64_t{1} << 20;

/// Sorts entries by id: a heap, so that two arrays can be sorted as one without more memory. Ids
/// are unique.
void sort_entries(std::uint32_t* ids, float* values, std::size_t count) {
  const auto swap_entries = [&](std::size_t a, std::size_t b) {
    std::swap(ids[a], ids[b]);
    std::swap(values[a], values[b]);
  };
  const auto sink = [&](std::size_t at, std::size_t end) {
    for (std::size_t child = 2 * at + 1; child < end; child = 2 * at + 1) {
      if (child + 1 < end && ids[child] < ids[child + 1])
        ++child;
      if (ids[at] >= ids[child])
        return;
      swap_entries(at, child);
      at = child;
    }
  };
  for (std::size_t k = count / 2; k-- > 0;)
    sink(k, count);
  for (std::size_t end = count; end > 1;) {
    swap_entries(0, --end);
    sink(0, end);
  }
}

} // namespace

Status RowAccumulator::init(std::uint64_t id_count, std::uint64_t most_entries) {
  const std::uint64_t bounded = std::min(id_count, std::max(kMostSlots, 2 * most_entries + 2));
  // Whole groups of blocks: take looks at 8 marks at a time.
  const std::uint64_t slot_count = std::max<std::uint64_t>(std::bit_ceil(bounded), 8 * kBlock);
  mask_ = static_cast<std::uint32_t>(slot_count - 1);
  in_order_ = id_count <= slot_count;
  ids_.clear();
  weights_.clear();
  touched_.clear();
  HC_TRY(ids_.reserve_huge(slot_count));
  HC_TRY(weights_.reserve_huge(slot_count));
  HC_TRY(ids_.resize(slot_count, kFree));
  HC_TRY(weights_.resize(slot_count));
  return touched_.resize(slot_count / kBlock);
}

std::size_t RowAccumulator::take_block(std::uint32_t first, double unit, std::uint32_t* ids,
                                       float* values) noexcept {
  std::size_t count = 0;
  for (std::uint32_t slot = first; slot < first + kBlock; ++slot) {
    // No branch: whether a patch is seen cannot be predicted.
    const std::uint64_t weight = weights_[slot];
    ids[count] = ids_[slot];
    values[count] =
        static_cast<float>(static_cast<double>(static_cast<std::int64_t>(weight)) * unit);
    count += weight != 0 ? 1 : 0;
  }
  std::fill_n(ids_.data() + first, kBlock, kFree);
  std::fill_n(weights_.data() + first, kBlock, 0);
  return count;
}

std::size_t RowAccumulator::take(double unit, std::uint32_t* ids, float* values) noexcept {
  std::size_t count = 0;
  for (std::size_t group = 0; group < touched_.size(); group += 8) {
    std::uint64_t marks = 0;
    std::memcpy(&marks, touched_.data() + group, 8);
    if (marks == 0)
      continue;
    for (std::size_t block = group; block < group + 8; ++block)
      if (touched_[block] != 0)
        count += take_block(static_cast<std::uint32_t>(block * kBlock), unit, ids + count,
                            values + count);
    std::memset(touched_.data() + group, 0, 8);
  }
  if (!in_order_)
    sort_entries(ids, values, count);
  return count;
}

} // namespace hemicube::radiosity
