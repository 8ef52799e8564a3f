// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/metrics/cleanliness.h>

/// One trial of a stiffness: the device rests in contact and is tapped.
///  1. The device is held at its place of rest until the method has an LMD set there and its force
///     has passed the delay. With a push this is where the contact's force along it balances it,
///     found by moving the path's first pose along the push; otherwise it is that pose.
///  2. It is released under just the balancing force (the push, and across it what the hand would
///     give), and tapped along the contact force: its speed changes so that it would swing by
///     TAP_SHARE of its free distance to either side. The watched and tapped point is the device's;
///     of one that turns as well, the point nearest to it on the contact force's line.
///  3. The trial ends after SKIPPED_CYCLES + 2 WINDOW_CYCLES oscillations, when the swing has died
///     down or left the contact's range, or after MOST_SWING_FRAMES.
/// Method, force law, device clipping and search period are those of a run. The contact's stiffness
/// is the force's slope along itself, by central difference: contacts that turn while the mesh
/// moves are less stiff than K_eff, which holds their directions. K_eff is taken where the method's
/// set changes just there. Of a force of the method's own the range is force over stiffness.
///
/// With Coulomb friction the loop is not linear, and a tap's result depends on its size: friction f
/// takes 4 f a from a swing of amplitude a in each oscillation, while the sampled contact gives
/// energy as a^2. A small tap may die down at a stiffness at which a large one grows. Hence:
///  - The tap is the largest that the contact bears, FRICTION_TAP_SHARE of the free distance. As it
///    dies down it passes all smaller ones. Within STICTION_BANDS of f / K, where friction holds
///    the device, a tap shows nothing (\ref StabilityTrial::stuck) and is not simulated.
///  - A swing that neither dies down nor grows over SUSTAINED_GROWTH a window is a limit cycle, not
///    clean (unless within encoder counts). One that decays gets up to MOST_ROUNDS times as long.
///
/// Encoders do not see a swing within one count: no force changes. Without friction the tap is at
/// least TAP_COUNTS counts, up to FRICTION_TAP_SHARE of the free distance. If that is below
/// LEAST_COUNTS, with or without friction, no simulation (\ref StabilityTrial::within_counts).
namespace lmdbench {

inline constexpr double TAP_COUNTS = 4.0;
inline constexpr double LEAST_COUNTS = 2.0;
inline constexpr double TAP_SHARE = 0.01;
inline constexpr double FRICTION_TAP_SHARE = 0.25;
/// A tap of sqrt(3) bands is the smallest that comes back. Weak devices have no room for more:
/// their resting force is then STICTION_BANDS / FRICTION_TAP_SHARE times the friction.
inline constexpr double STICTION_BANDS = 2.0;
inline constexpr double SUSTAINED_GROWTH = 0.01;
inline constexpr int MOST_ROUNDS = 8;  ///< A power of 2.
inline constexpr std::int64_t MOST_FRICTION_FRAMES = 200'000;
/// Of the tap's swing: a swing below this over a cycle has died down.
inline constexpr double DEAD_SHARE = 1e-6;
inline constexpr double ESCAPED_SHARE = 0.5;  ///< Of the contact's range: more has escaped.
inline constexpr std::int64_t MOST_SWING_FRAMES = 1'000'000;

struct StabilityTrial {
  double stiffness_n_per_m = UNSET;  ///< Slope of the resting contact's force along itself.
  /// Has force and stiffness at rest, or some force against a push that it does not carry; else
  /// unset below.
  bool in_contact = false;
  bool carried = true;   ///< Carries the push unsaturated; else unset below.
  bool clipped = false;  ///< The device clips the resting force, cannot render it.
  /// Not in contact because it rests nearer than the saturation distance, or touches.
  bool saturated = false;
  /// Not in contact because its force does not fall along itself: contacts of corners and edges
  /// turn away as the mesh moves.
  bool gives_way = false;
  /// Friction holds the device against any tap that the contact bears; nothing was simulated.
  bool stuck = false;
  /// The contact bears no tap that the encoders see; nothing was simulated.
  bool within_counts = false;
  bool limit_cycle = false;             ///< It goes on swinging; `outcome.growth` is then > 0.
  double tap_m = UNSET;                 ///< Swing of the tap on the contact's stiffness alone.
  Vec3 force_at_rest_W = Vec3::Zero();  ///< [N], before the device clips it.
  /// From the device's point to the line of that force, for a device that turns as well.
  double lever_m = 0.0;
  Cleanliness outcome;
  std::int64_t frames = 0;  ///< From the tap on.
};

/// Whether a device of this loop has Coulomb friction in any axis.
bool has_friction(const LoopChoice& loop);

/// @param method one method with the force profile to try
/// @throws Interrupted when `progress`, called now and then with frames since the tap, stops it
StabilityTrial try_stiffness(const Experiment& experiment, const DriverInput& input,
                             const DrivenMethod& method, const Progress& progress);

}  // namespace lmdbench
