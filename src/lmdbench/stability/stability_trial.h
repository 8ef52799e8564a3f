// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/metrics/cleanliness.h>

/// One trial of a stiffness: the device rests in contact and is tapped.
///  1. It is held where it is to rest until the method has an LMD set there and its force has gone through the delay. With a
///     push that is where the contact's force along the push balances it, found by moving the path's first pose along the
///     push; without one it is that pose itself.
///  2. It is let go, pushed by just the force that balances the contact (the push, and across it what the hand would give), and
///     tapped along the contact force: its speed changes so that
///     it would swing by TAP_SHARE of the way that the contact leaves it on either side. Watched is the device's point, or, where it
///     turns as well, the point fixed to it that is nearest to the device's on the line of the contact force, and tapped there.
///  3. The trial ends after SKIPPED_CYCLES + 2 WINDOW_CYCLES oscillations, when the swing has died down, when it has left the
///     contact's range, or after MOST_SWING_FRAMES.
/// Method, force law, device clipping and search clock are those of a run.
///
/// With Coulomb friction the loop is not linear, and what a tap shows depends on its size: friction f takes 4 f a from a swing of
/// amplitude a in every oscillation, what the sampled contact gives grows with a^2, so that a small tap dies down at a stiffness at
/// which a large one grows. There:
///  - The tap is the largest that the contact bears, FRICTION_TAP_SHARE of the way. As it dies down it passes all smaller ones.
///  - Within STICTION_BANDS of the way f / K over which friction holds the device against the contact's stiffness, a tap says
///    nothing (\ref StabilityTrial::stuck), and nothing is simulated.
///  - A swing that neither dies down nor grows by more than SUSTAINED_GROWTH a window is a limit cycle, and not clean (unless it
///    stays within the encoders' counts). One that still decays is given up to MOST_ROUNDS times as many oscillations.
///
/// Encoders that count do not see a swing within one count: no force changes, and nothing is shown. Without friction the tap is
/// TAP_COUNTS counts where TAP_SHARE of the way is less, up to FRICTION_TAP_SHARE of it; where that is less than LEAST_COUNTS, with
/// friction or without, nothing is simulated (\ref StabilityTrial::within_counts).
namespace lmdbench {

inline constexpr double TAP_COUNTS = 4.0;
inline constexpr double LEAST_COUNTS = 2.0;
inline constexpr double TAP_SHARE = 0.01;
inline constexpr double FRICTION_TAP_SHARE = 0.25;
/// A tap of sqrt(3) bands is the smallest that comes back. More would leave no room on weak devices: at rest the force is
/// STICTION_BANDS / FRICTION_TAP_SHARE times the friction then, and that has to be below what they render.
inline constexpr double STICTION_BANDS = 2.0;
inline constexpr double SUSTAINED_GROWTH = 0.01;
inline constexpr int MOST_ROUNDS = 8;  ///< A power of 2.
inline constexpr std::int64_t MOST_FRICTION_FRAMES = 200'000;
inline constexpr double DEAD_SHARE =
    1e-6;  ///< Of the tap's swing: less than this over a cycle has died down.
inline constexpr double ESCAPED_SHARE = 0.5;  ///< Of the contact's range: more than this has escaped.
inline constexpr std::int64_t MOST_SWING_FRAMES = 1'000'000;

struct StabilityTrial {
  double stiffness_n_per_m = UNSET;  ///< K_eff of the resting contact.
  bool in_contact = false;  ///< There is a force and a stiffness at rest; without them nothing below is set.
  bool carried = true;      ///< The contact carries the push before it saturates; else nothing below is set.
  bool clipped = false;     ///< The device clips the force at rest: it cannot render this stiffness here.
  bool saturated =
      false;  ///< Not in contact because it rests nearer than the saturation distance, or touches.
  bool stuck =
      false;  ///< Friction holds the device against any tap that the contact bears; nothing was simulated.
  bool within_counts = false;  ///< The contact bears no tap that the encoders see; nothing was simulated.
  bool limit_cycle =
      false;  ///< It went on swinging; `outcome.growth` is positive then, whatever the measures say.
  double tap_m = UNSET;  ///< How far the tap swings the device on the contact's stiffness alone.
  Vec3 force_at_rest_W = Vec3::Zero();  ///< [N]
  double lever_m =
      0.0;  ///< From the device's point to the line of that force, where the device turns as well.
  Cleanliness outcome;
  std::int64_t frames = 0;  ///< From the tap on.
};

/// Whether a device of this loop has Coulomb friction in any axis.
bool has_friction(const LoopChoice& loop);

/// @param method one method with the force profile to try
/// @throws Interrupted when `progress`, called now and then with frames since the tap, returned false
StabilityTrial try_stiffness(const Experiment& experiment, const DriverInput& input,
                             const DrivenMethod& method, const Progress& progress);

}  // namespace lmdbench
