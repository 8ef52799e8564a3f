// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/shape/planar_tolerance.h>

#include <cstdint>
#include <string>

namespace lmdbench {

/// What `flatten` did to a mesh, in its unit.
struct FlatteningReport {
  double tolerance = 0.0;  ///< What vertices of one plane were allowed to be apart from it; 0: not looked at.
  std::int64_t planes = 0;          ///< Planes that vertices were put back into.
  std::int64_t moved_vertices = 0;  ///< Vertices whose coordinates changed.
  double largest_move = 0.0;        ///< Distance that the farthest of them went.
};

/// Puts the vertices of a rounded mesh's planar faces back into their planes: those on two planes onto the
/// line, those on three onto the point that the planes share, and nowhere farther than needed. Files in
/// single precision (STL, most PLY files) turn a flat face of n vertices into up to n local minima of 1e-8 of
/// its size, all true, none meant; and a method that is exact finds them all.
///
/// Three vertices always lie in a plane, so only faces of four and more say anything, and on a scan some of
/// those are flat by chance. How many is known: the share of neighbouring triangles that are nearly, but not
/// quite, in one plane (within ten tolerances) tells how many within one are chance. Faces with as many
/// vertices to spare as chance explains are left alone, so curved scans stay as they are.
///
/// A face whose plane would pull some vertex by more than LARGEST_MOVE tolerances (it meets its neighbours at
/// too small an angle, or four and more planes do not share the vertex) is left alone too, the one with the
/// fewest vertices first. A mesh whose planes are flat to the rounding of doubles is not changed by a bit.
/// Where vertices moved, `mesh.planar_tolerance` becomes the tolerance. Where they go does not depend on how vertices,
/// triangles and corners are counted.
FlatteningReport flatten(TriangleMesh& mesh, const PlanarTolerance& choice = {});

/// Tolerances that a vertex may be moved by.
inline constexpr double LARGEST_MOVE = 4.0;

/// A clause for people.
std::string to_text(const FlatteningReport& report);

}  // namespace lmdbench
