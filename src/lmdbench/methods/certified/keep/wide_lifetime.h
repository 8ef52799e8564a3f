// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/keep/motion_forecast.h>
#include <lmdbench/methods/certified/keep/steady_array.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// The node test with lifetimes: for how many frames of the forecast motion the rejections of a test stand.
///
/// A test rejects a lane by some inequality (proof: PROOF.md, lemmas 13, 14, 15 and 16).
/// The bounds behind it (wide_node_test.h) speak of every p below
/// the one child and every q below the other, with d = q - p:
///   |d| > search_distance,   u . d > search_distance,   u . d < 0,   |d . b| > sin(phi) search_distance,   d outside the cone round u;
///   angle(u, -u') > phi + phi'.
/// Let c be the centre of the child that moves, and Delta its displacement. Suppose that after the motion p
/// and q are within the search_distance. With theta the angle that the mesh has turned by, p has moved by Delta and at
/// most theta |p - c| more; q, seen from the moving mesh, by -Delta and at most theta (|p - c| + search_distance)
/// more; and a change of frame turns d by at most theta, which is theta * search_distance more. So d differs from what
/// it was less Delta by at most theta * lever_arm, in the frame of either mesh, with lever_arm = r + 2 search_distance for the
/// radius r of the moving child.
///
/// The left sides above bound all those d together by a function F(D) of the difference D of the children's
/// centres, the axes being at rest in the frame of their own mesh. Every F is convex (a length, a linear
/// function, the distance from an axis, or their maximum), and it changes by no more than its d do. So after
/// the motion the inequality holds still while
///
///   F(D) - grad F . Delta - theta * lever_arm > 0
///
/// whatever the size of Delta; and the one of angles while theta is below its slack. Delta and
/// theta grow by the forecast (motion_forecast.h) and by what the motion deviates from it: a plan is a number of frames, and the
/// deviation that it stands is what they leave of the slack.
namespace lmdbench {

/// The forecast as one query needs it, in single precision.
struct WideForecast {
  /// Velocity of the moving mesh's point c: turn * c + velocity, in the frame of the fixed mesh and in that
  /// of the moving one. Metres a frame.
  WideTransform in_fixed, in_moving;
  float creep = 0.0F;  ///< Added to the velocity of any point, for what is not in `turn`; metres a frame.
  float spin = 0.0F;   ///< Radians a frame.
  float search_distance = 0.0F;  ///< Of the lever arms [m].
  /// Plans of tau frames shall stand a deviation of base + drift * tau, and a share of the slack.
  float base = 0.0F;     ///< metres
  float drift = 0.0F;    ///< metres a frame
  float extent = 0.0F;   ///< A turn by an angle counts as that deviation times this [m].
  float horizon = 0.0F;  ///< Lanes that would be rejected for no longer than this survive [frames].

  WideForecast() = default;
  /// @param X_FM   the moving mesh at this frame in the fixed mesh's frame; only its rotation matters
  /// @param search_distance distance of what is looked for [m]
  WideForecast(const MotionForecast& forecast, const RigidTransform& X_FM, double search_distance);
};

/// Share of a slack that a plan leaves for what deviates from the forecast, beside what lately did.
inline constexpr float DEVIATION_SHARE = 0.125F;
/// No plan is shorter than this share of the slack lasts, however much deviated lately: where a motion trembles that is more than
/// most slacks, and is not deviated by again in the next frames. What stands still is planned by deviations alone.
inline constexpr float LEAST_SHARE = 0.5F;
/// Frames for which a lane's best criterion is chosen.
inline constexpr float CHOICE_FRAMES = 16.0F;
/// Larger than any slack, and than what is lost: takes criteria that do not reject now out of the choice.
inline constexpr float NO_CHOICE = 1e30F;
/// (lateral - side) bounds how far d is outside the cone only up to this factor (PROOF.md, lemma 15).
inline constexpr float HALF_DIAGONAL = 0.7F;
/// Losses and lengths are at least this, so that nothing is divided by zero.
inline constexpr float LEAST_LENGTH = 1e-30F;

/// Lanes that survive, as bit masks, and for how long the others stay rejected.
struct WideLifetimes {
  std::uint32_t used = 0;   ///< Lanes in use.
  std::uint32_t lmd = 0;    ///< Survive as LMDs, or are rejected for no longer than the horizon.
  std::uint32_t touch = 0;  ///< Survive as touching, likewise.
  /// The others stay rejected for so many frames of the forecast (below 1: perhaps not for the next one) ...
  float frames = std::numeric_limits<float>::infinity();
  /// ... if the motion deviates from it by no more than this [m].
  float deviation_budget = std::numeric_limits<float>::infinity();
};

/// What a test needs to know beyond its node and probe.
struct WideLifetimeTest {
  bool moving_lanes;          ///< The lanes are the moving mesh's, the probe the fixed one's.
  float probe_velocity[3];    ///< Of a moving probe's centre, in the lanes' frame; metres a frame.
  std::uint32_t touch_lanes;  ///< Lanes for which touching matters.
  float probe_distance = 0;   ///< Of a moving probe's centre from its hierarchy's origin [m].
};

/// @param widths  null: NoWidths
WideLifetimes test_lanes_lifetime(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                  const WideForecast& forecast, const WideLifetimeTest& test,
                                  const WideWidthTest* widths = nullptr);

/// The same, lane by lane: the reference.
WideLifetimes test_lanes_lifetime_scalar(const WideNode& node, const WideProbe& probe,
                                         const WideLimits& limits, const WideForecast& forecast,
                                         const WideLifetimeTest& test, const WideWidthTest* widths = nullptr);

/// Two children and the test of the one against what is below the other. Kept, because the one child is
/// spread over its node.
struct alignas(64) WideKeptPair {
  WideChild child;               ///< The one that is not opened, in its own mesh's frame.
  std::uint32_t slot_a, slot_b;  ///< The children, node * 8 + lane.
  std::uint32_t node;            ///< Below the one that is opened.
  bool open_a;

  WideKeptPair(const WideHierarchy& a, const WideHierarchy& b, std::uint32_t slot_of_a,
               std::uint32_t slot_of_b);
};

/// Result of such a test. Lanes with final pairs are those where both children are features.
struct WideKeptTest {
  std::uint32_t pair;  ///< Index of the kept pair.
  std::uint32_t used, opened, lmd, touch;
  float frames, deviation_budget;
};

/// Makes the tests of the pairs that are due.
/// @param a the moving mesh's hierarchy
void test_batch(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                const WideForecast& forecast, const SteadyArray<WideKeptPair>& pairs,
                std::span<const std::uint32_t> due, std::vector<WideKeptTest>& tests);

}  // namespace lmdbench
