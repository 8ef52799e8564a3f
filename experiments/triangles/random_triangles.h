// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <random>

/// Random shapes for the families, the same on every platform: only the engine's bits and correctly
/// rounded operations, no standard distribution, no transcendental function.
namespace lmdbench::testing {

using Random = std::mt19937_64;

/// Uniform in [-1, 1).
double uniform_coordinate(Random& random);
/// Nearly log-uniform between two positive bounds.
double log_uniform(Random& random, double low, double high);
/// One of the numbers 0 to `count` - 1.
int random_index(Random& random, int count);
bool coin(Random& random);

/// Uniform in the cube [-1, 1)^3.
Vec3 random_point(Random& random);
/// Uniform on the unit sphere.
Vec3 random_unit_vector(Random& random);
/// Uniform over all rotations.
Mat3 random_rotation_matrix(Random& random);
/// Coordinates are integers from 0 to `extent`.
Vec3 lattice_point(Random& random, int extent);
/// Moves every coordinate by up to `largest_step` units in the last place.
Vec3 nudged(Random& random, Vec3 p, int largest_step);

/// Three random points.
Triangle random_triangle(Random& random);
/// Three lattice points.
Triangle lattice_triangle(Random& random, int extent);
/// A point inside (or on the border of) a triangle.
Vec3 point_in(Random& random, const Triangle& t);
Vec3 unit_normal(const Triangle& t);

}  // namespace lmdbench::testing
