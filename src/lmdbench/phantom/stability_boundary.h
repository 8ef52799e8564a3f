// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/axis_model.h>

#include <cstdint>
#include <optional>

/// The exact stability boundary of the sampled loop: the device of `axis_model.h` against a wall of
/// stiffness K whose force is held for a servo period T and arrives `delay_frames` periods late.
/// The loop is linear: no Coulomb friction, no quantisation.
///
/// With s_(n+1) = Phi s_n + Gamma F_n (matrix exponential) and F_n = -K x_(n-d), the loop is stable
/// if every eigenvalue of
///   [ Phi s + Gamma f_d ; f_1 = -K x, f_2 = f_1 of the period before, ... ]
/// is within the unit circle. A wall of vanishing stiffness is stable, so the critical stiffness is
/// the least K > 0 with an eigenvalue on the circle, z = e^(i theta): there 1 + K H(z) = 0 with
/// H(z) = z^-d C (z I - Phi)^-1 Gamma, so H is real and negative and K = -1 / H. Every theta in (0,
/// pi] with a real negative H is bracketed and solved for; the least of their K is the boundary.
namespace lmdbench {

/// A device that also turns and is touched off its centre. The contact sees the point's motion, x +
/// lever_m angle: the response to the force is H(z) = H_translation(z) + lever_m^2 H_rotation(z).
/// What the resting load does as the device turns (load times its height) is left out.
struct SampledTurn {
  DeviceDynamics dynamics;  ///< Inertia [kg m^2] as mass, damping [N m s], hand likewise.
  double lever_m = 0.0;     ///< From the device's centre to the line of the contact's force.
};

struct SampledLoop {
  DeviceDynamics dynamics;
  double period_s = 1e-3;
  std::int64_t delay_frames = 0;
  std::optional<SampledTurn> turn = std::nullopt;
};

/// Least stiffness [N/m] at which an eigenvalue reaches the unit circle; infinity without one. 0 if
/// the translation or a rotation with a lever has no damping: taken to diverge at any stiffness.
/// @throws UsageError as `make_axis_model`, or for a period of 0 or less or a negative delay
double critical_stiffness(const SampledLoop& loop);

/// Largest modulus of the loop's eigenvalues at stiffness K [N/m], without those that the wall
/// cannot change (the hand's path).
double spectral_radius(const SampledLoop& loop, double stiffness);

/// The known sufficient bound b / (T/2 + t_d) [N/m] with all damping of device and hand (Gil et al.
/// 2007; Colgate's condition K < 2 b / T without delay). Damping of a hand behind a grip, not at
/// the device, does not count. With a turn: the point's, 1 / (1 / b + lever_m^2 / b_rotation).
double sufficient_stiffness(const SampledLoop& loop);

}  // namespace lmdbench
