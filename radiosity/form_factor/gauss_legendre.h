#pragma once

namespace hemicube::radiosity {

/// A node in -1 .. 1 and its weight; the weights of a rule sum to 1.
struct GaussNode {
  double x, weight;
};

/// The Gauss-Legendre rule of so many nodes. @param order  1..8, 10, 12 or 16
const GaussNode* gauss_legendre(int order) noexcept;

} // namespace hemicube::radiosity
