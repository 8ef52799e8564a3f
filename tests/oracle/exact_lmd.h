// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <compare>
#include <vector>

namespace lmdbench::testing {

struct ExactLmd {
  FeatureId moving, fixed;
  double distance = 0.0;  ///< rounded once

  bool operator<(const ExactLmd& other) const {
    return moving != other.moving ? moving < other.moving : fixed < other.fixed;
  }
};

struct ExactLmdSet {
  std::vector<ExactLmd> lmds;  ///< sorted by features
  int undecided = 0;           ///< pairs left out: parallel features, or no clear outer side
};

/// The LMD set by its definition (design, section 2), feature pair by feature pair in rational arithmetic:
/// feet of the common perpendicular strictly inside both features, d . (x - p) <= 0 for every corner x around
/// p and the like for q, distance within the cutoff. The moving corners are what RigidTransform makes of them
/// in double; from there on nothing is rounded but the outer side, which only needs a sign far from 0. Shares
/// no code with the methods.
/// @pre closed manifold surfaces that do not touch; every pair of features is looked at, so keep them small
ExactLmdSet exact_lmds(const Surface& moving, const Pose& X_WM, const Surface& fixed, double cutoff);

}  // namespace lmdbench::testing
