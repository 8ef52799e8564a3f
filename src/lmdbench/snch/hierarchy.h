// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/surface.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Node of a spatialized normal cone hierarchy (paper, section 3.1): a bounding sphere with a
/// cone of normals, both in the mesh's frame. Angles are kept as cosine and sine, so that node
/// tests need no inverse trigonometry.
struct HierarchyNode {
  Vec3 centre;               ///< S, metres
  double radius;             ///< rho, metres
  Vec3 cone_axis;            ///< C, unit; any direction where the cone is all directions
  double cone_cosine;        ///< cos(phi); phi in [0, pi], pi meaning all directions
  double cone_sine;          ///< sin(phi)
  std::int32_t first_child;  ///< Index of the left child, the right one follows it; -1 for a leaf.
  std::int32_t triangle;     ///< The leaf's triangle; -1 for an inner node.

  bool is_leaf() const { return first_child < 0; }
};

/// Binary hierarchy whose leaves hold one triangle each. nodes[0] is the root; empty
/// for a mesh without triangles.
struct Hierarchy {
  std::vector<HierarchyNode> nodes;

  /// Top-down builder, deterministic.
  static Hierarchy of(const Surface& surface);
};

/// Which faces' normals the cone of a leaf covers (decision E1).
enum class LeafCones : std::uint8_t {
  OWN,              ///< The triangle's own: the narrowest reading of the paper.
  EDGE_NEIGHBOURS,  ///< Also of those across its edges.
  ONE_RING          ///< Also of all round its corners (default): keeps every LMD.
};

/// As `Hierarchy::of`, whose leaf cones are ONE_RING.
Hierarchy hierarchy_with(const Surface& surface, LeafCones leaf_cones);

/// A hierarchy with other leaf cones, as `Body::prepared` keeps it.
template <LeafCones CONES>
struct HierarchyWith {
  Hierarchy hierarchy;
  static HierarchyWith of(const Surface& surface) { return {hierarchy_with(surface, CONES)}; }
};

/// The hierarchy of a body, made once.
template <class Body>
const Hierarchy& prepared_hierarchy(const Body& body, LeafCones leaf_cones) {
  if (leaf_cones == LeafCones::OWN) return body.template prepared<HierarchyWith<LeafCones::OWN>>().hierarchy;
  if (leaf_cones == LeafCones::EDGE_NEIGHBOURS)
    return body.template prepared<HierarchyWith<LeafCones::EDGE_NEIGHBOURS>>().hierarchy;
  return body.template prepared<Hierarchy>();
}

}  // namespace lmdbench
