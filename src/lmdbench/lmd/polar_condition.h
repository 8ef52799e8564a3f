// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/contact.h>

namespace lmdbench {

/// How far a direction may leave a polar cone, for a wing w: u . w <= length + sine |w|.
struct PolarSlack {
  double length = 0.0;  ///< metres
  double sine = 0.0;
};

/// Whether a direction lies in the outward polar cone of a corner: no wing has a component along it, and it is on the
/// outer side where the corner has one.
/// @param u_W  unit length, from the corner to the other mesh
bool corner_admits(const ShapeSide& side, std::int32_t vertex, const Vec3& u_W, const PolarSlack& slack);

/// The same for a chain; u_W is square to it up to rounding.
bool chain_admits(const ShapeSide& side, std::int32_t chain, const Vec3& u_W, const PolarSlack& slack);

/// Whether a wing of a corner leads towards the other mesh: has more of the direction than the slack.
bool corner_leads_down(const ShapeSide& side, std::int32_t vertex, const Vec3& u_W, const PolarSlack& slack);
/// The same for a chain.
bool chain_leads_down(const ShapeSide& side, std::int32_t chain, const Vec3& u_W, const PolarSlack& slack);

}  // namespace lmdbench
