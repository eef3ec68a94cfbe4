#pragma once

#include "raster/memory.h"

#include <cstdint>

namespace hemicube::radiosity {

/// Sums weights by patch id. A hash table that is the identity while ids are below its size: then
/// neighbours in a scene are neighbours in memory, and entries come out in order without sorting.
class RowAccumulator {
public:
  /// @param id_count      ids are below it
  /// @param most_entries  distinct ids added between two calls of take, at most
  Status init(std::uint64_t id_count, std::uint64_t most_entries);

  /// @param weight  > 0
  void add(std::uint32_t id, std::uint64_t weight) noexcept {
    std::uint32_t slot = id & mask_;
    while (ids_[slot] != id) {
      if (ids_[slot] == kFree) {
        ids_[slot] = id;
        break;
      }
      slot = (slot + 1) & mask_;
    }
    weights_[slot] += weight;
    touched_[slot / kBlock] = 1;
  }

  /// Writes the ids that were added since the last call, ascending, and weight * unit for each, and
  /// forgets them. Both arrays have room for one entry more than there are.
  /// @return how many
  std::size_t take(double unit, std::uint32_t* ids, float* values) noexcept;

private:
  static constexpr std::uint32_t kFree = 0xffffffffu;
  static constexpr std::uint32_t kBlock = 16;

  std::size_t take_block(std::uint32_t first, double unit, std::uint32_t* ids,
                         float* values) noexcept;

  std::uint32_t mask_ = 0;
  bool in_order_ = true;          ///< slots are ids
  Buffer<std::uint32_t> ids_;     ///< [slot] kFree if there is none
  Buffer<std::uint64_t> weights_; ///< [slot]
  Buffer<std::uint8_t> touched_;  ///< [slot / kBlock] 1 if the block may hold an entry
};

} // namespace hemicube::radiosity
