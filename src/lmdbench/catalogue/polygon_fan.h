// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <cstddef>
#include <optional>
#include <span>

namespace lmdbench {

/// The first corner from which a polygon's triangles (the fan of that corner) all turn as the
/// polygon does; a triangle turned over by less than 1e-6 of the area is rounding. Of a convex
/// polygon the first one.
/// @return none where every fan would fold
std::optional<std::size_t> fan_corner(std::span<const Vec3> corners);

}  // namespace lmdbench
