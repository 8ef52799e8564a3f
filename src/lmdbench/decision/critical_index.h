// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/shape/signed_features.h>

namespace lmdbench {

/// The two meshes of a search for critical pairs. Indices are taken at a pose that is turned by
/// GENERIC_TURN. There nothing is parallel or aligned by design: the signs on which neighbouring
/// features agree are far above rounding, and every place is counted once.
class SignedPair {
 public:
  struct Side {
    ShapeSide shape;
    const SignedFeatures& signs;
  };
  SignedPair(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed);

  /// Appends the critical pair of two features, as a contact that is no minimum: points, direction
  /// and index. Appends nothing where the index is 0, the distance is above `tolerance.reach`, or a
  /// feature has no index. Features in general position have at most one.
  ///
  /// index = i(f, u) i(g, -u), u from f to g (SignedFeatures). Only for corner-corner,
  /// corner-chain, corner-region and chain-chain: other pairs have one only where parallel.
  /// @param on_moving, on_fixed  leads (ShapeComplex)
  void append(const FeatureId& on_moving, const FeatureId& on_fixed, ContactSet& found) const;

 private:
  RigidTransform turned_;
  Side moving_, fixed_;
  double reach_;
};

/// Appends contacts and critical pair. A contact of points that is the lowest pair takes its index.
void decide_critical(const ShapePair& pair, const SignedPair& signs, const FeatureId& on_moving,
                     const FeatureId& on_fixed, ContactSet& found);

/// Angle [rad] about an axis of no symmetry by which the moving mesh is turned when indices are
/// taken: far above rounding (1e-16), below LEAST_TOLERANCE.
inline constexpr double GENERIC_TURN = 0x1p-32;

/// The pose at which indices are taken: turned by GENERIC_TURN about a point amid the moving mesh.
/// @param extent  its largest coordinate (FlatRegions::extent) [m]
RigidTransform generic_pose(const RigidTransform& X_WM, double extent);

}  // namespace lmdbench
