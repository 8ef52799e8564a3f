// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/hierarchy.h>

#include <nlohmann/json.hpp>

namespace lmdbench {

NLOHMANN_JSON_SERIALIZE_ENUM(LeafCones, {{LeafCones::ONE_RING, "one-ring"},
                                         {LeafCones::EDGE_NEIGHBOURS, "edge-neighbours"},
                                         {LeafCones::OWN, "own"}})

/// Of the option that methods with this hierarchy have in common.
inline nlohmann::json leaf_cones_schema() {
  return {{"enum", {LeafCones::ONE_RING, LeafCones::EDGE_NEIGHBOURS, LeafCones::OWN}},
          {"description",
           "which faces' normals a leaf's cone covers (decision E1): those round its corners, of the "
           "triangle and "
           "across its edges, or its own"}};
}

}  // namespace lmdbench
