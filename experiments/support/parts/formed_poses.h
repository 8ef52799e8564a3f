// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

namespace lmdbench::parts {

/// A corner, or a point on a side or in the inside of a triangle.
Vec3 point_of(const Triangle& t, experiments::Random& random);

/// Some triangle of the one lies over some triangle of the other, however the rest is.
Pose face_on_face(const TriangleMesh& moving, const TriangleMesh& fixed, experiments::Random& random);

/// That; or in the same place, but for a turn about z by a multiple of a regular polygon's angle and a small way; or an edge
/// along or across an edge, or a corner over a point of the other. Gaps are those of draw_gap.
Pose formed_pose(const TriangleMesh& moving, const TriangleMesh& fixed, experiments::Random& random);

}  // namespace lmdbench::parts
