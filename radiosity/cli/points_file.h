#pragma once

#include "radiosity/radiosity.h"

#include <string>
#include <vector>

namespace hemicube::radiosity::cli {

/// Reads receivers from a CSV file with the columns x,y,z,nx,ny,nz and a header that says so.
/// @return kBadScene, FILE:LINE: what is wrong
Status read_points(const std::string& path, std::vector<Receiver>* points);

} // namespace hemicube::radiosity::cli
