// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/methods/improved/options.h>

#include <array>

namespace lmdbench {

/// A triangle with what the visibility pre-test reads, all in one frame.
struct ShadedTriangle {
  Triangle corners;
  std::array<Vec3, 3> vertex_normals;  ///< Unit pseudo-normals of the corners.
  Vec3 face_normal;                    ///< Unit, zero for a triangle without area.
};

/// The visibility pre-test (paper, section 4.1, Fig. 6): `a` is projected on the plane of `b`, and `b` on the
/// plane of `a`; a pair is culled when in either plane the projection and the other triangle do not overlap.
///
/// Decision E6, ours: "using the vertex normals for projection" means that each corner moves along its vertex
/// normal until it meets the other plane. A normal that is parallel to the plane or points away from it
/// projects nowhere, and then this side culls nothing. `ORTHOGONAL` projects along the plane's normal
/// instead; `OFF` sees everything. No policy is conservative on every mesh: reports state the recall of each.
bool see_each_other(const ShadedTriangle& a, const ShadedTriangle& b, Visibility visibility);

}  // namespace lmdbench
