// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/force_law.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/lmd/lmd.h>

namespace lmdbench {

/// Force and torque that the fixed meshes exert on the moving one, in the world frame.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< newtons
  Vec3 torque = Vec3::Zero();  ///< newton metres, about the reference point
  /// K_eff [N/m]: slope -d|force|/dx for a translation x along the force, u^T (sum_i k_i n_i n_i^T) u with u
  /// along the force, n_i the LMD's direction and k_i its stiffness. Each n_i is held fixed, as for a flat
  /// contact. n equal LMDs give n k, which clipping the force does not bound. Where forces cancel exactly:
  /// the stiffest direction's.
  double stiffness = 0.0;
};

/// Sums the LMDs' forces (paper, section 4.5): each pushes the moving mesh away along -direction with
/// `force_magnitude`; LMDs beyond the cutoff and LMDs without a direction (E12) add nothing. Not
/// clipped: that is the device's business (`phantom/`). Summed in the order of the set, so that sorted
/// sets give the same bits.
/// @param reference_W point about which the torque is taken
Wrench sum_forces(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W);

}  // namespace lmdbench
