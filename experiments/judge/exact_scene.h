// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <string>
#include <vector>

/// The definition of an LMD, judged in exact arithmetic. Inputs are the world vertices as
/// RigidTransform rounds them, like the judged method's. All that follows is rational except the
/// angle weights of vertex pseudo-normals (long double) and the reported numbers.
namespace lmdbench::exact {

/// Roundings that a distance or a difference of points may carry in double precision, in epsilons
/// of the largest coordinate.
inline constexpr double ROUNDINGS = 64.0;

/// Two features with a critical point of the distance inside both, which meets the first-order
/// condition on both sides.
struct ExactLmd {
  FeatureId feature_moving;
  FeatureId feature_fixed;
  std::int32_t fixed_body = 0;
  double distance = 0.0;  ///< Rounded once, like the points [m].
  Vec3 point_moving = Vec3::Zero();
  Vec3 point_fixed = Vec3::Zero();
  /// Whether rounding in double precision cannot change the decision: the distance is not within
  /// rounding of the cutoff or zero, and no outer side depends on a sign near zero or on an almost
  /// flat triangle.
  bool certain = true;
};

/// All such pairs of features (vertex-vertex, vertex-edge, vertex-face, edge-edge) by brute force.
/// "Around a point" are all triangles of its mesh that hold it, even without shared vertices.
/// Minimisers of parallel features are segments or polygons; their ends or corners appear, because
/// they are such pairs. Pairs at distance 0 are omitted.
std::vector<ExactLmd> exact_lmds(const Scene& scene, const Pose& X_WM);

/// How a set agrees with the exact one.
struct ExactAgreement {
  int exact = 0;          ///< Exact LMDs.
  int uncertain = 0;      ///< Of these, decided by rounding, so not required.
  int same_features = 0;  ///< Of these, found with the same feature pair.
  int same_contact = 0;   ///< Found in a plateau: its distance vector and plane.
  std::vector<ExactLmd> missed;
  int found = 0;  ///< LMDs of the judged set at a distance above 0.
  LmdSet untrue;  ///< Of these, those that match no exact LMD.
  /// Of these, those whose exact LMD was matched before: parts of a plateau that tolerances split,
  /// or several feet on one plane.
  int sharing = 0;
};

/// @param scene  whose meshes say how far the gap of a plateau may change (DEFINITION.md)
ExactAgreement compare_with_exact(const Scene& scene, const LmdSet& found,
                                  const std::vector<ExactLmd>& exact);

/// Whether a reported LMD meets the first-order condition up to a sine of 1e-9 and rounding: true
/// for nearly parallel faces and edges, and for segments made of triangles without area.
bool within_tolerance(const Scene& scene, const Pose& X_WM, const Lmd& lmd);

/// Whether a triangle of the moving mesh and one of a fixed mesh share a point.
bool exactly_touching(const Scene& scene, const Pose& X_WM);

/// Both features and the distance, as text for messages.
std::string describe(const ExactLmd& lmd);

}  // namespace lmdbench::exact
