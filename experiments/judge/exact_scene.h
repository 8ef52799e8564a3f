// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <string>
#include <vector>

/// The definition of an LMD judged in exact arithmetic. Input are the world vertices as RigidTransform rounds
/// them, so that truth and what it judges see the same problem; from there on everything is rational but for
/// the angle weights of vertex pseudo-normals (long double) and the reported numbers.
namespace lmdbench::exact {

/// Roundings that a distance or a difference of points may carry in double precision, in
/// epsilons of the largest coordinate.
inline constexpr double ROUNDINGS = 64.0;

/// A pair of features with a critical point of the distance in both interiors that meets the first-order
/// condition on both sides.
struct ExactLmd {
  FeatureId feature_moving;
  FeatureId feature_fixed;
  std::int32_t fixed_body = 0;
  double distance = 0.0;  ///< Rounded once, as the points [m].
  Vec3 point_moving = Vec3::Zero();
  Vec3 point_fixed = Vec3::Zero();
  /// Whether rounding of double precision could not have decided otherwise: the distance is not
  /// within rounding of the cutoff or of zero, and no outer side hangs on a sign near zero or a
  /// triangle that is all but flat.
  bool certain = true;
};

/// All such pairs of features, vertex-vertex, vertex-edge, vertex-face, edge-edge by
/// brute force. "Around a point" are all triangles of its mesh that hold it, whether or not they share its
/// vertices. Of parallel features, whose minimisers are a segment or polygon, the ends or corners appear:
/// they are such pairs. Pairs at distance 0 are left out.
std::vector<ExactLmd> exact_lmds(const Scene& scene, const Pose& X_WM);

/// How a set compares with the exact one.
struct ExactAgreement {
  int exact = 0;          ///< Exact LMDs.
  int uncertain = 0;      ///< Of these, left to rounding; not asked for.
  int same_features = 0;  ///< Found with the same feature pair.
  int same_contact = 0;   ///< Found as a part of a plateau: the same distance vector in the same plane.
  std::vector<ExactLmd> missed;
  int found = 0;  ///< LMDs of the judged set at a distance above 0.
  LmdSet untrue;  ///< Of these, such that match no exact LMD.
  /// Of these, such that match the same exact LMD as one before them: pieces of a plateau that tolerances
  /// tore apart, or several feet on one plane.
  int sharing = 0;
};

ExactAgreement compare_with_exact(const LmdSet& found, const std::vector<ExactLmd>& exact);

/// Whether a reported LMD meets the first-order condition but for a sine of 1e-9 and rounding: what faces and
/// edges that are parallel up to rounding, and segments made of triangles without area, may be called.
bool within_tolerance(const Scene& scene, const Pose& X_WM, const Lmd& lmd);

/// Whether some triangle of the moving mesh and one of a fixed mesh share a point.
bool exactly_touching(const Scene& scene, const Pose& X_WM);

/// Both features and the distance, for messages.
std::string describe(const ExactLmd& lmd);

}  // namespace lmdbench::exact
