// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/exact_integrator.h>

#include <array>
#include <cmath>

namespace lmdbench {

/// The energies of a simulated device since its start, over its axes [J].
struct EnergyAccount {
  double kinetic = 0.0;   ///< Held in its motion.
  double spring = 0.0;    ///< Held in the springs of hand and grip.
  double rendered = 0.0;  ///< Work of the rendered force and torque.
  double push = 0.0;      ///< Work of the push.
  double hand = 0.0;      ///< Work of the person who moves the hand.
  double damped = 0.0;    ///< Lost in dampers.
  double friction = 0.0;  ///< Lost to Coulomb friction.
  double moved = 0.0;     ///< Sum of the absolute energies that flowed in any period.

  /// Residual of the equations: 0 except for rounding. Kinetic and spring energy are 0 at the
  /// start, where the device rests on the meant path.
  double residual() const { return rendered + push + hand - damped - friction - kinetic - spring; }

  /// Absolute residual as a share of the energy that moved; 0 where none has.
  double balance_error() const { return moved > 0.0 ? std::abs(residual()) / moved : 0.0; }

  EnergyAccount& operator+=(const EnergyAccount& other);
};

/// Three equal, independent axes of a device (friction acts in joints, so each has its own), at
/// rest at first. In metres, kilograms, newtons; for turns rad, kg m^2, N m (simulated_device.h).
class AxisTriple {
 public:
  /// @param push    constant force, by axis
  /// @param period  servo period [s]
  AxisTriple(const DeviceDynamics& dynamics, double period, const Vec3& push);

  /// One servo period with this force rendered throughout.
  /// @param path_velocity  of the meant path, by axis
  void advance(const Vec3& rendered, const Vec3& path_velocity);

  /// A blow: changes the velocity at once, as work of the push.
  void strike(const Vec3& velocity_change);

  Vec3 offset() const { return at_each(AxisSlot::POSITION); }  ///< From the meant path.
  Vec3 velocity() const { return at_each(AxisSlot::VELOCITY); }
  Vec3 path_velocity() const { return at_each(AxisSlot::PATH_VELOCITY); }  ///< In the last period.
  EnergyAccount energy() const;

 private:
  Vec3 at_each(AxisSlot slot) const;

  AxisModel model_;
  ExactIntegrator integrator_;
  std::array<AxisState, 3> states_;
  EnergyFlows flows_ = EnergyFlows::Zero();
  double moved_ = 0.0;
};

}  // namespace lmdbench
