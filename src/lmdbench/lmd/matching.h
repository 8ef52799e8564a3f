// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/mesh/surface.h>

#include <limits>
#include <vector>

/// How well an LMD set agrees with the true one.
namespace lmdbench {

/// Shares in [0, 1]; NaN where the share is of nothing (recall of an empty truth, precision of an empty set).
struct SetAgreement {
  double recall = std::numeric_limits<double>::quiet_NaN();     ///< True LMDs that the set has.
  double precision = std::numeric_limits<double>::quiet_NaN();  ///< LMDs of the set that are true.
};

/// Strict: the same feature pair on the same fixed mesh, one to one, so that a duplicate costs precision (it
/// doubles the force).
SetAgreement strict_agreement(const LmdSet& set, const LmdSet& truth);

/// Lenient: on both meshes the two features share an incident triangle. A pair that stopped one feature short
/// of its minimum counts as found. Not one to one: neighbours may share a partner.
/// @param fixed surfaces in the order of Lmd::fixed_body
SetAgreement adjacent_agreement(const LmdSet& set, const LmdSet& truth, const Surface& moving,
                                const std::vector<const Surface*>& fixed);

}  // namespace lmdbench
