// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Vector helpers of the wide hierarchy, compiled once for every instruction set: included after
// foreach_target.h, with an include guard that Highway toggles.
#if defined(LMDBENCH_SNCH_WIDE_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_SNCH_WIDE_VECTORS_INL_H
#undef LMDBENCH_SNCH_WIDE_VECTORS_INL_H
#else
#define LMDBENCH_SNCH_WIDE_VECTORS_INL_H
#endif

#include <lmdbench/methods/certified/hierarchy/wide_node_test.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes per vector: eight, or four twice where vectors are 128 bits wide.
using Lanes = hn::CappedTag<float, WIDE_WIDTH>;

template <class Mask>
HWY_INLINE std::uint32_t mask_bits(Lanes lanes, Mask mask, std::uint32_t first) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(lanes, mask, bytes);
  const std::uint32_t all = hn::Lanes(lanes) >= 8 ? 0xFFu : (1u << hn::Lanes(lanes)) - 1u;
  return (bytes[0] & all) << first;
}

/// Brings a node near that will be tested soon: a mesh that does not fit into a processor's
/// cache is slow to descend otherwise.
HWY_INLINE void fetch(const WideNode& node) {
  constexpr std::size_t CACHE_LINE = 64;
  const auto* const bytes = reinterpret_cast<const char*>(&node);
  for (std::size_t i = 0; i < sizeof(WideNode); i += CACHE_LINE) __builtin_prefetch(bytes + i);
}

/// What the children of a node are, as bit masks.
struct KindBits {
  std::uint32_t features = 0;
  std::uint32_t faces = 0;
};

HWY_INLINE KindBits kind_bits(const WideNode& node) {
  const Lanes f;
  const hn::RebindToUnsigned<Lanes> u;
  KindBits bits;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += static_cast<std::uint32_t>(hn::Lanes(u))) {
    const auto child = hn::Load(u, node.child + first);
    bits.features |= mask_bits(f, hn::RebindMask(f, hn::Gt(child, hn::Set(u, WideRef::INDEX_MASK))), first);
    bits.faces |= mask_bits(f, hn::RebindMask(f, hn::Gt(child, hn::Set(u, WideRef::FIRST_FACE - 1u))), first);
  }
  return bits;
}

/// make_probe with vectors, the same operations in the same order.
HWY_INLINE WideProbe make_probe_vector(const WideChild& child, const WideTransform& X) {
  const hn::CappedTag<float, 4> f;
  WideProbe probe;
  for (std::size_t row = 0; row < 4; row += hn::Lanes(f)) {
    const auto column0 = hn::Load(f, X.columns[0] + row);
    const auto column1 = hn::Load(f, X.columns[1] + row);
    const auto column2 = hn::Load(f, X.columns[2] + row);
    const auto centre = hn::Add(hn::Add(hn::Add(hn::Mul(column0, hn::Set(f, child.centre[0])),
                                                hn::Mul(column1, hn::Set(f, child.centre[1]))),
                                        hn::Mul(column2, hn::Set(f, child.centre[2]))),
                                hn::Load(f, X.translation + row));
    const auto axis = hn::Add(
        hn::Add(hn::Mul(column0, hn::Set(f, child.axis[0])), hn::Mul(column1, hn::Set(f, child.axis[1]))),
        hn::Mul(column2, hn::Set(f, child.axis[2])));
    hn::Store(centre, f, probe.centre + row);
    hn::Store(axis, f, probe.axis + row);
  }
  probe.radius = child.radius;
  probe.thickness = child.thickness;
  probe.cosine = child.cosine;
  probe.sine = child.sine;
  return probe;
}

/// Some lanes of a node beside a probe: the quantities of wide_node_test.h that every form of the test needs.
/// The same operations in the same order as LaneBounds.
struct VectorBounds {
  using Floats = hn::Vec<Lanes>;

  Floats cx, cy, cz;              ///< Lanes' centres.
  Floats dx, dy, dz;              ///< D
  Floats ux, uy, uz;              ///< Lanes' axes.
  Floats axis_x, axis_y, axis_z;  ///< Probe's axis.
  Floats radius, cosine, sine;    ///< Lanes'.
  Floats probe_cosine, probe_sine;
  Floats squared_distance, z_probe, z_lane, between, across, radii, slab_probe, slab_lane;

  HWY_INLINE VectorBounds(const WideNode& node, std::uint32_t first, const WideProbe& probe, float granted) {
    const Lanes f;
    const auto rounding = hn::Set(f, granted);
    cx = hn::Load(f, node.centre[0] + first);
    cy = hn::Load(f, node.centre[1] + first);
    cz = hn::Load(f, node.centre[2] + first);
    dx = hn::Sub(cx, hn::Set(f, probe.centre[0]));
    dy = hn::Sub(cy, hn::Set(f, probe.centre[1]));
    dz = hn::Sub(cz, hn::Set(f, probe.centre[2]));
    ux = hn::Load(f, node.axis[0] + first);
    uy = hn::Load(f, node.axis[1] + first);
    uz = hn::Load(f, node.axis[2] + first);
    axis_x = hn::Set(f, probe.axis[0]);
    axis_y = hn::Set(f, probe.axis[1]);
    axis_z = hn::Set(f, probe.axis[2]);
    radius = hn::Load(f, node.radius + first);
    cosine = hn::Load(f, node.cosine + first);
    sine = hn::Load(f, node.sine + first);
    probe_cosine = hn::Set(f, probe.cosine);
    probe_sine = hn::Set(f, probe.sine);
    squared_distance = dot(dx, dy, dz, dx, dy, dz);
    z_probe = dot(dx, dy, dz, axis_x, axis_y, axis_z);
    z_lane = hn::Neg(dot(dx, dy, dz, ux, uy, uz));
    between = dot(ux, uy, uz, axis_x, axis_y, axis_z);
    across = hn::Sqrt(hn::Add(hn::Max(hn::Sub(hn::Set(f, 1.0F), hn::Mul(between, between)), hn::Zero(f)),
                              hn::Set(f, DIRECTION_ROUNDING)));
    const auto along = hn::Abs(between);
    const auto thickness = hn::Load(f, node.thickness + first);
    const auto probe_radius = hn::Set(f, probe.radius), probe_thickness = hn::Set(f, probe.thickness);
    radii = hn::Add(hn::Add(radius, probe_radius), rounding);
    slab_probe = hn::Add(hn::Add(probe_thickness, rounding),
                         hn::Add(hn::Mul(thickness, along), hn::Mul(radius, across)));
    slab_lane = hn::Add(hn::Add(thickness, rounding),
                        hn::Add(hn::Mul(probe_thickness, along), hn::Mul(probe_radius, across)));
  }

  static HWY_INLINE Floats dot(Floats ax, Floats ay, Floats az, Floats bx, Floats by, Floats bz) {
    return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
  }
};

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
