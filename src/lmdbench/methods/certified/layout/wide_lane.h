// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/build/polar_cap.h>
#include <lmdbench/methods/certified/layout/single_precision.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <algorithm>
#include <cstdint>

namespace lmdbench {

/// Centre of the body of a node's child, from the hierarchy's origin [m].
inline Vec3 centre_of_lane(const WideNode& node, std::uint32_t lane) {
  return {node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]};
}

/// Axis of its cone, unit up to rounding of single precision; zero for all directions.
inline Vec3 axis_of_lane(const WideNode& node, std::uint32_t lane) {
  return {node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]};
}

/// Stores the cone of a node's child, rounded outwards. @return the axis as stored
inline Vec3 store_cap(WideNode& node, std::uint32_t lane, const PolarCap& cap, bool carries_lmd) {
  Vec3 axis;
  for (int k = 0; k < 3; ++k) {
    node.axis[k][lane] = to_single(cap.axis[k]);
    axis[k] = static_cast<double>(node.axis[k][lane]);
  }
  const bool has_axis = !cap.is_all_directions();
  if (!carries_lmd) {
    node.cosine[lane] = NO_LMD_COSINE;
    node.sine[lane] = 0.0F;
  } else {
    node.cosine[lane] = has_axis ? std::max(0.0F, static_cast<float>(cap.cosine - CONE_ROUNDING)) : 0.0F;
    node.sine[lane] = has_axis ? std::min(1.0F, static_cast<float>(cap.sine + CONE_ROUNDING)) : 1.0F;
  }
  return axis;
}

}  // namespace lmdbench
