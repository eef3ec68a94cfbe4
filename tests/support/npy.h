#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hemicube::test {

/// A square matrix, row by row.
struct SquareMatrix {
  std::size_t size = 0; ///< rows, and columns
  std::vector<double> values;

  double at(std::size_t row, std::size_t column) const { return values[row * size + column]; }
};

/// Reads a square matrix of little-endian doubles in C order from a NumPy file (format 1.0).
/// Throws std::runtime_error, "FILE: what is wrong", on anything else: other types, orders and
/// shapes, a file that is shorter or longer than its header says, values that are not finite.
SquareMatrix read_npy(const std::string& path);

} // namespace hemicube::test
