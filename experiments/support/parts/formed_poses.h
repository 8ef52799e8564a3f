// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

namespace lmdbench::parts {

/// A corner, or a point on a side or inside a triangle.
Vec3 point_of(const Triangle& t, experiments::Random& random);

/// A pose where some triangle of one lies over one of the other; nothing else is checked.
Pose face_on_face(const TriangleMesh& moving, const TriangleMesh& fixed, experiments::Random& random);

/// Or the same place but for a small offset and a turn about z by a multiple of a polygon's angle;
/// or edge along or across edge, or a corner over a point. Gaps are from draw_gap.
Pose formed_pose(const TriangleMesh& moving, const TriangleMesh& fixed, experiments::Random& random);

}  // namespace lmdbench::parts
