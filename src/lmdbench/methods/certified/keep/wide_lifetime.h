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

/// The node test with lifetimes: for how many frames of the forecast motion its rejections stay
/// valid (PROOF.md, lemmas 13 to 17).
///
/// 1. A test rejects a lane by some inequality (wide_node_test.h) for all d = q - p at once, p
///    below one child and q below the other, as a pair that may be an LMD (or that may touch,
///    likewise):
///      |d| > reach,  u . d > reach,  u . d < 0,  |d . b| > sin(phi) reach,
///      d outside the cone round u,  angle(u, -u') > phi + phi'
///    that is F(D) > 0, with D the difference of the children's centres and axes at rest in the
///    frame of their own mesh. F is convex (a length, a linear function, the distance from an axis,
///    or their maximum) and changes by no more than its d.
/// 2. Let the centre c of the moving child, of radius r, move by Delta and its mesh turn by theta.
///    If p and q are within the search distance s afterwards, p has moved by Delta and at most
///    theta |p - c| more; q, seen from the moving mesh, by -Delta and at most theta (|p - c| + s)
///    more; a change of frame turns d by theta: theta s more. So d differs from what it was less
///    Delta by at most theta lever_arm, in either frame, with lever_arm = r + 2 s.
/// 3. So the rejection is valid, however large Delta is, while
///      F(D) - grad F . Delta - theta lever_arm > 0
///    and that of angles while theta is below its slack.
/// 4. Delta and theta grow by the forecast and by the deviation from it (motion_forecast.h). A plan
///    is a number of frames of the forecast; what these leave of the slack is its budget of
///    deviation.
namespace lmdbench {

/// The forecast of one query, in single precision.
struct WideForecast {
  /// Velocity of the moving mesh's point c: turn * c + velocity [m a frame], in either mesh's
  /// frame.
  WideTransform in_fixed, in_moving;
  float creep = 0.0F;            ///< Added to any velocity, for what is not in `turn` [m a frame].
  float spin = 0.0F;             ///< Radians a frame.
  float search_distance = 0.0F;  ///< Of the lever arms [m].
  /// Plans of tau frames leave room for a deviation of base + drift * tau and a share of the slack.
  float base = 0.0F;     ///< metres
  float drift = 0.0F;    ///< metres a frame
  float extent = 0.0F;   ///< A turn counts as a deviation of its angle times this [m].
  float horizon = 0.0F;  ///< Lanes that are rejected for no longer than this survive [frames].

  WideForecast() = default;
  /// @param X_FM  the moving mesh in the fixed mesh's frame; only its rotation matters
  /// @param search_distance  the larger of reach and touch [m]
  WideForecast(const MotionForecast& forecast, const RigidTransform& X_FM, double search_distance);
};

/// Share of a slack that a plan leaves for deviations, beside base and drift.
inline constexpr float DEVIATION_SHARE = 0.125F;
/// A plan uses at least this share of the slack, however much deviated lately: the tremble of a
/// motion exceeds most slacks, but does not recur in the next frames. At rest only deviations
/// count.
inline constexpr float LEAST_SHARE = 0.5F;
/// A lane's criterion is chosen by its slack after so many frames.
inline constexpr float CHOICE_FRAMES = 16.0F;
/// Larger than any slack or loss: excludes criteria that do not reject now from the choice.
inline constexpr float NO_CHOICE = 1e30F;
/// Factor up to which (lateral - side) bounds how far d is outside the cone (PROOF.md, lemma 15).
inline constexpr float HALF_DIAGONAL = 0.7F;
/// What rounding changes of the growth of |D across u|^2 / 2, over |D| and the speed (PROOF.md,
/// lemma 15).
inline constexpr float GROWTH_ROUNDING = 1.5e-6F;
/// Least loss or length that something is divided by.
inline constexpr float LEAST_LENGTH = 1e-30F;

/// Lanes that survive, as bit masks, and for how long the others stay rejected.
struct WideLifetimes {
  std::uint32_t used = 0;   ///< Lanes in use.
  std::uint32_t lmd = 0;    ///< Survive as LMDs, or are rejected for no longer than the horizon.
  std::uint32_t touch = 0;  ///< Survive as touching, likewise.
  /// The others stay rejected for so many frames of the forecast ...
  float frames = std::numeric_limits<float>::infinity();
  /// ... if the motion deviates from it by no more than this [m].
  float deviation_budget = std::numeric_limits<float>::infinity();
};

/// Input of a test beyond its node and probe.
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

/// A kept pair of children, one of which is opened. The other is read from its node when it is
/// tested: copies would be most of what is kept.
struct WideKeptPair {
  std::uint32_t slot_a, slot_b;  ///< The children, node * 8 + lane.
  std::uint32_t node;            ///< Of the child that is opened.
  bool open_a;

  std::uint32_t other_slot() const { return open_a ? slot_b : slot_a; }  ///< That is not opened.

  WideKeptPair() = default;
  WideKeptPair(const WideHierarchy& a, const WideHierarchy& b, std::uint32_t slot_of_a,
               std::uint32_t slot_of_b);
};

/// Its test. In `opened` lanes the pair goes on; in `lmd` and `touch` both children are features.
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
