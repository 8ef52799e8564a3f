// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/types.h>

#include <optional>

namespace lmdbench::kernel {

/// Nearest pair of two triangles where it is unique by a clear margin, found by descent over features and
/// proved by the signs of six dot products; empty where nothing was proved: contact, parallel features, exact
/// ties, degenerate triangles, coordinates that are not finite. What it returns is bit for bit what the
/// examination of all candidates gives.
/// @param tolerance coincidence_length of the largest coordinate
std::optional<TrianglePairDistance> certified_descent(const Triangle& a, const Triangle& b, double tolerance);

}  // namespace lmdbench::kernel
