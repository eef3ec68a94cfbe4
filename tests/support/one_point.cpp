#include "tests/support/one_point.h"

#include "tests/support/lambert.h"

#include <algorithm>
#include <cmath>

namespace hemicube::test {

std::vector<Vec3> corners_of(const PatchSet& patches, std::uint32_t patch) {
  std::vector<Vec3> corners;
  for (const std::uint32_t vertex : patches.corners_of(patch))
    corners.push_back(patches.vertices[vertex]);
  return corners;
}

std::vector<double> one_point_form_factors(const PatchSet& patches) {
  const std::uint32_t n = patches.patch_count();
  std::vector<std::vector<Vec3>> polygons;
  for (std::uint32_t p = 0; p < n; ++p)
    polygons.push_back(corners_of(patches, p));
  std::vector<double> matrix(static_cast<std::size_t>(n) * n, 0.0);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      if (i != j)
        matrix[static_cast<std::size_t>(i) * n + j] =
            lambert_form_factor(patches.centre[i], patches.normal[i], polygons[j]);
  return matrix;
}

std::vector<double> solve_dense(const Scene& scene, const PatchSet& patches,
                                const std::vector<double>& form_factors) {
  const std::size_t n = patches.patch_count(), bands = scene.band_count();
  std::vector<double> radiosity(n * bands, 0.0);
  for (std::size_t band = 0; band < bands; ++band)
    for (int sweep = 0; sweep < 100000; ++sweep) {
      double change = 0, largest = 0;
      for (std::size_t i = 0; i < n; ++i) {
        double irradiance = 0;
        for (std::size_t j = 0; j < n; ++j)
          irradiance += form_factors[i * n + j] * radiosity[j * bands + band];
        const std::size_t material = patches.material[i] * bands + band;
        const double value = scene.exitance[material] + scene.reflectance[material] * irradiance;
        change = std::max(change, std::fabs(value - radiosity[i * bands + band]));
        largest = std::max(largest, value);
        radiosity[i * bands + band] = value;
      }
      if (change <= 1e-15 * largest)
        break;
    }
  return radiosity;
}

double area_rms(const PatchSet& patches, std::span<const double> a, std::span<const double> b) {
  const std::size_t bands = a.size() / patches.patch_count();
  double worst = 0;
  for (std::size_t band = 0; band < bands; ++band) {
    double squares = 0, total = 0;
    for (std::size_t p = 0; p < patches.patch_count(); ++p) {
      const double expected = b[p * bands + band];
      const double difference = a[p * bands + band] - expected;
      squares += patches.area[p] * difference * difference;
      total += patches.area[p] * expected * expected;
    }
    if (total > 0)
      worst = std::max(worst, std::sqrt(squares / total));
  }
  return worst;
}

double largest_relative(std::span<const double> a, std::span<const double> b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (b[i] > 0)
      worst = std::max(worst, std::fabs(a[i] / b[i] - 1));
  return worst;
}

} // namespace hemicube::test
