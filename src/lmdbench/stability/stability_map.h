// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/experiment/experiment.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Closed loops over stiffness and age of the LMD set, several times with other tremor of the hand: raw runs for the maps of
/// `lmdbench-study stability`.
///
/// In every run the device starts at rest at the path's first pose; the hand means to follow the path, moved against the contact's
/// force there until its spring would press with LOAD_N (smoothly over PRESS_S), and trembles: in each axis a sine of 8 to 12 Hz, the
/// range of physiological tremor, whose frequency and phase the seed draws and whose amplitude is TREMOR_CUTOFF of the cutoff. What is
/// measured is measured after SETTLED_S. F_max gives the stiffness: K_eff of the exact set at the first pose, under the profile's aggregation, is the one asked
/// for, and all methods get the same F_max.
namespace lmdbench {

inline constexpr double LOAD_N = 1.0;
inline constexpr double PRESS_S = 0.2;
inline constexpr double SETTLED_S = 0.5;
inline constexpr double TREMOR_CUTOFF = 0.02;
inline constexpr double JUMP_LOAD =
    0.25;  ///< A change of force in a frame above this share of the load is a jump.
inline constexpr double SHAKING_LOAD =
    0.1;  ///< A force above 30 Hz of more than this share of the load (RMS) is shaking.

struct StabilityMapGrid {
  std::vector<double> stiffness_n_per_m;
  /// A search starts every so many frames and its set arrives as many later; 0: in every frame, at once. Methods that search in
  /// every frame run at 0 only.
  std::vector<std::int64_t> ages_frames;
  std::int64_t seeds = 30;
  std::int64_t frames = 900;
};

/// One closed loop.
struct StabilityMapRun {
  std::string method;
  std::string profile;
  std::int64_t age_frames = 0;
  double stiffness_n_per_m = UNSET;
  std::int64_t seed = 0;
  // After SETTLED_S:
  double amplitude_m = UNSET;   ///< Root mean square of the device's way from its mean place.
  double frequency_hz = UNSET;  ///< Of its swing; 0 where there is none.
  double force_mean_n = UNSET;  ///< Length of the rendered force.
  double force_above_30_hz_n = UNSET;
  double effective_stiffness_p99_n_per_m = UNSET;
  double clearance_m = UNSET;        ///< Smallest true distance; 0 where the meshes touch.
  double penetration_share = UNSET;  ///< Of the frames: those in which the meshes touch.
  double power_created_w =
      UNSET;  ///< Net work of the rendered force a second: above 0 the contact feeds the motion.
  std::int64_t jumps = 0;
  std::int64_t dropouts = 0;  ///< Frames in which the force has fallen to zero.
  // Of the whole run:
  double energy_created_j =
      UNSET;  ///< Passivity observer: largest net work of the rendered force since the start.
  double balance_error = UNSET;  ///< Of the energies (simulated_device.h).

  bool shaking() const { return dropouts > 0 || force_above_30_hz_n > SHAKING_LOAD * LOAD_N; }
  bool through() const { return penetration_share > 0.0; }
  bool clean() const { return !shaking() && !through(); }
};

/// @param wanted is asked before every run, of which method to seed are set; unset: all of them are
/// @param sink is given every run as it ends; false stops
/// @throws UsageError for an experiment whose loop is open or has no hand with a spring, or without contact at its first pose
void map_stability(const Experiment& experiment, const StabilityMapGrid& grid,
                   const std::function<bool(const StabilityMapRun&)>& sink,
                   const std::function<bool(const StabilityMapRun&)>& wanted = nullptr);

/// A JSON object on one line.
std::string stability_map_json(const std::string& scene, const StabilityMapRun& run);

}  // namespace lmdbench
