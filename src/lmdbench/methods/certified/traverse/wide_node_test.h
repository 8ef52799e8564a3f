// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <cstdint>

/// The test of one child ("probe") against the eight children ("lanes") of a node of the other
/// mesh. A lane survives where both may hold an LMD within the reach (lmd), or two points within
/// the touch distance (touch: so near no direction is reliable, so no cone may reject).
///
/// Let c, r, h, u, phi be centre, radius, thickness, axis and half angle of a child, D = c_lane -
/// c_probe, z = u . D for the probe's u and -u . D for the lane's.
///
/// 1. Bounds. A vector d between points below both children is D and offsets in both bodies, so
///
///      |d| >= |D| - (r + r')
///      |u . d - z| <= h + h' |u . u'| + r' sqrt(1 - (u . u')^2) =: slab
///      |d across u| >= |D across u| - (r + r')
///
/// 2. An LMD has |d| <= reach, u . d >= cos(phi) |d| >= 0, and |d across u| is at most tan(phi) u .
///    d and at most sin(phi) |d|. With 1, for the probe's u and again for the lane's (G1 to G3 of
///    the paper, section 3.2.1):
///
///      G1  |D| <= reach + r + r'   and   z <= reach + slab
///      G2  -u . u' >= cos(phi + phi')
///      G3  z >= -slab   and
///          |D across u| cos(phi) <= (r + r') cos(phi) + sin(phi) min(z + slab, reach cos(phi))
///
/// 3. What touches has |D| <= touch + r + r' and |z| <= touch + slab, for both u.
/// 4. Where features are long (WideWidths): b is the unit vector across a child, square to u, w its
///    half width. An LMD has |d . b| <= sin(phi) reach =: limit; for what touches limit is touch.
///    For both b
///
///      |D . b| <= limit + w + h' |b . u'| + w' |b . b'| + r' sqrt(1 - (b . u')^2 - (b . b')^2)
///
/// Deviations from the paper: the slab; G3 rejects as decision E2 says, without the paper's sigma =
/// arcsin((r + r') / |D|): it holds for spheres that overlap too (E3), is tighter there and needs
/// no division (methods/DECISIONS.md).
///
/// Single precision loses no LMD (PROOF.md, lemmas 7 and 8): children are rounded outwards when
/// built. Moving one into the other's frame and the sums lose less than POSITION_ROUNDING of the
/// largest length in play (both radii and the distance of the origins), which is added to r + r'
/// and to the slabs. Products of directions lose less than DIRECTION_ROUNDING, which is granted in
/// G2, in the slab and, times |D|^2, in |D across u|^2 = |D|^2 - z^2, which cancels. No operation
/// is fused: every instruction set gives the same bits and counters.
namespace lmdbench {

/// Granted relative rounding of lengths (PROOF.md, lemma 8): 32 roundings of single precision.
inline constexpr double POSITION_ROUNDING = 2e-6;
/// Granted rounding of products of two directions.
inline constexpr float DIRECTION_ROUNDING = 2e-6F;

/// One child in the frame of the test.
struct alignas(16) WideProbe {
  float centre[4];
  float axis[4];
  float radius;
  float thickness;
  float cosine;
  float sine;
};

/// Widths in a test: the lanes' and, moved like its axis, the probe's.
struct WideWidthTest {
  const WideWidths& lanes;
  float across[3];
  float half_width;
};

/// Where neither mesh has long features.
struct NoWidths {};

/// Where a test reads centres, axes and directions across: in the node, or moved to the other's
/// frame.
struct WidePlaces {
  using Rows = const float (*)[WIDE_WIDTH];
  Rows centre, axis;
  Rows across = nullptr;  ///< With WideWidthTest alone.

  WidePlaces(const WideNode& node, const NoWidths&) : centre(node.centre), axis(node.axis) {}
  WidePlaces(const WideNode& node, const WideWidthTest& widths)
      : centre(node.centre), axis(node.axis), across(widths.lanes.across) {}
  WidePlaces(Rows of_centres, Rows of_axes, Rows of_across)
      : centre(of_centres), axis(of_axes), across(of_across) {}
};

/// Lengths of a query, rounded outwards; the reach is the cutoff and what tolerances add to it.
struct WideLimits {
  float reach;
  float touch;
  float rounding;  ///< Granted to every sum of lengths.
};

/// Lanes that survive and why others do not, as bit masks. A lane in use is in `lmd` | `touch`, in
/// `beyond`, in `not_collinear`, or in none of these: then G3 or a width rejects it.
struct WideMasks {
  std::uint32_t lmd = 0;            ///< May hold an LMD.
  std::uint32_t touch = 0;          ///< May touch.
  std::uint32_t used = 0;           ///< Lanes in use.
  std::uint32_t beyond = 0;         ///< Rejected by G1.
  std::uint32_t not_collinear = 0;  ///< Rejected by G2.
};

/// Coordinates of one hierarchy's frame in the other's, in single precision; a fourth row pads.
struct alignas(16) WideTransform {
  float columns[3][4] = {};
  float translation[4] = {};

  WideTransform() = default;
  WideTransform(const Mat3& R, const Vec3& t) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) columns[j][i] = static_cast<float>(R(i, j));
      translation[i] = static_cast<float>(t[i]);
    }
  }
};

/// A lane of a node, in its own mesh's frame.
struct WideChild {
  float centre[3], radius, axis[3], thickness, cosine, sine;
  WideRef ref;

  WideChild() = default;
  WideChild(const WideNode& node, std::uint32_t lane)
      : centre{node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]},
        radius(node.radius[lane]),
        axis{node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]},
        thickness(node.thickness[lane]),
        cosine(node.cosine[lane]),
        sine(node.sine[lane]),
        ref(WideRef::from_bits(node.child[lane])) {}
};

/// The child as probe, moved by `X`.
inline WideProbe make_probe(const WideChild& child, const WideTransform& X) {
  using Row = Eigen::Array4f;
  const auto row = [](const float* x) { return Eigen::Map<const Row, Eigen::Aligned16>(x); };
  WideProbe probe;
  Eigen::Map<Row, Eigen::Aligned16>(probe.centre) = row(X.columns[0]) * child.centre[0] +
                                                    row(X.columns[1]) * child.centre[1] +
                                                    row(X.columns[2]) * child.centre[2] + row(X.translation);
  Eigen::Map<Row, Eigen::Aligned16>(probe.axis) = row(X.columns[0]) * child.axis[0] +
                                                  row(X.columns[1]) * child.axis[1] +
                                                  row(X.columns[2]) * child.axis[2];
  probe.radius = child.radius;
  probe.thickness = child.thickness;
  probe.cosine = child.cosine;
  probe.sine = child.sine;
  return probe;
}

/// @param of_probe  widths of the probe's node
/// @param X  as of the probe
inline WideWidthTest make_width_test(const WideWidths& lanes, const WideWidths& of_probe, std::uint32_t lane,
                                     const WideTransform& X) {
  WideWidthTest test{lanes, {}, of_probe.half_width[lane]};
  for (int k = 0; k < 3; ++k)
    test.across[k] = X.columns[0][k] * of_probe.across[0][lane] + X.columns[1][k] * of_probe.across[1][lane] +
                     X.columns[2][k] * of_probe.across[2][lane];
  return test;
}

/// Of a node; without long features widths that reject nothing.
inline const WideWidths& widths_of(const WideHierarchy& hierarchy, std::size_t node) {
  static constexpr WideWidths NONE{};
  return hierarchy.widths.empty() ? NONE : hierarchy.widths[node];
}

/// Node `node` of `opened` against the probe in `slot` of `other`.
inline WideWidthTest make_width_test(const WideHierarchy& opened, std::size_t node,
                                     const WideHierarchy& other, std::uint32_t slot, const WideTransform& X) {
  return make_width_test(widths_of(opened, node), widths_of(other, slot / WIDE_WIDTH), slot % WIDE_WIDTH, X);
}

/// The test, lane by lane: the reference that the vector form must match bit for bit.
/// @param widths  null: NoWidths
/// @param places  null: the node's own
WideMasks test_lanes_scalar(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                            const WideWidthTest* widths = nullptr, const WidePlaces* places = nullptr);

}  // namespace lmdbench
