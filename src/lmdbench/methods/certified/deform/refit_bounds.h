// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>
#include <lmdbench/shape/shape_complex.h>

#include <cstdint>

namespace lmdbench {

/// Cost of a lane, up to a factor: its size and its gain by opening (wide_traversal.h).
inline double lane_cost(const WideNode& node, std::uint32_t lane) {
  if (node.cosine[lane] == NO_LMD_COSINE) return 0.0;
  return static_cast<double>(node.radius[lane] * opening_gain(node.radius[lane], node.sine[lane]));
}

/// Bounds lanes of a node anew where a hierarchy follows a mesh (wide_refit.h), rounded outwards.
///
/// 1. Lanes of features, whose cones are stored already: their vertices, eight lanes side by side.
/// 2. A lane of a node: what is two levels below it, where there is anything; from one level below
///    bounds are so large that a search makes a fifth more node tests. Of a node of single
///    vertices, edges and triangles their vertices. Eight of these side by side.
///    a. *Cone.* The lane's axis before, or the middle of the axes' box, whichever needs the
///       smaller cone, moved by a step towards the cone that sticks out most (M. Badoiu, K.
///       Clarkson, "Smaller core-sets for balls", 2003, on the sphere). None from 90 degrees on,
///       where a cone is not convex (decision E1).
///    b. *Body.* Its centre likewise: before, or the middle of the box; along the axis the middle
///       of the extent.
/// All in single precision, measured from what is stored. Lengths are those from a point nearby, so
/// that what rounding adds is a millionth of the lane. No operation depends on the processor.
/// @param lanes  bits of the lanes; none is empty. Of nodes, lanes below are bounded already
void refit_lanes(WideNode& node, std::uint32_t lanes, const WideHierarchy& hierarchy, const Surface& surface,
                 const ShapeComplex& shape);

}  // namespace lmdbench
