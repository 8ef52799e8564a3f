// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/simulated_device.h>

#include <cstdint>

/// Energy of a sampled, held wall F = -K x (x < 0: within it) on a simulated device of one axis.
/// In a servo period the device goes from x to x + dx, the wall still pushing with -K x: its work
/// is K dx^2 / 2 more than its spring's loss. A damper takes at least b dx^2 / T. So K <= 2 b / T
/// gives no net energy whatever the hand does (Colgate's condition); above, K/2 dx^2 - b dx^2 / T
/// in every period of steady motion. Quantisation by d adds up to d/2 to x: a passive wall gives K
/// d / 2 times the path, Coulomb friction c takes c times it: c >= K d / 2 is enough (Diolaiti et
/// al. 2006).
namespace lmdbench {

struct SampledWall {
  double stiffness_n_per_m = 0.0;
  double period_s = 1e-3;
  double resolution_m = 0.0;
};

/// Force [N] along x that the wall commands for a sensed position.
inline double wall_force(const SampledWall& wall, double sensed_m) {
  return sensed_m < 0.0 ? -wall.stiffness_n_per_m * sensed_m : 0.0;
}

/// A device that is carried into the wall at constant speed and out again.
struct Excursion {
  double net_energy_j =
      0.0;  ///< Work of the wall less losses in damping and friction; above 0: it gave energy.
  std::int64_t periods = 0;  ///< In which the wall pushed.
};

/// Moves `way_m` a period, `depth` periods in from half of that within the wall, and out until the
/// wall stops pushing: 2 depth + 1 periods. The device is so heavy that nothing changes its speed.
Excursion carry_through(const SampledWall& wall, double damping_n_s_per_m, double friction_n, double way_m,
                        int depth);

/// Motion that remains of a tap on a wall while a steady force presses the device into it.
struct RestingSwing {
  double amplitude_m = 0.0;   ///< Half the extremes' distance, over the last half of the time.
  double frequency_hz = 0.0;  ///< Half the velocity's changes of sign a second there.
  double net_power_w = 0.0;   ///< Work of wall and push there a second: it sustains the swing.
};

/// @param dynamics of the device, a hand included
/// @param load_n   steady force into the wall
RestingSwing rest_on(const SampledWall& wall, const DeviceDynamics& dynamics, double load_n,
                     double tap_m_per_s, std::int64_t periods);

}  // namespace lmdbench
