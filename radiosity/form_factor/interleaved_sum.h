#pragma once

#include <cstddef>

namespace hemicube::radiosity {

/// term(first) + ... + term(last - 1) in the one order every part of the program sums rows in: 8
/// interleaved partial sums folded by a fixed tree.
template <typename Term>
double interleaved_sum(std::size_t first, std::size_t last, Term term) noexcept {
  double sums[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  std::size_t k = first;
  for (; k + 8 <= last; k += 8)
    for (std::size_t lane = 0; lane < 8; ++lane)
      sums[lane] += term(k + lane);
  for (std::size_t lane = 0; k < last; ++k, ++lane)
    sums[lane] += term(k);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

} // namespace hemicube::radiosity
