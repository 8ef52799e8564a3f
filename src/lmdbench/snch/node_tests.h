// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/snch/hierarchy.h>

#include <cmath>

/// Node tests of the global search (paper, sections 3.2.1 and 4.1). Every test answers "may this
/// node pair hold an LMD within the cutoff?" from bounds alone and is conservative: a node's cone
/// holds every outward direction of an LMD on the surface below it, its sphere every point. Angles
/// are compared by cosines, cos(a + b) = cos a cos b - sin a sin b, valid while a + b < pi; a sum
/// of pi or more covers every direction and passes.
namespace lmdbench {

/// A node of the moving hierarchy brought to the world frame.
struct WorldNode {
  Vec3 centre;
  Vec3 cone_axis;
  double radius;
  double cone_cosine;
  double cone_sine;

  WorldNode() = default;
  WorldNode(const HierarchyNode& node, const RigidTransform& X_WM)
      : centre(X_WM.point(node.centre)),
        cone_axis(X_WM.direction(node.cone_axis)),
        radius(node.radius),
        cone_cosine(node.cone_cosine),
        cone_sine(node.cone_sine) {}
};

/// Shared by all tests of one pair.
struct NodePair {
  Vec3 centres;             ///< S_B - S_A
  double squared_distance;  ///< |S_B - S_A|^2
  double radii;             ///< rho_A + rho_B

  NodePair(const WorldNode& a, const HierarchyNode& b)
      : centres(b.centre - a.centre), squared_distance(centres.squaredNorm()), radii(a.radius + b.radius) {}
};

/// G1: the spheres are farther apart than the cutoff.
inline bool rejected_by_cutoff(const NodePair& pair, double cutoff) {
  LMDBENCH_EXPECTS(cutoff >= 0.0, "a cutoff that is negative or not a number");
  const double limit = cutoff + pair.radii;
  return pair.squared_distance > limit * limit;
}

/// G2: no pair of collinear vectors from both cones exists: pi - angle(C_A, C_B) > phi_A + phi_B.
inline bool rejected_by_collinearity(const WorldNode& a, const HierarchyNode& b) {
  const double sine_of_sum = a.cone_sine * b.cone_cosine + a.cone_cosine * b.cone_sine;
  if (sine_of_sum <= 0.0) return false;
  const double cosine_of_sum = a.cone_cosine * b.cone_cosine - a.cone_sine * b.cone_sine;
  return -a.cone_axis.dot(b.cone_axis) < cosine_of_sum;
}

/// The cone of all directions from one sphere to the other, half angle sigma = arcsin(radii / |S|),
/// S = S_B - S_A, against a normal cone: true when no direction is in both. Decision E2: the
/// printed inequality of G3.a/b is this rejection. Lengths are multiplied by |S|: no division.
/// @param along      (S_B - S_A) . C for the moving node, (S_A - S_B) . C for the fixed one
/// @param tangent    sqrt(|S_B - S_A|^2 - radii^2) = |S_B - S_A| cos(sigma)
inline bool direction_cone_misses(double along, double tangent, double radii, double cone_cosine,
                                  double cone_sine) {
  const double sine_of_sum = radii * cone_cosine + tangent * cone_sine;
  if (sine_of_sum <= 0.0) return false;
  return along < tangent * cone_cosine - radii * cone_sine;
}

/// How G3 compares a normal cone with the spheres.
enum class DirectionTest {
  RAY,      ///< G3.a and G3.b (section 4.1) as rejection conditions.
  LINE,     ///< Decision E4, ours: the original's dual solution line cone as a two-sided line;
            ///< rejects a pair if the line through the spheres leaves a cone in both senses.
  LITERAL,  ///< Ablation of decision E2: "pass only when satisfying" taken literally, which keeps
            ///< the pairs that G3 should reject.
  CLAMPED   ///< Ablation of decision E3: for overlapping spheres the arcsin of more than 1 becomes
            ///< a right angle, its value at touch. Lines between such spheres have every
            ///< direction, so LMDs are lost.
};

/// Decision E3: overlapping spheres have no sigma, the pair passes.
template <DirectionTest TEST>
inline bool rejected_by_g3(const WorldNode& a, const HierarchyNode& b, const NodePair& pair) {
  const double squared_tangent = pair.squared_distance - pair.radii * pair.radii;
  const bool overlap = squared_tangent <= 0.0;
  if (overlap && TEST != DirectionTest::CLAMPED) return false;
  const double tangent = overlap ? 0.0 : std::sqrt(squared_tangent);
  const double radii = overlap ? std::sqrt(pair.squared_distance) : pair.radii;
  const auto rejects = [&](double along, double cone_cosine, double cone_sine) {
    if constexpr (TEST == DirectionTest::LINE) along = std::abs(along);
    return direction_cone_misses(along, tangent, radii, cone_cosine, cone_sine) !=
           (TEST == DirectionTest::LITERAL);
  };
  return rejects(pair.centres.dot(a.cone_axis), a.cone_cosine, a.cone_sine) ||
         rejects(-pair.centres.dot(b.cone_axis), b.cone_cosine, b.cone_sine);
}

}  // namespace lmdbench
