// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/build/polar_cap.h>

#include <array>
#include <cstdint>
#include <optional>

/// Vertices of a mesh that deforms whose polar cone is plain without the search of polar_cap.h. What is not plain is left to
/// the search, so that both say the same but for the width of a cap within its slack.
namespace lmdbench {

/// Four neighbours of a vertex, or -1.
using SaddleWitness = std::array<std::int32_t, 4>;
inline constexpr SaddleWitness NO_WITNESS{-1, -1, -1, -1};

/// Whether the vertex lies clearly inside the tetrahedron of four of its neighbours. Then its polar cone is empty: let u_i be the unit
/// wings and d_i the determinants of the other three, all of one sign and from m to D. Then sum d_i u_i = 0, and n . u_i <= s for all i
/// means |n . u_i| <= 3 D s / m. The three wings whose determinant is D have duals no longer than 1 / D, so |n| <= 9 s / m, which is
/// below 1 (m = LEAST_DETERMINANT, s = POLAR_SLACK).
/// @param least_wing  wings up to this long say nothing (LEAST_WING) [m]
bool is_clear_saddle(const Surface& surface, std::int32_t vertex, const SaddleWitness& witness,
                     double least_wing = 0.0);

/// Four neighbours for which that is so; NO_WITNESS where there are none.
/// @pre the vertex's wings are its neighbours (ShapeComplex)
SaddleWitness find_saddle_witness(const Surface& surface, std::int32_t vertex);

/// The cap of a vertex all of whose triangles have all other neighbours clearly below them: its polar cone is that of their
/// normals. Nothing where it is not so.
/// @pre as above
std::optional<PolarCap> clear_peak_cap(const Surface& surface, std::int32_t vertex, double least_wing = 0.0);

}  // namespace lmdbench
