#pragma once

#include <bit>
#include <cstdint>

namespace hemicube {

/// A running 64-bit hash of numbers, the same on every machine: it mixes values, not memory. For
/// telling results apart; not for security.
class Hash {
public:
  explicit Hash(std::uint64_t seed = 0) noexcept : state_(seed ^ 0x9e3779b97f4a7c15u) {}

  void add(std::uint64_t word) noexcept {
    // Two multiply-xorshift rounds: every bit of the word reaches every bit of the state.
    std::uint64_t mixed = (state_ ^ word) * 0xff51afd7ed558ccdu;
    mixed ^= mixed >> 32;
    mixed *= 0xc4ceb9fe1a85ec53u;
    state_ = mixed ^ (mixed >> 29);
  }
  void add(std::uint32_t word) noexcept { add(static_cast<std::uint64_t>(word)); }
  void add(double value) noexcept { add(std::bit_cast<std::uint64_t>(value)); }
  void add(float value) noexcept { add(std::bit_cast<std::uint32_t>(value)); }

  std::uint64_t value() const noexcept { return state_; }

private:
  std::uint64_t state_;
};

} // namespace hemicube
