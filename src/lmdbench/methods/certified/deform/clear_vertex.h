// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/build/polar_cap.h>

#include <array>
#include <cstdint>
#include <optional>

/// Vertices whose polar cone is found without the search of polar_cap.h. Both say the same, but for
/// the width of a cap within its slack.
namespace lmdbench {

/// Four neighbours of a vertex, or -1.
using SaddleWitness = std::array<std::int32_t, 4>;
inline constexpr SaddleWitness NO_WITNESS{-1, -1, -1, -1};

/// Whether the vertex lies clearly inside the tetrahedron of four of its neighbours. Then its cone
/// is empty: let u_i be the unit wings and d_i the determinants of the other three, all of one sign
/// and from m to D. As sum d_i u_i = 0, n . u_i <= s for all i means |n . u_i| <= 3 D s / m. The
/// wings of D have duals of at most 1 / D, so |n| <= 9 s / m < 1 (m = LEAST_DETERMINANT, s =
/// POLAR_SLACK).
/// @param least_wing  wings up to this long say nothing (LEAST_WING) [m]
bool is_clear_saddle(const Surface& surface, std::int32_t vertex, const SaddleWitness& witness,
                     double least_wing = 0.0);

/// Four neighbours for which is_clear_saddle holds, or NO_WITNESS.
/// @pre the vertex's wings are its neighbours (ShapeComplex)
SaddleWitness find_saddle_witness(const Surface& surface, std::int32_t vertex);

/// The cap of a vertex whose triangles have all other neighbours clearly below them, or nothing.
/// @pre as above
std::optional<PolarCap> clear_peak_cap(const Surface& surface, std::int32_t vertex, double least_wing = 0.0);

}  // namespace lmdbench
