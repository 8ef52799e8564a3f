// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/experiment/experiment.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Closed loops over stiffness and age of the LMD set, repeated with different tremor of the hand:
/// raw runs for the maps of `lmdbench-study stability`.
///
/// The device starts at rest at the path's first pose. The hand's intent is the path, moved against
/// the contact's force there until its spring would press with LOAD_N (smoothly over PRESS_S). It
/// trembles: in each axis a sine of 8 to 12 Hz (physiological tremor) with frequency and phase from
/// the seed, amplitude TREMOR_CUTOFF of the cutoff. Measurements begin after SETTLED_S. All methods
/// get one F_max, which gives the exact set the stiffness K_eff at the first pose.
namespace lmdbench {

inline constexpr double LOAD_N = 1.0;
inline constexpr double PRESS_S = 0.2;
inline constexpr double SETTLED_S = 0.5;
inline constexpr double TREMOR_CUTOFF = 0.02;
inline constexpr double JUMP_LOAD = 0.25;    ///< Force change in a frame, over the load: a jump.
inline constexpr double SHAKING_LOAD = 0.1;  ///< Shaking: force above 30 Hz (RMS) over this share.

struct StabilityMapGrid {
  std::vector<double> stiffness_n_per_m;
  /// A search starts every so many frames, its set arrives as many later; 0: in every frame, at
  /// once. Methods that search in every frame run at 0 only.
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
  double amplitude_m = UNSET;   ///< RMS distance of the device from its mean place.
  double frequency_hz = UNSET;  ///< Of its swing; 0 without one.
  double force_mean_n = UNSET;  ///< Length of the rendered force.
  double force_above_30_hz_n = UNSET;
  double effective_stiffness_p99_n_per_m = UNSET;
  double clearance_m = UNSET;        ///< Least true distance; 0: touching.
  double penetration_share = UNSET;  ///< Share of frames with touching meshes.
  double power_created_w = UNSET;    ///< Net work of the contacts per second; > 0 feeds the motion.
  std::int64_t jumps = 0;
  std::int64_t dropouts = 0;     ///< Frames whose force fell to zero.
  double balance_error = UNSET;  ///< Of the energies of the whole run (simulated_device.h).

  bool shaking() const { return dropouts > 0 || force_above_30_hz_n > SHAKING_LOAD * LOAD_N; }
  bool through() const { return penetration_share > 0.0; }
  bool clean() const { return !shaking() && !through(); }
};

/// @param sink receives every finished run; false stops
/// @throws UsageError for an open loop, a hand without spring, or no contact at the first pose
void map_stability(const Experiment& experiment, const StabilityMapGrid& grid,
                   const std::function<bool(const StabilityMapRun&)>& sink);

/// A JSON object on one line.
std::string stability_map_json(const std::string& scene, const StabilityMapRun& run);

}  // namespace lmdbench
