// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <functional>
#include <vector>

/// Machine parts: the solid between an outline round the z axis and a bore in it. As in shapes.h:
/// same bits on every processor, metres, centred, triangles counter-clockwise seen from outside.
namespace lmdbench {

/// Corners of a closed outline at a height [m]: `count` points, counter-clockwise round the z axis,
/// as many at every height. Every ray from the axis meets the outline once.
using Outline = std::function<std::vector<Vec2>(int count, double height)>;

/// @param under if given, points lie on its points' rays: strips between the two never fold
Outline circle_outline(double radius, const Outline& under = nullptr);

/// Regular polygon, first side square to the x axis at `inradius`. Counts: multiples of `sides`.
Outline polygon_outline(int sides, double inradius);

/// Spur gear, involute flanks: pressure angle 20 degrees, addendum 1 and dedendum 1.25 modules, a
/// tooth on x. Below the base circle flanks lean outwards a little: no ray from the axis runs along
/// them. Two mesh at an axis distance of half the module times the sum of teeth; `backlash` is off
/// each tooth's width at the pitch circle. Counts: multiples of 2 `teeth`, half for each flank.
Outline gear_outline(int teeth, double module, double backlash);

/// Right-handed thread from `radius` - `depth` to `radius`; crest, root: a sixth of the pitch each.
Outline thread_outline(double radius, double depth, double pitch);

struct SleeveChoice {
  double height = 1.0;        ///< Along z [m].
  int around = 24;            ///< Points of each outline.
  int layers = 1, rings = 1;  ///< Squares along the height, and across each end.
};

/// Upright body between outline and bore; solid without a bore. Both have their points in the same
/// order, and the ends are strips between them: 4 * around * (layers + rings) triangles with a
/// bore, 2 * around * (layers + 2 * rings - 1) without.
TriangleMesh make_sleeve(const Outline& outline, const Outline& bore, const SleeveChoice& choice);

}  // namespace lmdbench
