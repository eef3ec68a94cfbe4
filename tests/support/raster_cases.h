#pragma once

#include "radiosity/hemicube/five_views.h"
#include "tests/support/scenes_shared.h"

#include <string>
#include <vector>

/// Sets of polygons, each with views, that have caught rasterizers out.
namespace hemicube::test {

struct RasterCase {
  std::string name;
  PolygonSet polygons;
  std::vector<raster::View> views;
  bool crossing = false; ///< surfaces intersect, so depths may tie by chance
};

/// Builders of all cases, named after what they hold.
extern RasterCase (*const kRasterCases[11])();

/// A closed scene without T-vertices: no patch may see space or a back.
struct ClosedScene {
  std::string name;
  Scene scene;
};
extern ClosedScene (*const kClosedScenes[6])();

} // namespace hemicube::test
