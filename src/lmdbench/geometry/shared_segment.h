// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/types.h>

#include <array>
#include <optional>

namespace lmdbench::kernel {

/// On which side of the other triangle's plane the corners of each triangle are; exact.
struct Sides {
  std::array<int, 3> a{}, b{};

  Sides(const Triangle& ta, const Triangle& tb);

  static bool apart(const std::array<int, 3>& side) {
    return side[0] != 0 && side[0] == side[1] && side[1] == side[2];
  }
  /// Some plane of the two has the other triangle strictly on one side.
  bool planes_separate() const { return apart(b) || apart(a); }
  /// No corner lies in the other's plane.
  bool is_generic() const { return a[0] * a[1] * a[2] * b[0] * b[1] * b[2] != 0; }
};

/// triangles_intersect given the sides.
bool triangles_intersect(const Triangle& a, const Triangle& b, const Sides& sides);

/// intersection_segment for triangles that are known to intersect.
/// @pre corners in lexicographic order, `first` before `second`, triangles_intersect(first, second)
std::optional<Segment> shared_segment(const Triangle& first, const Triangle& second, const Sides& sides);

}  // namespace lmdbench::kernel
