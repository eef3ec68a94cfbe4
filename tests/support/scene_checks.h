#pragma once

#include "radiosity/mesh/patch_set.h"
#include "radiosity/scene/scene.h"

#include <string>

/// What scenes and meshes promise, checked without a test framework: fuzzers ask too.
namespace hemicube::test {

/// What is wrong with a scene that a reader has filled, by all that scene.h promises; empty if
/// nothing is.
std::string scene_problem(const radiosity::Scene& scene);

/// The same of the patches that were made of it, backs included: corners in range, areas and
/// centres numbers, normals of length 1, fronts in the order of their faces.
std::string mesh_problem(const radiosity::Scene& scene, const radiosity::PatchSet& patches);

} // namespace hemicube::test
