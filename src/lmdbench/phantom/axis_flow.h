// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/axis_model.h>

namespace lmdbench {

/// Exact solution of s' = A s over a stretch of time, with the energies that flow meanwhile:
///   s(t) = transition s(0), energy of flow i = s(0)^T energy[i] s(0), energy[i] = int_0^t e^(A's) power[i]
///   e^(As) ds.
struct AxisFlow {
  AxisMatrix transition;
  std::array<AxisMatrix, ENERGY_FLOW_COUNT> energy;

  EnergyFlows flows(const AxisState& state) const;
};

/// e^(A t).
/// @param t seconds, at least 0
AxisMatrix axis_transition(const AxisMatrix& matrix, double t);

/// Transition by the matrix exponential; integrals by their power series over a short step, which is then
/// doubled: P(2 t) = P(t) + e^(A't) P(t) e^(At). Van Loan's block exponential would lose digits to e^(-A t),
/// which grows where damping is strong.
/// @param t seconds, at least 0
AxisFlow axis_flow(const AxisMatrix& matrix, const std::array<AxisMatrix, ENERGY_FLOW_COUNT>& power,
                   double t);

/// The same computed in extended precision and rounded once: for flows that are used in every servo period,
/// whose errors would add up.
AxisFlow lasting_axis_flow(const AxisMatrix& matrix, const std::array<AxisMatrix, ENERGY_FLOW_COUNT>& power,
                           double t);

}  // namespace lmdbench
