#pragma once

#include "radiosity/refine/element_tree.h"

#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// elements.csv: how patches were cut, a line per front element: `patch,path`, the path being the
/// numbers of the pieces, from 0, that lead to the element, joined by points; empty for a patch
/// that was not cut.
std::string element_table(const ElementTree& tree);

/// Cuts patches the same way again.
/// @param text  of elements.csv; @param path  its name, for messages
/// @param tree  of patches that were not cut (ElementTree::init)
/// @return kBadScene `PATH:LINE: ...` for what is not such a table, or not one of these patches
Status read_element_table(std::string_view text, const std::string& path, ElementTree* tree);

} // namespace hemicube::radiosity
