// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/cone.h>
#include <lmdbench/geometry/sphere.h>
#include <lmdbench/methods/certified/build/wide_bounds.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::random_direction;
using testing::uniform;

constexpr std::size_t SIZE = 20;
constexpr int STEPS = 24;

TEST(WideBounds, ConesAreNearlyTheSmallestInEveryLane) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<std::vector<Vec3>> directions(WIDE_WIDTH);
    LaneCaps caps;
    caps.resize(SIZE);
    for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      const Vec3 middle = random_direction(random);
      const double spread = uniform(random);
      // Lanes of different sizes: shorter ones repeat their last direction.
      const std::size_t size = lane % 2 == 0 ? SIZE : 2 + trial % (SIZE - 2);
      for (std::size_t k = 0; k < SIZE; ++k) {
        if (k < size) directions[lane].push_back((middle + spread * random_direction(random)).normalized());
        caps.axes.set(k, lane, directions[lane].back());
        caps.cosines[k * WIDE_WIDTH + lane] = 1.0F;
        caps.sines[k * WIDE_WIDTH + lane] = 0.0F;
      }
    }
    LaneVectors axes{};
    find_lane_axes(caps, STEPS, axes);
    for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      const Vec3 axis = Vec3(axes.x[lane], axes.y[lane], axes.z[lane]).normalized();
      double least = 1.0;
      for (const Vec3& direction : directions[lane]) least = std::min(least, axis.dot(direction));
      const double smallest = cone_of_directions(directions[lane]).half_angle();
      EXPECT_LE(std::acos(least), 1.06 * smallest + 1e-3) << "trial " << trial << ", lane " << lane;
    }
  }
}

TEST(WideBounds, ConesCoverWideCaps) {
  // A wide cap and narrow ones: the axis of the smallest cone is far from the mean of their axes.
  LaneCaps caps;
  caps.resize(2);
  const Vec3 narrow(0.0, 0.6, 0.8);
  for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    caps.axes.set(0, lane, Vec3::UnitZ());
    caps.axes.set(1, lane, narrow);
    caps.cosines[lane] = 0.8F;
    caps.sines[lane] = 0.6F;
    caps.cosines[WIDE_WIDTH + lane] = 1.0F;
    caps.sines[WIDE_WIDTH + lane] = 0.0F;
  }
  LaneVectors axes{};
  find_lane_axes(caps, 200, axes);
  for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane)
    EXPECT_LT((Vec3(axes.x[lane], axes.y[lane], axes.z[lane]) - Vec3::UnitZ()).norm(), 0.02)
        << "the narrow one lies on the rim of the wide one";
}

TEST(WideBounds, CentresAreNearlyThoseOfTheSmallestSpheres) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<std::vector<Vec3>> all(WIDE_WIDTH);
    LaneSets points;
    points.resize(SIZE);
    for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      for (std::size_t k = 0; k < SIZE; ++k) {
        all[lane].push_back(Vec3(uniform(random), 2.0 * uniform(random), 0.1 * uniform(random)));
        points.set(k, lane, all[lane].back());
      }
    }
    // Every second lane has the axis z: its centre is in the middle of its extent along z.
    LaneVectors axes{}, centres{};
    for (std::size_t lane = 0; lane < WIDE_WIDTH; lane += 2) axes.z[lane] = 1.0F;
    find_lane_centres(points, axes, STEPS, centres);
    for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      const Vec3 centre(centres.x[lane], centres.y[lane], centres.z[lane]);
      double radius = 0.0, low = 1.0, high = 0.0;
      for (const Vec3& p : all[lane]) {
        radius = std::max(radius, (p - centre).norm());
        low = std::min(low, p.z());
        high = std::max(high, p.z());
      }
      EXPECT_LE(radius, 1.05 * bounding_sphere(all[lane]).radius) << "trial " << trial << ", lane " << lane;
      if (lane % 2 == 0) {
        EXPECT_NEAR(centre.z(), 0.5 * (low + high), 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace lmdbench
