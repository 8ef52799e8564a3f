// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>

/// Sines of generated shapes are rounded to multiples of 2^-30, because their last bits depend on
/// the processor's instruction set.
namespace lmdbench {

/// Nearest multiple of 2^-30.
inline double rounded_to_grid(double value) {
  return std::ldexp(std::round(std::ldexp(value, 30)), -30);
}

/// Point i of n on the unit circle; i may be n or more.
inline std::array<double, 2> circle_point(int i, int n) {
  const double angle = 2.0 * std::numbers::pi * (i % n) / n;
  return {rounded_to_grid(std::cos(angle)), rounded_to_grid(std::sin(angle))};
}

/// Generated shapes: for tests and for work without a network. Lengths are metres, triangles
/// counter-clockwise seen from outside, every shape centred at the origin. The same arguments give
/// the same bits on every processor. Counts below their least useful value are a programming error
/// (asserted).

/// Icosphere: 20 * 4^subdivisions triangles, nearly equal.
TriangleMesh make_sphere(double radius, int subdivisions);

/// Box with `cells` by `cells` squares a side: 12 * cells^2 triangles, most edges flat.
TriangleMesh make_box(const Vec3& size, int cells = 1);

/// The same with cells for each axis: a plate of n by n by 1 cells has 4 * n^2 + 8 * n triangles.
TriangleMesh make_box(const Vec3& size, const std::array<int, 3>& cells);

/// Torus about z, genus 1: 2 * ring_cells * tube_cells triangles; convex outside, saddles inside.
TriangleMesh make_torus(double ring_radius, double tube_radius, int ring_cells, int tube_cells);

/// Icosphere with smooth bumps and dents of up to `bump_height`: separate convex places, like a
/// scan.
TriangleMesh make_blob(double radius, double bump_height, int subdivisions);

/// Bumpy closed shape of 12 * cells^2 triangles whose sides differ by a factor of about `ratio` (>
/// 1): tiny ones round one corner of a cube blown up to a sphere, huge ones at the opposite corner.
TriangleMesh make_unequal(double radius, int cells, double ratio);

/// Spindle with five smooth ridges, of 4 * count needles that all meet in its two tips; their
/// aspect is about count * height / (3 radius). `groove` in [0, 1) is the relative depth of the
/// valleys between the ridges; 0 makes it convex.
TriangleMesh make_needles(double radius, double height, int count, double groove = 0.3);

/// Drum of 4 * count - 4 triangles, upright along z. Its ends, the lower flat, the upper a saddle
/// of height `height` / 4, are made of caps (triangles with one angle near 180 degrees): ears are
/// cut off the outline again and again. The outermost angles are 180 - 360 / count degrees.
TriangleMesh make_caps(double radius, double height, int count);

/// Open wavy patch over [-size/2, size/2]^2, outer side up: 2 * cells^2 triangles, one boundary
/// loop.
TriangleMesh make_patch(double size, int cells, double wave_height);

/// Wedge of 8 triangles: a prism along y with a sharp upper edge. The base is `width` (x) by
/// `length` (y), the edge is `height` above it.
TriangleMesh make_wedge(double width, double length, double height);

/// Block of 20 triangles: an L-shaped profile in xz, extruded along y, with one reflex edge, all
/// else convex or flat. Arms of length `size` and thickness `size` / 2.
TriangleMesh make_l_block(double size);

/// Two equal boxes `gap` apart along x, as one mesh of two components.
TriangleMesh make_two_boxes(const Vec3& size, double gap);

/// Copy turned by a rotation (normalised here) and rounded to single precision, as in STL files.
TriangleMesh turned_to_floats(TriangleMesh mesh, const Eigen::Quaterniond& rotation);

/// Copy moved by `offset`.
TriangleMesh translated(TriangleMesh mesh, const Vec3& offset);

/// Copy scaled about the origin.
TriangleMesh scaled(TriangleMesh mesh, double factor);

/// One mesh with the vertices and triangles of a, then those of b. Nothing is welded.
TriangleMesh merged(TriangleMesh a, const TriangleMesh& b);

}  // namespace lmdbench
