// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>

namespace lmdbench {

/// The segment that two triangles share which clearly cross: by margins far above rounding, with the segment's
/// middle inside both.
struct ClearCrossing {
  Vec3 middle;
  double length = 0.0;  ///< 0: the triangles do not cross clearly; they may still touch
};

/// Looks for clear crossings of a[i] and b[i], several pairs at a time in the widest vectors that the processor
/// has (the same bits on every processor): a tenth of triangle_distance's cost, with its answer to 1e-12 of the
/// largest coordinate where there is one.
/// @pre a.size() == b.size() == results.size()
void find_clear_crossings(std::span<const Triangle> a, std::span<const Triangle> b,
                          std::span<ClearCrossing> results);

}  // namespace lmdbench
