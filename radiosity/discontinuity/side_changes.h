#pragma once

#include <cstddef>
#include <span>

namespace hemicube::radiosity {

/// Where the border of a convex polygon changes sides of a line or plane: it does so twice.
struct SideChange {
  std::size_t corner = 0; ///< at this one, or on the edge that follows it
  double share = 0;       ///< of that edge; 0 at the corner
};

/// @param side     [corner] signed distance; 0 = on it
/// @param changes  receives both, in the order of corners; of corners that lie on it one after the
///                 other the last
/// @return false if the polygon is on one side, or rounding has folded it
inline bool find_side_changes(std::span<const double> side, SideChange (&changes)[2]) noexcept {
  const std::size_t count = side.size();
  double last = 0; // of the last corner off it
  for (std::size_t k = count; k-- > 0 && last == 0;)
    last = side[k];
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double here = side[k], there = side[k + 1 == count ? 0 : k + 1];
    last = here != 0 ? here : last;
    if (there == 0 || (last > 0) == (there > 0))
      continue;
    if (found == 2)
      return false;
    changes[found++] = {k, here == 0 ? 0 : here / (here - there)};
  }
  return found == 2;
}

} // namespace hemicube::radiosity
