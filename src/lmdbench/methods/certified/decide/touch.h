// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/decide/triangle_contact_batch.h>

namespace lmdbench {

/// The gap (PROOF.md, lemma 12) along the first axis that shows one above `margin`, out of both
/// normals and the products of two sides (the separating axes of convex bodies). It only saves an
/// exact distance, so parallel sides need no care.
/// @param normal_a unit normal, or zero for a triangle without area
/// @param margin   far above the rounding of the coordinates
ClearGap clear_gap(const Triangle& a, const Vec3& normal_a, const Triangle& b, const Vec3& normal_b,
                   double margin);

/// The same along the normals alone, which tell nearly all pairs of triangles apart.
ClearGap gap_along_normals(const Triangle& a, const Vec3& normal_a, const Triangle& b, const Vec3& normal_b,
                           double margin);

}  // namespace lmdbench
