// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/lmd/body.h>
#include <lmdbench/methods/certified/keep/wide_lifetime.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

/// Random inputs of the tests of the wide hierarchy.
namespace lmdbench::testing {

/// A ring of long walls, inside and outside: its hierarchy has widths.
inline TriangleMesh make_bushing(int segments) {
  return make_sleeve(circle_outline(0.5), circle_outline(0.4), {.height = 1.0, .around = segments});
}

inline std::vector<TriangleMesh> shapes() {
  return {make_blob(1.0, 0.3, 3),
          make_torus(1.0, 0.4, 20, 10),
          make_unequal(1.0, 6, 100.0),
          make_needles(0.5, 2.0, 40),
          make_patch(2.0, 8, 0.2),
          make_box({1.0, 2.0, 3.0}, 3),
          make_l_block(1.0),
          make_sphere(1.0, 2),
          translated(make_blob(1.0, 0.3, 2), {1e4, 0.0, 0.0}),
          make_bushing(48)};
}

/// A random transform between two hierarchies, with the moving one at about `distance`.
inline RigidTransform random_transform(double distance, std::mt19937_64& random) {
  return RigidTransform(Pose{distance * random_direction(random), random_rotation(random)});
}

/// Fills a lane with a random body and cone, and draws a point and a direction inside.
struct LaneSample {
  Vec3 centre, axis, across, point, direction;
  double radius, thickness, half_width, cosine;

  explicit LaneSample(std::mt19937_64& random) {
    centre = uniform(random) * random_direction(random);
    axis = random_direction(random);
    radius = 0.3 * uniform(random) * uniform(random);
    thickness = radius * uniform(random) * uniform(random);
    half_width = radius * uniform(random) * uniform(random);
    across = Eigen::AngleAxisd(2.0 * std::numbers::pi * uniform(random), axis) * axis.unitOrthogonal();
    cosine = 1.0 - uniform(random) * uniform(random);
    do {
      point = radius * uniform(random) * random_direction(random);
    } while (std::abs(point.dot(axis)) > thickness || std::abs(point.dot(across)) > half_width);
    point += centre;
    const Vec3 beside =
        Eigen::AngleAxisd(2.0 * std::numbers::pi * uniform(random), axis) * axis.unitOrthogonal();
    const double c = cosine + (1.0 - cosine) * uniform(random);
    direction = c * axis + std::sqrt(1.0 - c * c) * beside;
  }

  void turn(const Mat3& rotation, const Vec3& offset) {
    centre = rotation * centre + offset;
    axis = rotation * axis;
    across = rotation * across;
    point = rotation * point + offset;
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
  void store(WideWidths& widths, std::size_t lane) const {
    for (int k = 0; k < 3; ++k) widths.across[k][lane] = static_cast<float>(across[k]);
    widths.half_width[lane] = static_cast<float>(half_width + 1e-6);
  }
};

/// Calls visit(query, node, probe, widths) for random nodes and children of every shape's
/// hierarchy, against itself; `widths` is null for a hierarchy without widths.
template <class Visit>
void for_each_random_node_test(std::mt19937_64& random, Visit&& visit) {
  for (const TriangleMesh& mesh : shapes()) {
    const Body body("sample", build_surface(mesh));
    const auto& hierarchy = body.prepared<WideHierarchy>();
    for (int i = 0; i < 2000; ++i) {
      const WideQuery query(hierarchy, hierarchy, random_transform(uniform(random), random),
                            0.3 * uniform(random), 1e-9);
      const std::size_t n = random() % hierarchy.nodes.size(), of_probe = random() % hierarchy.nodes.size();
      const auto lane = static_cast<std::uint32_t>(random() % WIDE_WIDTH);
      const WideNode& home = hierarchy.nodes[of_probe];
      if (!query.possible || home.child[lane] == 0) continue;
      const WideWidthTest widths =
          make_width_test(widths_of(hierarchy, n), widths_of(hierarchy, of_probe), lane, query.a_in_b);
      visit(query, hierarchy.nodes[n], make_probe(WideChild(home, lane), query.a_in_b),
            hierarchy.widths.empty() ? nullptr : &widths);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

/// Expects the same pairs from two traversals, in the same order and with the same work.
inline void expect_same_pairs(const WideScratch& a, const WideCounters& of_a, const WideScratch& b,
                              const WideCounters& of_b) {
  ASSERT_EQ(a.lmd_pairs.size(), b.lmd_pairs.size());
  for (std::size_t k = 0; k < a.lmd_pairs.size(); ++k) {
    ASSERT_EQ(a.lmd_pairs[k].a, b.lmd_pairs[k].a);
    ASSERT_EQ(a.lmd_pairs[k].b, b.lmd_pairs[k].b);
  }
  ASSERT_EQ(a.touch_pairs.size(), b.touch_pairs.size());
  ASSERT_EQ(of_a.node_pairs, of_b.node_pairs);
  ASSERT_EQ(of_a.rejected_g1, of_b.rejected_g1);
  ASSERT_EQ(of_a.rejected_g2, of_b.rejected_g2);
  ASSERT_EQ(of_a.rejected_g3, of_b.rejected_g3);
}

inline void expect_same_lifetimes(const WideLifetimes& a, const WideLifetimes& b) {
  ASSERT_EQ(a.used, b.used);
  ASSERT_EQ(a.lmd, b.lmd);
  ASSERT_EQ(a.touch, b.touch);
  ASSERT_EQ(a.frames, b.frames);
  ASSERT_EQ(a.deviation_budget, b.deviation_budget);
}

}  // namespace lmdbench::testing
