// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/shapes.h>
#include <lmdbench/snch/wide_hierarchy.h>

#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

/// What the tests of the wide hierarchy draw at random.
namespace lmdbench::testing {

inline std::vector<TriangleMesh> shapes() {
  return {make_blob(1.0, 0.3, 3),
          make_torus(1.0, 0.4, 20, 10),
          make_unequal(1.0, 6, 100.0),
          make_needles(0.5, 2.0, 40),
          make_patch(2.0, 8, 0.2),
          make_box({1.0, 2.0, 3.0}, 3),
          make_l_block(1.0),
          make_sphere(1.0, 2),
          translated(make_blob(1.0, 0.3, 2), {1e4, 0.0, 0.0})};
}

/// A random rotation between two hierarchies with the moving one at about `distance`.
inline RigidTransform random_transform(double distance, std::mt19937_64& random) {
  return RigidTransform(Pose{distance * random_direction(random), random_rotation(random)});
}

/// Fills a lane with a random body and cone, and draws a point and a direction inside.
struct LaneSample {
  Vec3 centre, axis, point, direction;
  double radius, thickness, cosine;

  explicit LaneSample(std::mt19937_64& random) {
    centre = uniform(random) * random_direction(random);
    axis = random_direction(random);
    radius = 0.3 * uniform(random) * uniform(random);
    thickness = radius * uniform(random) * uniform(random);
    cosine = 1.0 - uniform(random) * uniform(random);
    do {
      point = radius * uniform(random) * random_direction(random);
    } while (std::abs(point.dot(axis)) > thickness);
    point += centre;
    Vec3 across = axis.unitOrthogonal();
    across = Eigen::AngleAxisd(2.0 * std::numbers::pi * uniform(random), axis) * across;
    const double c = cosine + (1.0 - cosine) * uniform(random);
    direction = c * axis + std::sqrt(1.0 - c * c) * across;
  }

  void store(WideNode& node, std::size_t lane) const {
    for (int k = 0; k < 3; ++k) {
      node.centre[k][lane] = static_cast<float>(centre[k]);
      node.axis[k][lane] = static_cast<float>(axis[k]);
    }
    node.radius[lane] = static_cast<float>(radius + 1e-6);
    node.thickness[lane] = static_cast<float>(thickness + 1e-6);
    node.cosine[lane] = std::max(0.0F, static_cast<float>(cosine - 5e-7));
    node.sine[lane] = std::min(1.0F, static_cast<float>(std::sqrt(1.0 - cosine * cosine) + 5e-7));
    node.child[lane] = 1;
  }
};

}  // namespace lmdbench::testing
