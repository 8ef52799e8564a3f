// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/wide_traversal.h>

#include <cstdint>
#include <limits>
#include <vector>

/// The node test with slacks: how much motion the rejections of a test stand.
///
/// A test rejects a lane by some inequality. The bounds behind it (wide_node_test.h) speak of every p below
/// the one child and every q below the other, with d = q - p:
///   |d| > cutoff,   u . d > cutoff,   u . d < 0,   d outside the cone round u;   angle(u, -u') > phi + phi'.
/// Take a motion of the moving mesh: c, a point that moves with it, shifts by |dc|, and the mesh turns by
/// theta. Call |dc| + lever * theta its size, with a lever of at least |p - c| + 2 cutoff for every p below
/// the moving child. Suppose that after the motion p and q are within the cutoff. p has moved by at most |dc|
/// + theta |p - c|; q, seen from the moving mesh, by at most |dc| + theta (|p - c| + cutoff); and a change of
/// frame turns d by at most theta, which is theta * cutoff more. So d differs from what it was by less than
/// the size, in the frame of either mesh, and the angle between u and u' by at most theta. An inequality that
/// held with the slack s in its length therefore holds while the size is below s, one that held with the
/// angle s while theta is.
///
/// Sizes and angles of successive motions add up (triangle inequality), so sums over frames, clocks, tell
/// when a test expires.
namespace lmdbench {

/// How fast things move, to weigh lengths against angles; any values are safe.
struct WidePaces {
  float frames_per_metre = 1.0F;
  float frames_per_radian = 1.0F;
  float horizon = 0.0F;  ///< Frames. Lanes that would be rejected for no longer than this survive.
};

struct WideSlackMasks {
  std::uint32_t used = 0;   ///< Lanes in use.
  std::uint32_t lmd = 0;    ///< Survive as LMDs.
  std::uint32_t touch = 0;  ///< Survive as touching.
  /// Least slacks of what did not survive: all of it stays rejected while neither is used up. Metres and
  /// radians.
  float length_slack = std::numeric_limits<float>::infinity();
  float angle_slack = std::numeric_limits<float>::infinity();
};

/// @param touch_lanes lanes for which touching matters
WideSlackMasks test_lanes_slack(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                const WidePaces& paces, std::uint32_t touch_lanes);

/// The same, lane by lane: the reference.
WideSlackMasks test_lanes_slack_scalar(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                       const WidePaces& paces, std::uint32_t touch_lanes);

/// A test to be made, and its result. Lanes with final pairs are those where both children are features.
struct WideKeptTest {
  std::uint32_t record;          ///< The caller's.
  std::uint32_t slot_a, slot_b;  ///< The children, node * 8 + lane.
  WidePaces paces;
  WideOpening opening{};
  std::uint32_t used = 0, opened = 0, lmd = 0, touch = 0;
  float length_slack = 0.0F, angle_slack = 0.0F;
};

void test_batch(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                std::vector<WideKeptTest>& tests);

}  // namespace lmdbench
