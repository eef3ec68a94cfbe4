#include "radiosity/output/balanced_weights.h"

#include <gtest/gtest.h>

#include <vector>

namespace hemicube::radiosity::test {
namespace {

constexpr Vec3 kUp{0, 0, 1};

Vec3 mean(const std::vector<Vec3>& points, const std::vector<double>& weights) {
  Vec3 sum{0, 0, 0};
  double total = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    sum += weights[k] * points[k];
    total += weights[k];
  }
  return sum / total;
}

// Catches: weights by area at a hanging vertex, 4 : 1 : 1; equal ones are those of the vertex.
TEST(BalancedWeights, ALargePatchBesideTwoSmallOnesWeighsLikeThem) {
  const std::vector<Vec3> points = {{-1, 0, 0}, {0.5, 0.5, 0}, {0.5, -0.5, 0}};
  std::vector<double> weights = {4, 1, 1};
  balance_about_point(points, kUp, weights);
  EXPECT_NEAR(weights[1] / weights[0], 1, 1e-9);
  EXPECT_NEAR(weights[2] / weights[0], 1, 1e-9);
}

// Catches: other values than before on regular grids.
TEST(BalancedWeights, WhatIsBalancedKeepsItsBits) {
  const std::vector<Vec3> points = {{-0.3, -0.4, 0}, {0.3, -0.4, 0}, {0.3, 0.4, 0}, {-0.3, 0.4, 0}};
  std::vector<double> weights(4, 0.12);
  balance_about_point(points, kUp, weights);
  EXPECT_EQ(weights, std::vector<double>(4, 0.12));
}

// Catches: a tilt that is not limited, which makes weights negative and values overshoot.
TEST(BalancedWeights, StayPositiveWhereNoWeightsWillDo) {
  const std::vector<Vec3> points = {{1, 0, 0}, {2, 1, 0}, {3, -1, 0}};
  std::vector<double> weights = {1, 2, 3};
  balance_about_point(points, kUp, weights);
  for (const double weight : weights)
    EXPECT_GT(weight, 0);
  std::vector<double> sided = {1, 2, 3};
  balance_about_line(points, kUp, {0, 1, 0}, sided);
  EXPECT_EQ(sided, (std::vector<double>{1, 2, 3})) << "all on one side of the line";
}

// Catches: a division by zero where the centres lie on one line.
TEST(BalancedWeights, PointsOnALineThroughTheOriginAreBalanced) {
  const Vec3 way{0.6, 0.8, 0};
  const std::vector<Vec3> points = {-1.0 * way, 3.0 * way};
  std::vector<double> weights = {1, 1};
  balance_about_point(points, kUp, weights);
  EXPECT_LT(glm::length(mean(points, weights)), 1e-9);
}

TEST(BalancedWeights, AMeanIsMovedOntoALine) {
  const std::vector<Vec3> points = {{-2, 1, 0}, {0.5, 0.5, 0}, {1, 4, 0}};
  std::vector<double> weights = {5, 1, 1};
  balance_about_line(points, kUp, {0, -7, 0}, weights);
  EXPECT_NEAR(mean(points, weights).x, 0, 1e-12);
  for (const double weight : weights)
    EXPECT_GT(weight, 0);
}

} // namespace
} // namespace hemicube::radiosity::test
