// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/simulated_device.h>

#include <cstdint>

/// What a sampled, held wall F = -K x (x < 0: within it) does to energy, on a simulated device of one axis.
///
/// Theory. In a servo period the device goes from x to x + dx while the wall still pushes with -K x: the wall's work is K dx^2 / 2
/// more than what its spring loses. A damper takes at least b dx^2 / T of it. So whatever the hand does, the wall gives no net energy
/// where K <= 2 b / T (Colgate's condition), and above that (K/2 - b/T) dx^2 in every period of steady motion: K/2 dx^2 - b dx^2 / T.
/// Quantisation by d adds up to d/2 to x, so a wall that is passive otherwise still gives K d / 2 times the way moved; Coulomb friction c
/// takes c times the way: c >= K d / 2 is enough (Diolaiti et al. 2006).
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
      0.0;  ///< Work of the wall less what damping and friction took: above 0 the wall gave energy.
  std::int64_t periods = 0;  ///< In which the wall pushed.
};

/// Speed `way_m` a period, `depth` periods in from half a period's way within the wall, and out again until the wall no longer
/// pushes: 2 depth + 1 periods. The device is so heavy that nothing changes its speed.
Excursion carry_through(const SampledWall& wall, double damping_n_s_per_m, double friction_n, double way_m,
                        int depth);

/// What remains of a tap on a wall that a steady force presses the device into.
struct RestingSwing {
  double amplitude_m = 0.0;   ///< Half of the way between the extremes, over the last half of the time.
  double frequency_hz = 0.0;  ///< Half the changes of sign of the velocity a second there.
  double net_power_w = 0.0;   ///< Work of wall and push there a second: what the swing lives on.
};

/// @param dynamics of the device, a hand included
/// @param load_n   steady force into the wall
RestingSwing rest_on(const SampledWall& wall, const DeviceDynamics& dynamics, double load_n,
                     double tap_m_per_s, std::int64_t periods);

}  // namespace lmdbench
