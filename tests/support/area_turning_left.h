// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>

namespace lmdbench::testing {

/// The area of triangles in a plane of constant z, each of which must turn to the left.
inline double area_turning_left(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::int32_t t = 0; t < std::ssize(mesh.triangles); ++t) {
    const Triangle c = mesh.triangle(t);
    const double twice = (c[1] - c[0]).cross(c[2] - c[0]).z();
    EXPECT_GT(twice, 0.0) << t;
    area += 0.5 * twice;
  }
  return area;
}

}  // namespace lmdbench::testing
