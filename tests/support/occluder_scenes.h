#pragma once

#include "tests/support/random_scenes.h"

/// Scenes where something stands in front of something else, by little: wherever what is hidden is
/// left out, it must be hidden to the last pixel and the last bit.
namespace hemicube::test {

/// Shells of walls one behind another around the eye: gaps of 1e-3 .. 1e-7 of the distance, fronts
/// and backs, numbered in any order.
std::vector<RandomScene> nested_walls();

/// Flat walls, and just behind them narrow strips that run away from the eye: their depths, of
/// steep planes, are the least certain of all.
std::vector<RandomScene> walls_with_steep_things_behind();

/// The same where it is hardest: strips that are exactly as deep as the wall in front of them, up
/// to the last bits, in the one column of pixels where they are nearest.
std::vector<RandomScene> steep_things_at_pixel_centres();

/// Large walls whose planes pass close by the eye, with their shifted copies, among small things.
std::vector<RandomScene> grazing_walls();

/// Rectangles on pixel borders in front of others that look out by a pixel or two.
std::vector<RandomScene> cards();

/// Single small polygons on the first and last pixels of windows and tiles.
std::vector<RandomScene> window_edges();

/// Polygons that rise above the receiver's plane by around 2^-20 of their distance, in a scene that
/// reaches much farther; drawn on grids fine enough to see them.
std::vector<RandomScene> near_the_horizon();

} // namespace hemicube::test
