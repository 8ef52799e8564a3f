// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <random>
#include <span>
#include <string_view>

namespace lmdbench::testing {

struct TrianglePair {
  Triangle a, b;
};

using Random = std::mt19937_64;

/// A family of triangle pairs that some published distance routine gets wrong, or could. The generator is
/// deterministic given the engine's state, on every platform: it uses the engine's bits and correctly rounded
/// operations only, no standard distribution and no transcendental function.
struct TriangleFamily {
  std::string_view name;
  TrianglePair (*generate)(Random& random);
};

/// The families of the accuracy table, in its order.
std::span<const TriangleFamily> triangle_families();

/// Uniform in [-1, 1).
double uniform(Random& random);
/// Uniform in logarithm between two positive bounds, nearly.
double log_uniform(Random& random, double low, double high);
/// Uniform in the cube [-1, 1)^3.
Vec3 random_point(Random& random);
/// A rotation, uniform over all.
Mat3 random_rotation(Random& random);
/// One of `count` numbers from 0.
int random_index(Random& random, int count);

/// The pair with every corner scaled, rotated and moved.
TrianglePair transformed(const TrianglePair& pair, double scale, const Mat3& rotation, const Vec3& offset);

/// The pair with the corners of both triangles reordered (0 <= order < 36) and, for order >= 36, swapped (<
/// 72).
TrianglePair reordered(const TrianglePair& pair, int order);

/// Largest absolute coordinate of the pair: the scale that errors are relative to.
double magnitude(const TrianglePair& pair);

}  // namespace lmdbench::testing
