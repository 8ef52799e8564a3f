// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <triangles/random_triangles.h>

#include <cmath>

namespace lmdbench::testing {

double uniform_coordinate(Random& random) {
  return std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0;
}

double log_uniform(Random& random, double low, double high) {
  int octaves = 0;
  std::frexp(high / low, &octaves);
  for (;;) {
    // Linear within an octave: near enough, and the same bits everywhere, unlike std::exp.
    const double octave = 0.5 * (uniform_coordinate(random) + 1.0) * octaves;
    const double value = low * std::ldexp(1.0 + octave - std::floor(octave), static_cast<int>(octave));
    if (value <= high) return value;
  }
}

Vec3 random_point(Random& random) {
  const double x = uniform_coordinate(random);
  const double y = uniform_coordinate(random);
  return {x, y, uniform_coordinate(random)};
}

Mat3 random_rotation_matrix(Random& random) {
  for (;;) {
    const double w = uniform_coordinate(random);
    const Vec3 v = random_point(random);
    const double squared_length = w * w + v.squaredNorm();
    if (squared_length > 0.01 && squared_length <= 1.0) {
      return Eigen::Quaterniond(w, v[0], v[1], v[2]).normalized().toRotationMatrix();
    }
  }
}

int random_index(Random& random, int count) {
  return static_cast<int>((random() >> 33) % static_cast<unsigned>(count));
}

bool coin(Random& random) {
  return random_index(random, 2) == 1;
}

Vec3 random_unit_vector(Random& random) {
  for (;;) {
    const Vec3 v = random_point(random);
    if (v.norm() > 0.1 && v.norm() <= 1.0) return v.normalized();
  }
}

Triangle random_triangle(Random& random) {
  const Vec3 p = random_point(random);
  const Vec3 q = random_point(random);
  return {p, q, random_point(random)};
}

/// A point inside (or on the border of) a triangle.
Vec3 point_in(Random& random, const Triangle& t) {
  double u = 0.5 * (uniform_coordinate(random) + 1.0), v = 0.5 * (uniform_coordinate(random) + 1.0);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

Vec3 unit_normal(const Triangle& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

Vec3 nudged(Random& random, Vec3 p, int largest_step) {
  for (int axis = 0; axis < 3; ++axis) {
    const int steps = random_index(random, 2 * largest_step + 1) - largest_step;
    for (int i = 0; i < std::abs(steps); ++i) p[axis] = std::nextafter(p[axis], steps > 0 ? 8.0 : -8.0);
  }
  return p;
}

Vec3 lattice_point(Random& random, int extent) {
  const int x = random_index(random, extent + 1);
  const int y = random_index(random, extent + 1);
  return {double(x), double(y), double(random_index(random, extent + 1))};
}

Triangle lattice_triangle(Random& random, int extent) {
  const Vec3 p = lattice_point(random, extent);
  const Vec3 q = lattice_point(random, extent);
  return {p, q, lattice_point(random, extent)};
}

}  // namespace lmdbench::testing
