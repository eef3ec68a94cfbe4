#include "radiosity/form_factor/row_accumulator.h"

#include <algorithm>
#include <bit>

namespace hemicube::radiosity {

Status RowAccumulator::init(std::uint64_t most_entries) {
  const std::uint64_t slot_count = std::bit_ceil(2 * most_entries + 2);
  mask_ = static_cast<std::uint32_t>(slot_count - 1);
  count_ = 0;
  slots_.clear();
  HC_TRY(slots_.resize(slot_count, kFree));
  return entries_.resize(most_entries + 1);
}

std::span<const RowAccumulator::Entry> RowAccumulator::sorted() noexcept {
  // Ids are unique: no ties.
  std::sort(entries_.begin(), entries_.begin() + count_,
            [](const Entry& a, const Entry& b) { return a.id < b.id; });
  return {entries_.data(), count_};
}

void RowAccumulator::clear() noexcept {
  for (std::uint32_t k = 0; k < count_; ++k)
    slots_[entries_[k].slot] = kFree;
  count_ = 0;
}

} // namespace hemicube::radiosity
