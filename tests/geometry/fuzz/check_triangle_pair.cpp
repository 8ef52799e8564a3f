// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/fuzz/check_triangle_pair.h"

#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>

#include <triangles/brute_force_distance.h>

#include <array>
#include <cmath>
#include <cstring>

namespace lmdbench::testing {
namespace {

constexpr std::size_t PAIR_BYTES = 18 * sizeof(double);

/// Largest error of a distance, relative to the largest coordinate, as published.
constexpr double ERROR_BOUND = 1e-12;
/// Squares of distances outside this range of the largest coordinate overflow or lose digits.
constexpr double SMALLEST_JUDGED = 0x1p-400;
constexpr double LARGEST_JUDGED = 0x1p+400;

std::string complaint(const char* promise, const TrianglePair& pair) {
  return promise + paste(pair);
}

double off(const Vec3& p, const Triangle& t) {
  return static_cast<double>(brute_force_distance({p, p, p}, t));
}

}  // namespace

std::optional<TrianglePair> pair_from_bytes(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < PAIR_BYTES) return std::nullopt;
  std::array<double, 18> numbers;
  std::memcpy(numbers.data(), bytes.data(), PAIR_BYTES);
  TrianglePair pair;
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      pair.a[k][axis] = numbers[static_cast<std::size_t>(3 * k + axis)];
      pair.b[k][axis] = numbers[static_cast<std::size_t>(9 + 3 * k + axis)];
    }
  }
  return pair;
}

std::vector<std::uint8_t> bytes_from_pair(const TrianglePair& pair) {
  std::vector<std::uint8_t> bytes(PAIR_BYTES);
  std::uint8_t* to = bytes.data();
  for (const Triangle* t : {&pair.a, &pair.b}) {
    for (const Vec3& corner : *t) {
      std::memcpy(to, corner.data(), 3 * sizeof(double));
      to += 3 * sizeof(double);
    }
  }
  return bytes;
}

std::string broken_promise(const TrianglePair& pair) {
  const TrianglePairDistance result = triangle_distance(pair.a, pair.b);
  if (!all_finite(pair.a) || !all_finite(pair.b)) {
    return std::isnan(result.squared_distance) ? ""
                                               : complaint("an answer for input that is not finite", pair);
  }
  if (std::isnan(result.squared_distance)) return complaint("not a number for finite input", pair);
  if (!result.point_a.allFinite() || !result.point_b.allFinite())
    return complaint("a point is not finite", pair);
  if (result.squared_distance != (result.point_a - result.point_b).squaredNorm()) {
    return complaint("the squared distance is not that of the points", pair);
  }
  if (result.intersecting && result.squared_distance != 0.0) return complaint("intersecting but apart", pair);
  for (const int order : {7, 20, 36, 71}) {
    const TrianglePair other = reordered(pair, order);
    const TrianglePairDistance again = triangle_distance(other.a, other.b);
    const bool swapped = order >= 36;
    if (again.point_a != (swapped ? result.point_b : result.point_a) ||
        again.point_b != (swapped ? result.point_a : result.point_b)) {
      return complaint("the answer depends on the order", pair);
    }
  }
  const double size = magnitude(pair);
  if (!(size >= SMALLEST_JUDGED && size <= LARGEST_JUDGED)) return "";
  const double bound = ERROR_BOUND * size;
  const auto truth = static_cast<double>(brute_force_distance(pair.a, pair.b));
  if (!(std::abs(std::sqrt(result.squared_distance) - truth) <= bound))
    return complaint("wrong distance", pair);
  if (!(off(result.point_a, pair.a) <= bound)) return complaint("point_a is not on a", pair);
  if (!(off(result.point_b, pair.b) <= bound)) return complaint("point_b is not on b", pair);
  return "";
}

}  // namespace lmdbench::testing
