// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// The criteria of the node test, compiled once for every instruction set: included after
// foreach_target.h, with an include guard that Highway toggles.
#if defined(LMDBENCH_WIDE_CRITERIA_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_WIDE_CRITERIA_INL_H
#undef LMDBENCH_WIDE_CRITERIA_INL_H
#else
#define LMDBENCH_WIDE_CRITERIA_INL_H
#endif

#include <lmdbench/methods/certified/layout/wide_numbers-inl.h>
#include <lmdbench/methods/certified/traverse/wide_node_test.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Fetches a node that will be tested soon: meshes larger than the cache are slow to descend
/// otherwise.
HWY_INLINE void fetch(const WideNode& node) {
  constexpr std::size_t CACHE_LINE = 64;
  const auto* const bytes = reinterpret_cast<const char*>(&node);
  for (std::size_t i = 0; i < sizeof(WideNode); i += CACHE_LINE) __builtin_prefetch(bytes + i);
}

/// Kinds of a node's children, as bit masks.
struct KindBits {
  std::uint32_t features = 0;
  std::uint32_t faces = 0;
};

HWY_INLINE KindBits kind_bits(const WideNode& node) {
  const FloatTag f;
  const hn::RebindToSigned<FloatTag> i;
  KindBits bits;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += static_cast<std::uint32_t>(hn::Lanes(i))) {
    const auto child = hn::BitCast(i, hn::Load(hn::RebindToUnsigned<FloatTag>(), node.child + first));
    bits.features |= mask_bits(f, hn::RebindMask(f, hn::MaskFromVec(hn::BroadcastSignBit(child))), first);
    bits.faces |=
        mask_bits(f, hn::RebindMask(f, hn::MaskFromVec(hn::BroadcastSignBit(hn::Add(child, child)))), first);
  }
  return bits;
}

/// Quantities of wide_node_test.h for some lanes of a node and a probe.
template <class Lanes>
struct LaneBounds {
  using Number = typename Lanes::Number;

  Number cx, cy, cz;              ///< Lanes' centres.
  Number dx, dy, dz;              ///< D
  Number ux, uy, uz;              ///< Lanes' axes.
  Number axis_x, axis_y, axis_z;  ///< Probe's axis.
  Number radius, cosine, sine;    ///< Lanes'.
  Number probe_cosine, probe_sine;
  Number squared_distance, z_probe, z_lane;  ///< |D|^2; z of the probe and of the lane.
  Number between, across;                    ///< u . u' and the sine of their angle, rounded up.
  Number radii, slab_probe, slab_lane;       ///< With granted rounding.

  HWY_INLINE LaneBounds(const WideNode& node, const WidePlaces& places, std::uint32_t first,
                        const WideProbe& probe, float granted) {
    const auto set = [](float x) HWY_ATTR { return Lanes::set(x); };
    const Number rounding = set(granted);
    cx = Lanes::load(places.centre[0] + first);
    cy = Lanes::load(places.centre[1] + first);
    cz = Lanes::load(places.centre[2] + first);
    dx = cx - set(probe.centre[0]);
    dy = cy - set(probe.centre[1]);
    dz = cz - set(probe.centre[2]);
    ux = Lanes::load(places.axis[0] + first);
    uy = Lanes::load(places.axis[1] + first);
    uz = Lanes::load(places.axis[2] + first);
    axis_x = set(probe.axis[0]);
    axis_y = set(probe.axis[1]);
    axis_z = set(probe.axis[2]);
    radius = Lanes::load(node.radius + first);
    cosine = Lanes::load(node.cosine + first);
    sine = Lanes::load(node.sine + first);
    probe_cosine = set(probe.cosine);
    probe_sine = set(probe.sine);
    squared_distance = dot(dx, dy, dz, dx, dy, dz);
    z_probe = dot(dx, dy, dz, axis_x, axis_y, axis_z);
    z_lane = -dot(dx, dy, dz, ux, uy, uz);
    between = dot(ux, uy, uz, axis_x, axis_y, axis_z);
    across = root(largest_of(set(1.0F) - between * between, set(0.0F)) + set(DIRECTION_ROUNDING));
    const Number along = magnitude(between);
    const Number thickness = Lanes::load(node.thickness + first);
    const Number probe_radius = set(probe.radius), probe_thickness = set(probe.thickness);
    radii = (radius + probe_radius) + rounding;
    slab_probe = (probe_thickness + rounding) + (thickness * along + radius * across);
    slab_lane = (thickness + rounding) + (probe_thickness * along + probe_radius * across);
  }

  static HWY_INLINE Number dot(Number ax, Number ay, Number az, Number bx, Number by, Number bz) {
    return (ax * bx + ay * by) + az * bz;
  }
};

/// How far two children are apart across the probe and across the lane.
template <class Lanes>
struct LaneWidths {
  using Number = typename Lanes::Number;

  Number bx, by, bz;                    ///< Across the lanes.
  Number across_x, across_y, across_z;  ///< Across the probe.
  Number along_probe, along_lane;       ///< D . b
  Number gap_probe, gap_lane;           ///< Lower bounds of |d . b|, rounding granted.

  HWY_INLINE LaneWidths(const LaneBounds<Lanes>& bounds, const WideNode& node, const WidePlaces& places,
                        std::uint32_t first, const WideProbe& probe, const WideWidthTest& widths,
                        float granted) {
    const auto set = [](float x) HWY_ATTR { return Lanes::set(x); };
    using Bounds = LaneBounds<Lanes>;
    bx = Lanes::load(places.across[0] + first);
    by = Lanes::load(places.across[1] + first);
    bz = Lanes::load(places.across[2] + first);
    across_x = set(widths.across[0]);
    across_y = set(widths.across[1]);
    across_z = set(widths.across[2]);
    along_probe = Bounds::dot(bounds.dx, bounds.dy, bounds.dz, across_x, across_y, across_z);
    along_lane = Bounds::dot(bounds.dx, bounds.dy, bounds.dz, bx, by, bz);
    const Number lane_width = Lanes::load(widths.lanes.half_width + first),
                 probe_width = set(widths.half_width);
    const Number between = magnitude(Bounds::dot(bx, by, bz, across_x, across_y, across_z));
    // Along b, of the other child; `tilt` is the size of b . u'.
    const auto extent = [&](Number tilt, Number thickness, Number width, Number radius) HWY_ATTR {
      const Number rest = (set(1.0F) - tilt * tilt) - between * between;
      return (thickness * tilt + width * between) +
             radius * root(largest_of(rest, set(0.0F)) + set(DIRECTION_ROUNDING));
    };
    const Number of_probe =
        extent(magnitude(Bounds::dot(bx, by, bz, bounds.axis_x, bounds.axis_y, bounds.axis_z)),
               set(probe.thickness), probe_width, set(probe.radius));
    const Number of_lane =
        extent(magnitude(Bounds::dot(across_x, across_y, across_z, bounds.ux, bounds.uy, bounds.uz)),
               Lanes::load(node.thickness + first), lane_width, bounds.radius);
    gap_lane = magnitude(along_lane) - ((lane_width + of_probe) + set(granted));
    gap_probe = magnitude(along_probe) - ((probe_width + of_lane) + set(granted));
  }
};

/// Whose z, slab and cone a criterion uses.
enum class Of { PROBE, LANE };

/// All criteria that reject lanes (wide_node_test.h), one text for two visitors. The traversal asks
/// whether some criterion rejects (Passing in wide_traversal.cpp), tests that are kept ask for how
/// long one does (Lasting in keep/wide_lifetime.cpp). A visitor gets the lengths or cosines that
/// are compared:
///
/// | call | rejects where |
/// |---|---|
/// | apart(squared_distance, radii, limit) | abs D - radii > limit |
/// | above(z, slab, limit, of) | z - slab > limit |
/// | outside(z, slab, limit, of) | abs z - slab > limit |
/// | behind(z, slab, of) | z + slab < 0 |
/// | beside(Beside, of) | abs (D across u) cos phi > side |
/// | across(gap, limit, along, of) | gap > limit |
/// | turned(cosines) | cosines > 0: cos(phi + phi') + u . u' |
template <class Lanes>
struct NodeCriteria {
  using Number = typename Lanes::Number;

  /// The cone of one child, from the side.
  struct Beside {
    Number squared_distance;   ///< |D|^2
    Number squared_lateral;    ///< |D across u|^2, rounded down; may be negative.
    Number z, reached, limit;  ///< z, z + slab, reach cos(phi)
    Number cosine, sine;       ///< Of phi.
    Number side;               ///< (r + r') cos(phi) + sin(phi) min(reached, limit)
  };

  const LaneBounds<Lanes>& bounds;
  Number reach, touch_limit;

  HWY_INLINE NodeCriteria(const LaneBounds<Lanes>& of_lanes, const WideLimits& limits)
      : bounds(of_lanes), reach(Lanes::set(limits.reach)), touch_limit(Lanes::set(limits.touch)) {}

  /// G1: no LMD within the reach.
  template <class Visitor>
  HWY_INLINE void near(Visitor& lmd) const {
    lmd.apart(bounds.squared_distance, bounds.radii, reach);
    lmd.above(bounds.z_probe, bounds.slab_probe, reach, Of::PROBE);
    lmd.above(bounds.z_lane, bounds.slab_lane, reach, Of::LANE);
  }
  /// No two points within the touch distance.
  template <class Visitor>
  HWY_INLINE void near_touch(Visitor& touch) const {
    touch.apart(bounds.squared_distance, bounds.radii, touch_limit);
    touch.outside(bounds.z_probe, bounds.slab_probe, touch_limit, Of::PROBE);
    touch.outside(bounds.z_lane, bounds.slab_lane, touch_limit, Of::LANE);
  }
  /// G2: no two normals opposite.
  template <class Visitor>
  HWY_INLINE void collinear(Visitor& normals) const {
    normals.turned(((bounds.cosine * bounds.probe_cosine - bounds.sine * bounds.probe_sine) -
                    Lanes::set(DIRECTION_ROUNDING)) +
                   bounds.between);
  }
  /// G3: no direction of an LMD in both cones.
  template <class Visitor>
  HWY_INLINE void directed(Visitor& lmd) const {
    lmd.beside(beside(bounds.z_probe, bounds.slab_probe, bounds.probe_cosine, bounds.probe_sine), Of::PROBE);
    lmd.beside(beside(bounds.z_lane, bounds.slab_lane, bounds.cosine, bounds.sine), Of::LANE);
    lmd.behind(bounds.z_probe, bounds.slab_probe, Of::PROBE);
    lmd.behind(bounds.z_lane, bounds.slab_lane, Of::LANE);
  }
  /// Where features are long: apart square to them.
  template <class Visitor, class OfTouch>
  HWY_INLINE void apart_across(const LaneWidths<Lanes>& widths, Visitor& lmd, OfTouch& touch) const {
    lmd.across(widths.gap_probe, bounds.probe_sine * reach, widths.along_probe, Of::PROBE);
    lmd.across(widths.gap_lane, bounds.sine * reach, widths.along_lane, Of::LANE);
    touch.across(widths.gap_probe, touch_limit, widths.along_probe, Of::PROBE);
    touch.across(widths.gap_lane, touch_limit, widths.along_lane, Of::LANE);
  }

 private:
  HWY_INLINE Beside beside(Number z, Number slab, Number cosine, Number sine) const {
    const Number reached = z + slab, limit = reach * cosine;
    return {bounds.squared_distance,
            bounds.squared_distance * Lanes::set(1.0F - DIRECTION_ROUNDING) - z * z,
            z,
            reached,
            limit,
            cosine,
            sine,
            bounds.radii * cosine + sine * least_of(reached, limit)};
  }
};

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
