// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <functional>
#include <vector>

/// Machine parts: everything between an outline round the z axis and a bore in it. Like the other generated shapes
/// (shapes.h) the same bits on every processor, in metres, centred, triangles counter-clockwise seen from outside.
namespace lmdbench {

/// Corners of a closed outline at a height [m]: `count` points, counter-clockwise round the z axis, as many at every
/// height. Every ray from the axis meets the outline once.
using Outline = std::function<std::vector<Vec2>(int count, double height)>;

/// @param under where given, the points lie on the rays of that outline's points, so that a strip between the two does
///   not fold, however uneven its angles are
Outline circle_outline(double radius, const Outline& under = nullptr);

/// Regular polygon; its first side is square to the x axis, at the distance `inradius`. Counts are multiples of `sides`.
Outline polygon_outline(int sides, double inradius);

/// Spur gear with involute flanks: pressure angle 20 degrees, addendum 1 and dedendum 1.25 modules, a tooth on the x
/// axis. Below the base circle the flanks lean outwards a little, so that no ray from the axis runs along them. Two of one module mesh at a distance of axes of half the module times the sum of teeth; `backlash` is taken
/// off the width of each tooth at the pitch circle. Counts are multiples of 2 `teeth`, half of it for each flank.
Outline gear_outline(int teeth, double module, double backlash);

/// Right-handed thread between `radius` - `depth` and `radius`; crests and roots take a sixth of the pitch each.
Outline thread_outline(double radius, double depth, double pitch);

struct SleeveChoice {
  double height = 1.0;        ///< Along z [m].
  int around = 24;            ///< Points of each outline.
  int layers = 1, rings = 1;  ///< Squares along the height, and across each end.
};

/// Upright body between the outline and the bore; solid without a bore. Both have their points in the same order, and
/// the ends are strips between them: 4 * around * (layers + rings) triangles with a bore, 2 * around * (layers + 2 *
/// rings - 1) without.
TriangleMesh make_sleeve(const Outline& outline, const Outline& bore, const SleeveChoice& choice);

}  // namespace lmdbench
