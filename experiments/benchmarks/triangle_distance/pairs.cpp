// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/triangle_distance/implementation.h>
#include <support/random.h>
#include <triangles/brute_force_distance.h>

#include <cmath>

namespace lmdbench::experiments {
namespace {

struct TrianglePair {
  Triangle a;
  Triangle b;
};

constexpr std::uint64_t SEED = 3;

double reference_distance(const Triangle& a, const Triangle& b) {
  return static_cast<double>(testing::brute_force_distance(a, b));
}

/// Corners in a unit ball round the centre; slivers, another benchmark's subject, are redrawn.
Triangle random_triangle(Random& random, const Vec3& centre) {
  for (;;) {
    Triangle triangle;
    for (Vec3& corner : triangle) corner = centre + random.uniform(0.4, 0.7) * random.direction();
    const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    if (normal.norm() > 0.2) return triangle;
  }
}

TrianglePair random_pair(Random& random) {
  return {random_triangle(random, Vec3::Zero()),
          random_triangle(random, random.uniform(2.0, 5.0) * random.direction())};
}

/// Moves b towards a to a distance of GAP, by conservative advancement along the line of centres.
/// Lines on which the triangles miss each other are redrawn.
TrianglePair near_pair(Random& random) {
  constexpr double GAP = 0.01;
  for (;;) {
    const Vec3 away = random.direction();
    TrianglePair pair = {random_triangle(random, Vec3::Zero()), random_triangle(random, 2.0 * away)};
    double last = INFINITY;
    for (double left = reference_distance(pair.a, pair.b) - GAP; left < last;
         left = reference_distance(pair.a, pair.b) - GAP) {
      if (left < 0.1 * GAP) return pair;
      for (Vec3& corner : pair.b) corner -= left * away;
      last = left;
    }
  }
}

}  // namespace

std::vector<PairFamily> pair_families(std::size_t count) {
  Random random(SEED);
  std::vector<PairFamily> families = {{"random", {}, {}}, {"near", {}, {}}};
  const auto add = [](PairFamily& family, const TrianglePair& pair) {
    family.a.push_back(pair.a);
    family.b.push_back(pair.b);
  };
  for (std::size_t i = 0; i < count; ++i) {
    add(families[0], random_pair(random));
    add(families[1], near_pair(random));
  }
  return families;
}

}  // namespace lmdbench::experiments
