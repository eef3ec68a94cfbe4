#pragma once

#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Sums weights by patch id. A hash table that is the identity while ids are below its size, so
/// neighbours in a scene stay neighbours in memory; cleared by touching only what was used.
class RowAccumulator {
public:
  struct Entry {
    std::uint32_t id;
    std::uint32_t slot;
    std::uint64_t weight;
  };

  /// @param most_entries  distinct ids added between two calls of clear, at most
  Status init(std::uint64_t most_entries);

  void add(std::uint32_t id, std::uint64_t weight) noexcept {
    std::uint32_t slot = id & mask_;
    while (slots_[slot] != kFree) {
      Entry& entry = entries_[slots_[slot]];
      if (entry.id == id) {
        entry.weight += weight;
        return;
      }
      slot = (slot + 1) & mask_;
    }
    slots_[slot] = count_;
    entries_[count_++] = {id, slot, weight};
  }

  /// What was added since the last clear, by ascending id. After it only clear may be called.
  std::span<const Entry> sorted() noexcept;

  void clear() noexcept;

private:
  static constexpr std::uint32_t kFree = 0xffffffffu;

  std::uint32_t mask_ = 0;
  std::uint32_t count_ = 0;
  Buffer<std::uint32_t> slots_; ///< index of an entry, or kFree
  Buffer<Entry> entries_;
};

} // namespace hemicube::radiosity
