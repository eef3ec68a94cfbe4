#pragma once

#include "radiosity/radiosity.h"

#include <vector>

namespace hemicube::radiosity::cli {

/// Moves points that are meant to lie on a patch just in front of it: numbers in a text, or of a
/// tilted patch, put them behind it as often as not, where they would see nothing but its back.
/// Meant is a point no farther behind than 1e-6 of the size of the scene that looks the way the
/// patch does; it is moved to 1e-12 of that size before it, along its normal.
void move_to_front(const PatchSet& patches, std::vector<Receiver>* points);

} // namespace hemicube::radiosity::cli
