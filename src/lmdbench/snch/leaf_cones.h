// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/hierarchy.h>

#include <cstdint>

namespace lmdbench {

/// Which faces' normals the cone of a leaf covers (decision E1).
enum class LeafCones : std::uint8_t {
  OWN,              ///< The triangle's own: what the paper's words say at their narrowest.
  EDGE_NEIGHBOURS,  ///< And of those across its edges.
  ONE_RING          ///< Of all round its three corners (default): keeps every LMD.
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
