// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/shape/signed_features.h>

namespace lmdbench {

/// The two meshes of a question for critical pairs. Indices are taken at a pose that is turned by GENERIC_TURN: there nothing
/// is parallel or aligned by design, so that the signs on which neighbouring features agree are far above rounding and every
/// place is counted once.
class SignedPair {
 public:
  struct Side {
    ShapeSide shape;
    const SignedFeatures& signs;
  };
  SignedPair(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed);

  /// Appends the critical pair that two features of the shapes share, as a contact that is no minimum: points, direction and
  /// index; nothing where the index is 0, the distance is above `tolerance.reach`, or a feature has no index. Features in
  /// general position have at most one.
  ///
  /// index = i(f, u) i(g, -u), u the direction from f to g (SignedFeatures). Corner-corner, corner-chain, corner-region and
  /// chain-chain pairs only: others have no critical pair but where they are parallel.
  /// @param on_moving, on_fixed  leads (ShapeComplex)
  void append(const FeatureId& on_moving, const FeatureId& on_fixed, ContactSet& found) const;

 private:
  RigidTransform turned_;
  Side moving_, fixed_;
  double reach_;
};

/// Asks two features for their contacts and for their critical pair; a contact of points that is the lowest pair too takes its index.
void decide_critical(const ShapePair& pair, const SignedPair& signs, const FeatureId& on_moving,
                     const FeatureId& on_fixed, ContactSet& found);

/// Angle [rad] about an axis of no symmetry by which the moving mesh is turned when indices are taken: far above rounding
/// (1e-16), below what meshes are known to (LEAST_TOLERANCE).
inline constexpr double GENERIC_TURN = 0x1p-32;

/// The pose at which indices are taken: turned by GENERIC_TURN about the moving mesh's own origin.
RigidTransform generic_pose(const RigidTransform& X_WM);

}  // namespace lmdbench
