// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/types.h>

#include <optional>

namespace lmdbench::kernel {

/// intersection_segment for triangles that are known to intersect.
/// @pre corners in lexicographic order, `first` before `second`, triangles_intersect(first, second)
std::optional<Segment> shared_segment(const Triangle& first, const Triangle& second);

}  // namespace lmdbench::kernel
