// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/shape/planar_tolerance.h>

#include <cstdint>
#include <string>

namespace lmdbench {

/// Result of `flatten`, in the mesh's unit.
struct FlatteningReport {
  std::int64_t collapsed_triangles = 0;  ///< Had a side as short as rounding (short_edges.h).
  std::int64_t flipped_triangles = 0;    ///< Close a T junction (flat_triangles.h).
  double tolerance = 0.0;                ///< Allowed distance from planes; 0: not checked.
  std::int64_t planes = 0;               ///< Planes that vertices were put back into.
  std::int64_t moved_vertices = 0;       ///< Vertices whose coordinates changed.
  double largest_move = 0.0;             ///< Distance that the farthest of them went.
  /// Of a given tolerance: faces within it of a plane that are left to chance, and triangles lower
  /// than a few tolerances, whose planes are noise.
  std::int64_t faces_of_chance = 0, triangles_of_noise = 0;
};

/// Puts the vertices of a rounded mesh's planar faces back into their planes: those on two planes
/// onto the line, those on three onto the point that the planes share, never farther than needed.
/// Files in single precision (STL, most PLY files) turn a flat face of n vertices into up to n
/// local minima of 1e-8 of its size: all true, none meant, and an exact method finds them all.
///
/// Three vertices are always in a plane, so only faces of four and more are evidence, and on a scan
/// some of those are flat by chance. The share of neighbouring triangles that are nearly, but not
/// quite, in one plane (within ten tolerances) tells how many. Faces with as many vertices to spare
/// as chance explains are kept as they are, and so are curved scans.
///
/// So is a face whose plane would pull some vertex by more than LARGEST_MOVE tolerances (it meets
/// its neighbours at too small an angle, or four and more planes do not share the vertex), the one
/// with the fewest vertices first. Planes that are flat to the rounding of doubles do not change by
/// a bit. Where vertices moved, `mesh.planar_tolerance` becomes the tolerance. The result does not
/// depend on the numbering of vertices, triangles and corners.
///
/// The walls of a plate that is thinner than a few tolerances are noise: each of its sides gets a
/// plane of its own.
///
/// Before, edges as short as the rounding of doubles (with `AUTO` that of single precision in such
/// a mesh) are collapsed, and triangles that are flat to the tolerance, or to the rounding of
/// doubles, and close a T junction are flipped: rounding turns some of them over.
/// @param flips false for a mesh that deforms: its triangles gain area. Collapses none then, either
FlatteningReport flatten(TriangleMesh& mesh, const PlanarTolerance& choice = {}, bool flips = true);

/// Most that a vertex may move, in tolerances.
inline constexpr double LARGEST_MOVE = 4.0;

/// What was done to triangles, a clause for people; empty if nothing.
std::string repairs_text(const FlatteningReport& report);
/// Whether vertices moved, or a given tolerance leaves what it might not be meant to.
inline bool says_something(const FlatteningReport& report) {
  return report.moved_vertices + report.faces_of_chance + report.triangles_of_noise > 0;
}
/// What was done to vertices, a clause for people.
std::string to_text(const FlatteningReport& report);

}  // namespace lmdbench
