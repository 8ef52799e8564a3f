// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/progress.h>
#include <lmdbench/force/force_law.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>

/// A pose where the moving mesh can rest on the fixed ones, for `lmdbench stability` and `init`.
///
/// The moving mesh comes in from REST_DIRECTIONS evenly spread directions, in orientations of a
/// fixed sequence that begins with the file's, to the gap at REST_SHARE of the way from the
/// saturation distance to the cutoff: there it can swing both ways. Under the balancing force it
/// stays if the contact returns it from every side: if the symmetric part of -dF/dx, by differences
/// of the exact set's force, has no eigenvalue clearly below 0 (corner on corner: -F/d, it slides).
/// Of the poses with none below -SLIDING_SHARE of K_eff one with most contacts is taken, then the
/// best held.
namespace lmdbench {

inline constexpr int REST_DIRECTIONS = 64;
inline constexpr int REST_ORIENTATIONS = 6;  ///< Most tried, until a pose does not slide.
inline constexpr double REST_SHARE = 0.5;
inline constexpr double SLIDING_SHARE = 0.02;

struct RestingPose {
  Pose pose;                         ///< X_WM
  double gap = 0.0;                  ///< Smallest distance there [m].
  std::size_t contacts = 0;          ///< LMDs within the cutoff.
  Vec3 force_W = Vec3::Zero();       ///< On the moving mesh, under the profile [N].
  double stiffness_n_per_m = 0.0;    ///< K_eff
  double least_stiffness_share = 0;  ///< Least eigenvalue of -dF/dx over K_eff; < 0: slides.
  int tried = 0;                     ///< Number of poses.

  bool slides() const { return least_stiffness_share < -SLIDING_SHARE; }
};

/// @param profile  with its law; F_max has no effect
/// @throws InputError where no pose has a contact with a force; Interrupted
RestingPose find_resting_pose(const Scene& scene, const ForceProfile& profile, const Progress& progress = {});

}  // namespace lmdbench
