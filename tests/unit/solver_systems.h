#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/solve/light_problem.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

namespace hemicube::radiosity {

/// A small system with everything a solver is told, as dense vectors.
struct System {
  std::uint32_t bands = 1;
  std::vector<std::vector<double>> f; ///< dense rows; what is missing to 1 is space
  std::vector<double> area, reflectance, exitance, space_exitance{0};

  LightProblem problem() const { return {bands, area, reflectance, exitance, space_exitance}; }

  void fill(FormFactorMatrix* matrix) const {
    ASSERT_TRUE(matrix->init(f.size(), static_cast<std::uint32_t>(f.size())).ok());
    for (std::size_t i = 0; i < f.size(); ++i) {
      std::vector<std::uint32_t> columns;
      std::vector<float> values;
      double sum = 0;
      for (std::size_t j = 0; j < f.size(); ++j)
        if (f[i][j] > 0) {
          columns.push_back(static_cast<std::uint32_t>(j));
          values.push_back(static_cast<float>(f[i][j]));
          sum += f[i][j];
        }
      RowView row;
      row.columns = columns;
      row.values = values;
      row.space = 1 - sum;
      row.scale = columns.empty() ? 1 : sum / row_sum(row);
      ASSERT_TRUE(matrix->append_row(i / FormFactorMatrix::kBlockRows, row).ok());
    }
  }
};

/// n patches, each seeing every other one equally.
inline System equal_room(std::size_t n, double rho, double exitance) {
  System s;
  s.f.assign(n, std::vector<double>(n, 1.0 / static_cast<double>(n - 1)));
  for (std::size_t i = 0; i < n; ++i)
    s.f[i][i] = 0;
  s.area.assign(n, 1);
  s.reflectance.assign(n, rho);
  s.exitance.assign(n, 0);
  s.exitance[0] = exitance;
  return s;
}

/// n patches of two groups of walls that see each other at random, three bands, some black.
inline System random_room(std::size_t n, std::uint32_t bands) {
  std::mt19937 random(3);
  const auto uniform = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
  System s;
  s.bands = bands;
  s.space_exitance.assign(bands, 0.1);
  std::vector<std::vector<double>> exchange(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    s.area.push_back(0.5 + uniform());
    for (std::size_t j = 0; j < i; ++j)
      exchange[i][j] = exchange[j][i] = uniform() < 0.6 ? 0 : uniform() / static_cast<double>(n);
    for (std::uint32_t b = 0; b < bands; ++b) {
      s.reflectance.push_back(i % 11 == 0 ? 0 : 0.9 * uniform());
      s.exitance.push_back(i % 13 == 0 ? uniform() : 0);
    }
  }
  s.f = exchange;
  for (std::size_t i = 0; i < n; ++i) // reciprocal; what is missing to 1 is space
    for (double& f : s.f[i])
      f /= s.area[i];
  return s;
}

inline bool same_bits(const Buffer<double>& a, const Buffer<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

} // namespace hemicube::radiosity
