// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/axis_integrator.h>

#include <array>
#include <cmath>
#include <memory>

namespace lmdbench {

/// The energies of a simulated device since its start, over its three axes [J].
struct EnergyAccount {
  double kinetic = 0.0;   ///< Held in its motion.
  double spring = 0.0;    ///< Held in the springs of hand and grip.
  double rendered = 0.0;  ///< Work of the rendered force.
  double push = 0.0;      ///< Work of the push.
  double hand = 0.0;      ///< Work of the person who moves the hand.
  double damped = 0.0;    ///< Lost in dampers.
  double friction = 0.0;  ///< Lost to Coulomb friction.
  double moved = 0.0;     ///< Sum of the lengths of all energies that flowed in any tick.

  /// What the equations leave over: 0 but for rounding. Kinetic and spring energy are 0 at the start, where
  /// the device rests on the meant path.
  double residual() const { return rendered + push + hand - damped - friction - kinetic - spring; }

  /// Length of the residual as a share of the energy that moved; 0 where none has.
  double balance_error() const { return moved > 0.0 ? std::abs(residual()) / moved : 0.0; }
};

/// The device that hand, push and rendered force move between servo ticks: three equal, independent axes
/// (its friction acts in joints, so each axis has its own). It actuates and simulates translation; its
/// orientation is the meant path's (three actuated degrees of freedom: the hand turns the stylus freely).
class SimulatedDevice {
 public:
  /// Starts at rest.
  /// @param start_W     position [m], also of the meant path
  /// @param push_W      constant force [N]
  /// @param resolution  of the encoders [m]; 0: exact
  /// @param period      servo period [s]
  SimulatedDevice(const DeviceDynamics& dynamics, Integration integration, double period, const Vec3& start_W,
                  const Vec3& push_W, double resolution);

  /// One servo period with this force rendered all along (zero-order hold), while the meant path goes
  /// straight to its next position. Without a hand nothing is drawn along the path.
  void advance(const Vec3& rendered_W, const Vec3& next_path_position_W);

  Vec3 position() const;         ///< True position [m].
  Vec3 velocity() const;         ///< [m/s]
  Vec3 sensed_position() const;  ///< What the encoders tell: each axis rounded to the resolution [m].
  EnergyAccount energy() const;

  /// A blow: changes the velocity at once, as work of the push.
  void strike(const Vec3& velocity_change_W);

 private:
  AxisModel model_;
  std::array<std::unique_ptr<AxisIntegrator>, 3> integrators_;
  std::array<AxisState, 3> states_;
  Vec3 path_position_W_;
  bool has_hand_;
  double period_;
  double resolution_;
  EnergyFlows flows_ = EnergyFlows::Zero();
  double moved_ = 0.0;
};

}  // namespace lmdbench
