// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/deform/refit_bounds.h>
#include <lmdbench/methods/certified/layout/single_precision.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/methods/certified/deform/refit_bounds.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/methods/certified/layout/wide_numbers-inl.h>

#include <hwy/highway.h>

#ifndef LMDBENCH_REFIT_BOUNDS_SETS
#define LMDBENCH_REFIT_BOUNDS_SETS

namespace lmdbench {

/// Steps that axes and centres are moved by, and the first one's divisor: what was found for the
/// frame before is nearly right (scripts/tuned_constants.py --only REFIT_STEPS
/// experiments/deforming.json).
constexpr int REFIT_STEPS = 1, FIRST_REFIT_STEP = 4;
/// Granted rounding: of lengths, over distances from the point of reference; of angles; and what is
/// left of lengths whose squares vanish [m].
constexpr float REFIT_LENGTH_ROUNDING = 1e-6F, REFIT_ANGLE_ROUNDING = 2e-6F, VANISHING_LENGTH = 1e-18F;

/// Up to three corners of a feature in each lane, from a point nearby; a corner may be repeated.
struct LaneCorners {
  static constexpr std::size_t CORNERS = 3;
  alignas(32) float x[CORNERS * WIDE_WIDTH];
  alignas(32) float y[CORNERS * WIDE_WIDTH];
  alignas(32) float z[CORNERS * WIDE_WIDTH];
  std::array<float, 3> reference;  ///< From the hierarchy's origin [m].
};

/// Lanes of one node that a lane above is bounded round.
struct LanesBelow {
  const WideNode* node;
  std::uint32_t lanes;      ///< Bits.
  std::uint32_t lmd_lanes;  ///< Of these, those that carry LMDs.
};

/// All of them: of a lane's node and those below it.
struct AllLanesBelow {
  std::array<LanesBelow, 1 + WIDE_WIDTH> nodes;
  std::size_t count = 0;
};

}  // namespace lmdbench

#endif  // LMDBENCH_REFIT_BOUNDS_SETS

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = VectorLanes;
using Number = VectorNumber;
using Choice = VectorChoice;

/// A vector a lane, and one for all.
struct Vectors {
  Number x, y, z;
};
struct Vector {
  float x = 0.0F, y = 0.0F, z = 0.0F;
};

HWY_INLINE Vectors spread(const Vector& v) {
  return {Lanes::set(v.x), Lanes::set(v.y), Lanes::set(v.z)};
}
HWY_INLINE Vectors load(const float* x, const float* y, const float* z) {
  return {Lanes::load(x), Lanes::load(y), Lanes::load(z)};
}
HWY_INLINE Vectors axes_of(const WideNode& node, std::uint32_t first) {
  return load(node.axis[0] + first, node.axis[1] + first, node.axis[2] + first);
}
HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Number dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vector operator*(float factor, const Vector& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
HWY_INLINE float dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE float largest(Number x) {
  return hn::GetLane(hn::MaxOfLanes(FloatTag(), x.raw));
}
HWY_INLINE void store(Number x, float* to) {
  hn::Store(x.raw, FloatTag(), to);
}

HWY_INLINE void extend(Vectors& low, Vectors& high, const Vectors& p) {
  low = {least_of(low.x, p.x), least_of(low.y, p.y), least_of(low.z, p.z)};
  high = {largest_of(high.x, p.x), largest_of(high.y, p.y), largest_of(high.z, p.z)};
}

/// Sine of the angle between unit vectors, from the square of their difference.
HWY_INLINE Number sine_of_angle(Number squared) {
  const Number squared_half_cosine = Lanes::set(1.0F) - Lanes::set(0.25F) * squared;
  return root(largest_of(Lanes::set(0.0F), squared * squared_half_cosine));
}

/// A size as it is stored: granted rounding added.
HWY_INLINE Number rounded_outwards(Number size, Number rounding) {
  return (size + rounding) * Lanes::set(1.0F + REFIT_LENGTH_ROUNDING);
}

/// Lanes of features, see refit_lanes.
void bound_features(WideNode& node, std::uint32_t lanes, const LaneCorners& corners, float rounding) {
  const Number half = Lanes::set(0.5F);
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += Lanes::count()) {
    const Vectors axis = axes_of(node, first);
    std::array<Vectors, LaneCorners::CORNERS> p;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const std::size_t at = k * WIDE_WIDTH + first;
      p[k] = load(corners.x + at, corners.y + at, corners.z + at);
    }
    Vectors low = p[0], high = p[0];
    Number low_along = dot(p[0], axis), high_along = low_along, squared_far = dot(p[0], p[0]);
    for (std::size_t k = 1; k < p.size(); ++k) {
      extend(low, high, p[k]);
      low_along = least_of(low_along, dot(p[k], axis));
      high_along = largest_of(high_along, dot(p[k], axis));
      squared_far = largest_of(squared_far, dot(p[k], p[k]));
    }
    const Vectors middle{half * (low.x + high.x), half * (low.y + high.y), half * (low.z + high.z)};
    const Number along = half * (low_along + high_along) - dot(middle, axis);
    const Vectors reference = spread({corners.reference[0], corners.reference[1], corners.reference[2]});
    const Vectors stored{reference.x + (middle.x + along * axis.x), reference.y + (middle.y + along * axis.y),
                         reference.z + (middle.z + along * axis.z)};
    const Vectors centre = stored - reference;
    Number squared_radius = Lanes::set(0.0F), thickness = squared_radius;
    for (const Vectors& corner : p) {
      const Vectors from = corner - centre;
      squared_radius = largest_of(squared_radius, dot(from, from));
      thickness = largest_of(thickness, magnitude(dot(from, axis)));
    }
    const Number granted =
        Lanes::set(rounding + VANISHING_LENGTH) +
        Lanes::set(REFIT_LENGTH_ROUNDING) * (root(squared_far) + root(dot(centre, centre)));
    const Choice has_axis = dot(axis, axis) > Lanes::set(0.0F), asked = Lanes::of_bits(lanes, first);
    const auto put = [&](float* row, Number value) {
      store(select(asked, value, Lanes::load(row + first)), row + first);
    };
    put(node.centre[0], stored.x);
    put(node.centre[1], stored.y);
    put(node.centre[2], stored.z);
    put(node.radius, rounded_outwards(root(squared_radius), granted));
    put(node.thickness,
        select(has_axis, rounded_outwards(thickness, granted), Lanes::set(UNBOUNDED_THICKNESS)));
  }
}

/// Rows of as many numbers as lanes that a lane is bounded round, a multiple of a vector's. Where a
/// lane is left out, another one is repeated.
struct Row {
  alignas(32) float of[(1 + WIDE_WIDTH) * WIDE_WIDTH];
};
struct Rows {
  Row x, y, z;
  HWY_INLINE Vectors at(std::size_t i) const { return load(x.of + i, y.of + i, z.of + i); }
  HWY_INLINE Vector one(std::size_t i) const { return {x.of[i], y.of[i], z.of[i]}; }
};

template <class Visit>
HWY_INLINE void for_each_vector(std::size_t count, Visit&& visit) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) visit(i);
}

/// The first place of a number in a row that holds it.
HWY_INLINE std::size_t place_of(float number, const Row& row) {
  std::size_t i = 0;
  while (row.of[i] < number || row.of[i] > number) ++i;
  return i;
}

/// Middle of the box of all vectors.
HWY_INLINE Vector middle_of_box(const Rows& rows, std::size_t count) {
  Vectors low = rows.at(0), high = low;
  for_each_vector(count, [&](std::size_t i) { extend(low, high, rows.at(i)); });
  return {0.5F * (Lanes::least(low.x) + largest(high.x)), 0.5F * (Lanes::least(low.y) + largest(high.y)),
          0.5F * (Lanes::least(low.z) + largest(high.z))};
}

/// Cones of lanes below, by their axes, cosines and sines.
struct Cones {
  Rows axes;
  Row cosine, sine;
  std::size_t count = 0;
};
/// Their bodies; points have no radius, thickness or axis.
struct Bodies {
  Rows centres, axes;
  Row radius, thickness;
  std::size_t count = 0;
};

/// Appends rows of a node's lanes, of those left out the first that is not.
HWY_INLINE void append(const float* of_node, std::uint32_t lanes, Row& row, std::size_t at) {
  const float instead = of_node[std::countr_zero(lanes)];
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += Lanes::count())
    store(select(Lanes::of_bits(lanes, first), Lanes::load(of_node + first), Lanes::set(instead)),
          row.of + at + first);
}
HWY_INLINE void append(const float (&of_node)[3][WIDE_WIDTH], std::uint32_t lanes, Rows& rows,
                       std::size_t at) {
  append(of_node[0], lanes, rows.x, at);
  append(of_node[1], lanes, rows.y, at);
  append(of_node[2], lanes, rows.z, at);
}

/// The axis of the cone round all cones; zero where there is none. @param before  or zero
HWY_INLINE Vector axis_of(const Cones& cones, const Vector& before) {
  Row reaches;
  // Cosine of the widest direction, and the cone that holds it.
  const auto widest_about = [&](const Vector& axis, std::size_t& widest) {
    const Vectors u = spread(axis);
    Number narrow = Lanes::set(2.0F);
    for_each_vector(cones.count, [&](std::size_t i) {
      const Number cosine = least_of(Lanes::set(1.0F), dot(u, cones.axes.at(i)));
      const Number sine = root(largest_of(Lanes::set(0.0F), Lanes::set(1.0F) - cosine * cosine));
      const Number reach = cosine * Lanes::load(cones.cosine.of + i) - sine * Lanes::load(cones.sine.of + i);
      narrow = least_of(narrow, reach);
      store(reach, reaches.of + i);
    });
    const float cosine = Lanes::least(narrow);
    widest = place_of(cosine, reaches);
    return cosine;
  };
  const auto unit = [](const Vector& v) { return 1.0F / std::sqrt(dot(v, v)) * v; };
  const auto is_unit = [](const Vector& v) { return std::abs(dot(v, v) - 1.0F) < 1e-3F; };
  Vector axis{}, best{};
  float best_cosine = -2.0F;
  std::size_t widest = 0;
  for (const Vector& start : {before, unit(middle_of_box(cones.axes, cones.count))}) {
    std::size_t widest_here = 0;
    if (!is_unit(start)) continue;  // Zero, or no number.
    const float cosine = widest_about(start, widest_here);
    if (!(cosine > best_cosine)) continue;
    axis = best = start;
    best_cosine = cosine;
    widest = widest_here;
  }
  if (!is_unit(axis)) return {};
  float cosine = best_cosine;
  for (int step = 0; step < REFIT_STEPS; ++step) {
    const Vector towards = cones.axes.one(widest);
    const Vector across = towards - dot(axis, towards) * axis;
    const float squared_across = dot(across, across);
    if (!(squared_across > 1e-12F)) break;
    const float sine = std::sqrt(std::max(0.0F, 1.0F - cosine * cosine));
    axis = unit(axis +
                sine / (static_cast<float>(step + FIRST_REFIT_STEP) * std::sqrt(squared_across)) * across);
    cosine = widest_about(axis, widest);
    if (!(cosine > best_cosine)) continue;
    best_cosine = cosine;
    best = axis;
  }
  return best;
}

/// Stores the cone about an axis. @return whether there is one
HWY_INLINE bool bound_cone(WideNode& node, std::uint32_t lane, const Cones& cones, const Vector& axis) {
  const Vectors u = spread(axis);
  const Number one = Lanes::set(1.0F);
  Number cosines = one, sines = Lanes::set(0.0F);
  for_each_vector(cones.count, [&](std::size_t i) {
    // Of the angle between two axes, from their difference: small angles keep their digits.
    const Vectors apart = cones.axes.at(i) - u;
    const Number squared = dot(apart, apart);
    const Number cosine = one - Lanes::set(0.5F) * squared;
    const Number sine = sine_of_angle(squared);
    const Number own_sine = Lanes::load(cones.sine.of + i);
    cosines = least_of(cosines, cosine * Lanes::load(cones.cosine.of + i) - sine * own_sine);
    // Of the sum of two angles up to 90 degrees, and more.
    sines = largest_of(sines, sine + cosine * own_sine);
  });
  const float cosine = Lanes::least(cosines) - REFIT_ANGLE_ROUNDING;
  // Written so that what is no number is refused.
  if (!(cosine > 0.0F)) return false;
  node.axis[0][lane] = axis.x;
  node.axis[1][lane] = axis.y;
  node.axis[2][lane] = axis.z;
  node.cosine[lane] = cosine;
  node.sine[lane] = std::min({1.0F, largest(sines) + REFIT_ANGLE_ROUNDING,
                              std::sqrt((1.0F - cosine) * (1.0F + cosine)) + REFIT_ANGLE_ROUNDING});
  return true;
}

/// Stores the body round bodies. @param reference  their centres are from here; exact where zero
HWY_INLINE void bound_body(WideNode& node, std::uint32_t lane, const Bodies& bodies, const Vector& reference,
                           bool are_points, float rounding) {
  const Vector axis{node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]};
  const Vectors u = spread(axis);
  const Number zero = Lanes::set(0.0F), one = Lanes::set(1.0F);
  const bool has_axis = dot(axis, axis) > 0.0F;
  const auto radius_at = [&](std::size_t i) { return are_points ? zero : Lanes::load(bodies.radius.of + i); };

  // How far each extends along the axis from its centre: to its sphere, or to the rim where its
  // slab cuts the sphere off.
  Row extents;
  Number lowest = Lanes::set(std::numeric_limits<float>::max()), highest = -lowest;
  for_each_vector(bodies.count, [&](std::size_t i) {
    Number extent = zero;
    if (!are_points) {
      const Number radius = radius_at(i);
      const Number thickness = least_of(radius, Lanes::load(bodies.thickness.of + i));
      const Vectors own = bodies.axes.at(i);
      const Number along = dot(u, own);
      const Number facing = select(along < zero, -one, one);
      const Vectors apart{own.x - facing * u.x, own.y - facing * u.y, own.z - facing * u.z};
      const Number sine = sine_of_angle(dot(apart, apart));
      const Number rim = thickness * least_of(one, magnitude(along)) +
                         root((radius - thickness) * (radius + thickness)) * sine +
                         Lanes::set(REFIT_LENGTH_ROUNDING) * radius;
      extent = select(radius * magnitude(along) > thickness, least_of(radius, rim), radius);
    }
    store(extent, extents.of + i);
    const Number along = dot(bodies.centres.at(i), u);
    lowest = least_of(lowest, along - extent);
    highest = largest_of(highest, along + extent);
  });
  const float middle_along = 0.5F * (Lanes::least(lowest) + largest(highest));
  // Bodies without an axis are spheres: their extent says nothing.
  const auto to_middle = [&](const Vector& centre) {
    return has_axis ? centre + (middle_along - dot(centre, axis)) * axis : centre;
  };
  Row distances;
  const auto farthest_from = [&](const Vector& centre, std::size_t& farthest) {
    Number far = zero;
    const Vectors from = spread(centre);
    for_each_vector(bodies.count, [&](std::size_t i) {
      const Vectors to = bodies.centres.at(i) - from;
      const Number distance = root(dot(to, to)) + radius_at(i);
      far = largest_of(far, distance);
      store(distance, distances.of + i);
    });
    const float distance = largest(far);
    farthest = place_of(distance, distances);
    return distance;
  };
  const Vector before{node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]};
  Vector centre{}, best{};
  float least_radius = std::numeric_limits<float>::infinity();
  std::size_t farthest = 0;
  for (const Vector& start :
       {to_middle(middle_of_box(bodies.centres, bodies.count)), to_middle(before - reference)}) {
    std::size_t farthest_here = 0;
    const float distance = farthest_from(start, farthest_here);
    if (!(distance < least_radius)) continue;
    centre = best = start;
    least_radius = distance;
    farthest = farthest_here;
  }
  for (int step = 0; step < REFIT_STEPS; ++step) {
    const Vector towards = bodies.centres.one(farthest) - centre;
    const Vector across = towards - dot(towards, axis) * axis;
    centre = centre + 0.5F / static_cast<float>(step + FIRST_REFIT_STEP) * across;
    const float distance = farthest_from(centre, farthest);
    if (!(distance < least_radius)) continue;
    least_radius = distance;
    best = centre;
  }

  const Vector stored = reference + best;
  const Vector centre_from_reference = stored - reference;
  const Vectors from = spread(centre_from_reference);
  Number radius = zero, thickness = zero, far = zero;
  for_each_vector(bodies.count, [&](std::size_t i) {
    const Vectors p = bodies.centres.at(i), to = p - from;
    radius = largest_of(radius, root(dot(to, to)) + radius_at(i));
    thickness = largest_of(thickness, magnitude(dot(to, u)) + Lanes::load(extents.of + i));
    far = largest_of(far, root(are_points ? dot(p, p) : dot(to, to)));
  });
  const float granted =
      rounding + VANISHING_LENGTH +
      REFIT_LENGTH_ROUNDING *
          (largest(far) + (are_points ? std::sqrt(dot(centre_from_reference, centre_from_reference)) : 0.0F));
  node.centre[0][lane] = stored.x;
  node.centre[1][lane] = stored.y;
  node.centre[2][lane] = stored.z;
  const auto outwards = [&](Number size) { return largest(rounded_outwards(size, Lanes::set(granted))); };
  node.radius[lane] = outwards(radius);
  node.thickness[lane] = has_axis ? outwards(thickness) : UNBOUNDED_THICKNESS;
}

/// A lane of a node, see refit_lanes. @param corners  of plain features right below it, else null
void bound_node(WideNode& node, std::uint32_t lane, const AllLanesBelow& below, const LaneCorners* corners,
                float rounding) {
  Cones cones;
  Bodies bodies;
  for (std::size_t k = 0; k < below.count; ++k) {
    const auto& [part, lanes, lmd_lanes] = below.nodes[k];
    if (lmd_lanes != 0) {
      append(part->axis, lmd_lanes, cones.axes, cones.count);
      append(part->cosine, lmd_lanes, cones.cosine, cones.count);
      append(part->sine, lmd_lanes, cones.sine, cones.count);
      cones.count += WIDE_WIDTH;
    }
    if (corners == nullptr && lanes != 0) {
      append(part->centre, lanes, bodies.centres, bodies.count);
      append(part->axis, lanes, bodies.axes, bodies.count);
      append(part->radius, lanes, bodies.radius, bodies.count);
      append(part->thickness, lanes, bodies.thickness, bodies.count);
      bodies.count += WIDE_WIDTH;
    }
  }
  const Vector before{node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]};
  const bool carries_lmd = cones.count > 0;
  // No cone holds one of all directions, which has no axis, cosine 0 and sine 1.
  if (!carries_lmd || !bound_cone(node, lane, cones, axis_of(cones, before))) {
    node.axis[0][lane] = node.axis[1][lane] = node.axis[2][lane] = 0.0F;
    node.cosine[lane] = carries_lmd ? 0.0F : NO_LMD_COSINE;
    node.sine[lane] = carries_lmd ? 1.0F : 0.0F;
  }
  if (corners == nullptr && bodies.count == 0) {  // All its features have lost their cones.
    node.centre[0][lane] = node.centre[1][lane] = node.centre[2][lane] = 0.0F;
    node.radius[lane] = 0.0F;
    node.thickness[lane] = UNBOUNDED_THICKNESS;
    return;
  }
  Vector reference;
  if (corners != nullptr) {
    bodies.count = LaneCorners::CORNERS * WIDE_WIDTH;
    std::copy_n(corners->x, bodies.count, bodies.centres.x.of);
    std::copy_n(corners->y, bodies.count, bodies.centres.y.of);
    std::copy_n(corners->z, bodies.count, bodies.centres.z.of);
    reference = {corners->reference[0], corners->reference[1], corners->reference[2]};
  }
  bound_body(node, lane, bodies, reference, corners != nullptr, rounding);
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(bound_features);
HWY_EXPORT(bound_node);

namespace {

/// @param lanes  bits of lanes of single vertices, edges and triangles; not none
void collect_corners(const WideNode& node, std::uint32_t lanes, const WideHierarchy& hierarchy,
                     const Surface& surface, LaneCorners& corners) {
  const TriangleMesh& mesh = surface.mesh;
  const auto corners_of = [&](std::uint32_t lane) -> std::array<std::int32_t, 3> {
    const FeatureId feature = WideRef::from_bits(node.child[lane]).feature_id();
    const auto i = static_cast<std::size_t>(feature.index);
    if (feature.kind == FeatureKind::FACE) return mesh.triangles[i];
    if (feature.kind == FeatureKind::VERTEX) return {feature.index, feature.index, feature.index};
    const auto& ends = surface.adjacency.edges[i];
    return {ends[0], ends[1], ends[1]};
  };
  const auto some = static_cast<std::uint32_t>(std::countr_zero(lanes));
  const Vec3 near = mesh.vertices[static_cast<std::size_t>(corners_of(some)[0])] - hierarchy.origin;
  Vec3 reference;
  for (int k = 0; k < 3; ++k) {
    corners.reference[static_cast<std::size_t>(k)] = to_single(near[k]);
    reference[k] = hierarchy.origin[k] + static_cast<double>(corners.reference[static_cast<std::size_t>(k)]);
  }
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    const auto own = corners_of((lanes >> lane & 1u) != 0 ? lane : some);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const Vec3 p = mesh.vertices[static_cast<std::size_t>(own[k])] - reference;
      const std::size_t at = k * WIDE_WIDTH + lane;
      corners.x[at] = static_cast<float>(p.x());
      corners.y[at] = static_cast<float>(p.y());
      corners.z[at] = static_cast<float>(p.z());
    }
  }
}

/// Bits of a node's lanes for which something holds.
template <class Holds>
std::uint32_t lanes_of(const WideNode& node, Holds&& holds) {
  std::uint32_t bits = 0;
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane)
    if (node.child[lane] != 0 && holds(lane, WideRef::from_bits(node.child[lane]))) bits |= 1u << lane;
  return bits;
}

}  // namespace

void refit_lanes(WideNode& node, std::uint32_t lanes, const WideHierarchy& hierarchy, const Surface& surface,
                 const ShapeComplex& shape) {
  const float rounding = round_up_to_single(hierarchy.rounding());
  LaneCorners corners;
  const std::uint32_t features =
      lanes & lanes_of(node, [](std::uint32_t, const WideRef& ref) { return ref.is_feature(); });
  if (features != 0) {
    collect_corners(node, features, hierarchy, surface, corners);
    HWY_DYNAMIC_DISPATCH(bound_features)(node, features, corners, rounding);
  }
  for (std::uint32_t left = lanes & ~features; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    AllLanesBelow below;
    const auto put = [&](const WideNode& part, std::uint32_t of_part) {
      const auto carries_lmd = [&](std::uint32_t l, const WideRef&) {
        return part.cosine[l] != NO_LMD_COSINE;
      };
      below.nodes[below.count++] = {&part, of_part, of_part & lanes_of(part, carries_lmd)};
    };
    const WideNode& own = hierarchy.nodes[WideRef::from_bits(node.child[lane]).node_index()];
    bool all_plain = true;
    put(own, lanes_of(own, [&](std::uint32_t, const WideRef& ref) {
          all_plain = all_plain && ref.is_feature() && !shape.is_lead_of_several(ref.feature_id());
          return ref.is_feature();
        }));
    for (std::uint32_t l = 0; l < WIDE_WIDTH; ++l) {
      const WideRef ref = WideRef::from_bits(own.child[l]);
      if (ref.is_empty() || ref.is_feature()) continue;
      const WideNode& inner = hierarchy.nodes[ref.node_index()];
      put(inner, lanes_of(inner, [](std::uint32_t, const WideRef&) { return true; }));
    }
    all_plain = all_plain && below.nodes[0].lanes != 0;
    if (all_plain) collect_corners(own, below.nodes[0].lanes, hierarchy, surface, corners);
    HWY_DYNAMIC_DISPATCH(bound_node)(node, lane, below, all_plain ? &corners : nullptr, rounding);
  }
}

}  // namespace lmdbench

#endif  // HWY_ONCE
