#pragma once

#include "raster/kernels.h"
#include "raster/memory.h"

#include <bit>
#include <cstdint>

namespace hemicube::raster {

/// A node or a cluster that a window may see.
struct Visit {
  std::uint32_t index;
  bool is_cluster;
  Range pixels;
  float nearest; ///< 1/z is nowhere larger; > 0
};

/// Visits to come, nearest first up to an eighth of an octave, in buckets: a tree walked in this
/// order draws what hides before what is hidden. Holds a fixed number of visits.
class VisitQueue {
public:
  Status init() {
    HC_TRY(entries_.resize(kCapacity));
    return heads_.resize(kBuckets);
  }

  /// Forgets all visits.
  /// @param least  1/z of what is farthest; the order of visits that lie farther is lost
  void begin(float least) noexcept {
    base_ = key_of(least);
    for (std::uint64_t& word : filled_)
      word = 0;
    // Entries are handed out in turn until one comes back.
    free_ = kNone;
    unused_ = 0;
    free_count_ = kCapacity;
  }

  bool empty() const noexcept { return free_count_ == kCapacity; }
  std::uint32_t room() const noexcept { return free_count_; }

  /// There must be room.
  void push(const Visit& visit) noexcept {
    const std::uint32_t key = key_of(visit.nearest);
    const std::uint32_t above = key > base_ ? key - base_ : 0;
    const std::uint32_t bucket = above < kBuckets ? above : kBuckets - 1;
    const std::uint32_t entry = free_ != kNone ? free_ : unused_++;
    if (free_ != kNone)
      free_ = entries_[entry].next;
    --free_count_;
    std::uint64_t& word = filled_[bucket / 64];
    const std::uint64_t bit = std::uint64_t{1} << bucket % 64;
    entries_[entry] = {visit, (word & bit) != 0 ? heads_[bucket] : kNone};
    heads_[bucket] = entry;
    word |= bit;
  }

  /// What pop would take out. There must be one.
  const Visit& front() const noexcept { return entries_[heads_[nearest_bucket()]].visit; }

  /// Takes out one of the nearest. There must be one.
  Visit pop() noexcept {
    const std::uint32_t bucket = nearest_bucket();
    const std::uint32_t entry = heads_[bucket];
    heads_[bucket] = entries_[entry].next;
    if (heads_[bucket] == kNone)
      filled_[bucket / 64] &= ~(std::uint64_t{1} << bucket % 64);
    entries_[entry].next = free_;
    free_ = entry;
    ++free_count_;
    return entries_[entry].visit;
  }

private:
  static constexpr std::uint32_t kCapacity = 2048;
  static constexpr std::uint32_t kBuckets = 256;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  struct Entry {
    Visit visit;
    std::uint32_t next;
  };

  std::uint32_t nearest_bucket() const noexcept {
    std::uint32_t w = kBuckets / 64 - 1;
    while (filled_[w] == 0)
      --w;
    return w * 64 + 63 - static_cast<std::uint32_t>(std::countl_zero(filled_[w]));
  }

  /// Exponent and three bits of the fraction.
  static std::uint32_t key_of(float value) noexcept {
    return std::bit_cast<std::uint32_t>(value) >> 20;
  }

  Buffer<Entry> entries_;
  Buffer<std::uint32_t> heads_; ///< [bucket] its first entry, where the bit in filled_ is set
  std::uint64_t filled_[kBuckets / 64] = {};
  std::uint32_t base_ = 0, free_ = kNone, unused_ = 0, free_count_ = 0;
};

} // namespace hemicube::raster
