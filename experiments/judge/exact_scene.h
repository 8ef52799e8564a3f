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
/// angle weights of vertex pseudo-normals (long double) and the reported numbers. Shares with the
/// methods the meshes as loaded: which triangles a feature has, borders, where more than two meet.
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
  int certain = 0;        ///< Of these, those asked for: not decided by rounding.
  int uncertain = 0;      ///< Of the others, those not found.
  int same_features = 0;  ///< Found with the same feature pair.
  int same_contact = 0;   ///< Found in a plateau: its distance vector, its plane, on both meshes.
  std::vector<ExactLmd> missed;
  int found = 0;     ///< LMDs of the judged set at a distance above 0.
  int required = 0;  ///< Of these, those without which a certain one would be missed.
  /// Those with a point off its feature or another distance than theirs; and intersecting ones
  /// whose triangles are apart.
  LmdSet misplaced;
  LmdSet untrue;  ///< Of the others, those above 0 that match no exact LMD.
  /// Those beside another one of the same name, place or exact contact (exact LMDs that hang
  /// together over common triangles of both meshes, where distance is convex).
  LmdSet doubled;
  /// Those whose exact LMD was matched before: doubled, or parts of a plateau that tolerances
  /// split.
  int sharing = 0;
};

/// Matches by place: points up to the tolerance of the meshes (DEFINITION.md), or a plateau that
/// goes on from the exact point to the named features. Where in a plateau a point lies is not
/// asked.
ExactAgreement compare_with_exact(const Scene& scene, const Pose& X_WM, const LmdSet& found,
                                  const std::vector<ExactLmd>& exact);

/// Whether a reported LMD meets the first-order condition of its own triangles up to rounding and a
/// sine of 1e-9, of segments and areas up to the tilt at which the meshes are parallel (5e-8 of
/// exact ones, more in single precision). So do nearly parallel features, also where another part
/// of the same mesh touches them without common vertices, and segments made of triangles without
/// area.
bool within_tolerance(const Scene& scene, const Pose& X_WM, const Lmd& lmd);

/// Whether a triangle of the moving mesh and one of a fixed mesh share a point.
bool exactly_touching(const Scene& scene, const Pose& X_WM);

/// Both features, the distance and the points of an ExactLmd or an Lmd, as text for messages.
template <typename AnyLmd>
std::string describe(const AnyLmd& lmd);

}  // namespace lmdbench::exact
