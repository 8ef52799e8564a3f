// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/axis_model.h>

#include <optional>

namespace lmdbench {

/// Exact solution of s' = A s over a stretch of time, with the energies that flow meanwhile:
///   s(t) = transition s(0), energy of flow i = s(0)^T energy[i] s(0),
///   energy[i] = int_0^t e^(A's) power[i] e^(As) ds.
struct AxisFlow {
  AxisMatrix transition;
  std::array<AxisMatrix, ENERGY_FLOW_COUNT> energy;

  EnergyFlows flows(const AxisState& state) const;
};

/// e^(A t).
/// @param t seconds, at least 0
AxisMatrix axis_transition(const AxisMatrix& matrix, double t);

/// Transition by the matrix exponential; integrals by their power series over a short step, then
/// doubled: P(2 t) = P(t) + e^(A't) P(t) e^(At). Van Loan's block exponential would lose digits to
/// e^(-A t), which grows where damping is strong.
/// @param t seconds, at least 0
AxisFlow axis_flow(const AxisMatrix& matrix, const std::array<AxisMatrix, ENERGY_FLOW_COUNT>& power,
                   double t);

/// The same in extended precision, rounded once: for flows of every servo period, whose errors add
/// up.
AxisFlow lasting_axis_flow(const AxisMatrix& matrix, const std::array<AxisMatrix, ENERGY_FLOW_COUNT>& power,
                           double t);

/// Carries one axis over a servo period with constant inputs (zero-order hold), exactly: by matrix
/// exponentials between the events of Coulomb friction.
///  1. A device at rest whose net force is within the friction is stuck until the force exceeds it.
///  2. A slipping device has the full friction against its motion until its velocity is zero;
///     there the net force decides whether it sticks or turns back.
/// Bracketing (TOMS 748) between eight points a period, or 25 a swing of the fastest mode, finds an
/// event to the last bits of the period: a velocity that dips below zero and returns between two of
/// them goes unseen.
class ExactIntegrator {
 public:
  /// @param period servo period [s]
  ExactIntegrator(const AxisModel& model, double period);

  /// Advances the state by one servo period and adds the energies that flowed to `flows`.
  void advance(AxisState& state, EnergyFlows& flows);

 private:
  /// One of the two regimes of the equations.
  struct Regime {
    AxisMatrix matrix;
    AxisFlow period;      ///< Over the whole servo period.
    double look = 0.0;    ///< Between two points [s].
    AxisMatrix one_look;  ///< Transition over that.
  };

  Regime make_regime(const AxisMatrix& matrix) const;
  /// Positive while the regime lasts.
  double margin(const AxisState& state, bool stuck) const;
  /// End of the regime within `duration`, from just behind it; nothing where it lasts.
  std::optional<double> event_time(const Regime& regime, const AxisState& state, bool stuck,
                                   double duration) const;
  /// Sets the friction force of the present motion. @return whether the device is stuck
  bool settle_friction(AxisState& state) const;

  AxisModel model_;
  double period_;
  Regime slipping_;
  Regime stuck_;
};

}  // namespace lmdbench
