// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/sphere.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

// Steps of bounding_sphere (farthest-point pivoting, B. Gaertner, "Fast and robust smallest
// enclosing balls", ESA 1999, with a brute-force solver for the at most five points of a step):
// - keep a support set of at most four points and its smallest sphere;
// - find the point farthest from the centre; stop when it is inside up to SPHERE_SHRINK_TOLERANCE;
// - otherwise the smallest sphere of support + that point replaces both; the radius grows strictly.
// A last pass sets the radius to the largest distance, so rounding leaves no point outside.

/// A point farther out than this part of the radius is outside; the slack keeps
/// rounding from cycling the pivots.
constexpr double SPHERE_SHRINK_TOLERANCE = 1e-10;
/// Generic sets need fewer than 15 pivots; the bound only stops a cycle on degenerate sets.
constexpr int MAX_PIVOTS = 100;
/// Outward rounding of a radius: covers the error of one distance computation.
constexpr double OUTWARD = 1.0 + 8.0 * std::numeric_limits<double>::epsilon();

struct Support {
  std::array<Vec3, 5> points;
  int size = 0;
};

/// Sphere through the first N + 1 of `points`, with its centre in their affine hull; false where
/// they are affinely dependent.
template <int N>
bool circumsphere(const std::array<Vec3, 4>& points, Sphere& sphere) {
  // centre - origin = sum of l_i e_i with 2 e_j . (centre - origin) = e_j . e_j for
  // every e_j = points[j] - origin.
  const Vec3& origin = points[0];
  Eigen::Matrix<double, N, N> gram;
  Eigen::Matrix<double, N, 1> right;
  for (int j = 0; j < N; ++j) {
    const Vec3 ej = points[j + 1] - origin;
    for (int i = 0; i < N; ++i) gram(j, i) = 2.0 * ej.dot(points[i + 1] - origin);
    right(j) = ej.squaredNorm();
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, N, N>> lu(gram);
  if (!lu.isInvertible()) return false;
  const Eigen::Matrix<double, N, 1> l = lu.solve(right);
  Vec3 offset = Vec3::Zero();
  for (int i = 0; i < N; ++i) offset += l(i) * (points[i + 1] - origin);
  sphere = {origin + offset, offset.norm()};
  return sphere.centre.allFinite() && std::isfinite(sphere.radius);
}

bool circumsphere(const std::array<Vec3, 4>& points, int count, Sphere& sphere) {
  switch (count) {
    case 1:
      sphere = {points[0], 0.0};
      return true;
    case 2:
      return circumsphere<1>(points, sphere);
    case 3:
      return circumsphere<2>(points, sphere);
    default:
      return circumsphere<3>(points, sphere);
  }
}

bool contains_all(const Sphere& sphere, const Support& support) {
  const double limit = sphere.radius * (1.0 + SPHERE_SHRINK_TOLERANCE);
  for (int i = 0; i < support.size; ++i) {
    if ((support.points[i] - sphere.centre).norm() > limit) return false;
  }
  return true;
}

/// Replaces the support by the subset that carries its smallest sphere; false where rounding hides
/// it. All subsets tried hold the last point: outside the others' sphere, it is on the new one.
bool smallest_sphere_of_support(Support& support, Sphere& sphere) {
  Sphere best;
  best.radius = std::numeric_limits<double>::infinity();
  Support best_support;
  for (unsigned mask = 1U << (support.size - 1); mask < (1U << support.size); ++mask) {
    std::array<Vec3, 4> points;
    int count = 0;
    bool fits = true;
    for (int i = 0; i < support.size && fits; ++i) {
      if ((mask & (1U << i)) == 0) continue;
      fits = count < 4;
      if (fits) points[count++] = support.points[i];
    }
    Sphere candidate;
    if (!fits || !circumsphere(points, count, candidate)) continue;
    if (candidate.radius >= best.radius || !contains_all(candidate, support)) continue;
    best = candidate;
    best_support.size = count;
    std::copy_n(points.begin(), count, best_support.points.begin());
  }
  if (!std::isfinite(best.radius)) return false;
  sphere = best;
  support = best_support;
  return true;
}

std::size_t farthest_point(std::span<const Vec3> points, const Vec3& centre, double& squared_distance) {
  std::size_t farthest = 0;
  squared_distance = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double candidate = (points[i] - centre).squaredNorm();
    if (candidate > squared_distance) {
      squared_distance = candidate;
      farthest = i;
    }
  }
  return farthest;
}

}  // namespace

Sphere bounding_sphere(std::span<const Vec3> points) {
  Sphere sphere;
  if (points.empty()) return sphere;
  sphere.centre = points[0];
  Support support;
  support.points[support.size++] = points[0];
  Sphere best;
  double best_squared_radius = std::numeric_limits<double>::infinity();
  for (int pivot = 0; pivot < MAX_PIVOTS; ++pivot) {
    double squared_distance = 0.0;
    const std::size_t farthest = farthest_point(points, sphere.centre, squared_distance);
    if (squared_distance < best_squared_radius) {
      best_squared_radius = squared_distance;
      best = sphere;
    }
    if (std::sqrt(squared_distance) <= sphere.radius * (1.0 + SPHERE_SHRINK_TOLERANCE)) break;
    support.points[support.size++] = points[farthest];
    if (!smallest_sphere_of_support(support, sphere)) break;
  }
  best.radius = std::sqrt(best_squared_radius) * OUTWARD;
  LMDBENCH_ENSURES(
      std::ranges::all_of(points, [&](const Vec3& p) { return (p - best.centre).norm() <= best.radius; }),
      "rounding beyond OUTWARD, or a point that is not a number");
  return best;
}

}  // namespace lmdbench
