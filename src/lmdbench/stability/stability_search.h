// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/run/run.h>
#include <lmdbench/stability/stability_trial.h>

#include <cstdint>
#include <string>
#include <vector>

/// The largest clean stiffness of a closed loop for each method: `lmdbench stability`. F_max of the
/// force law varies the resting contact's stiffness; `stability_trial.h` tries it, `cleanliness.h`
/// judges it. Growth changes its sign at the critical stiffness. The search starts FIRST_BRACKET
/// beside the linear loop's boundary, widens by BRACKET_FACTOR; TOMS 748 to STIFFNESS_TOLERANCE.
///
/// With Coulomb friction (stability_trial.h) growth is not smooth over stiffness: from the file's
/// stiffness the search goes down by FRICTION_FACTOR until nothing shakes, then up to the first
/// that does, and bisects to FRICTION_TOLERANCE. The answer holds for the row's tap. In a linear
/// contact `exact_n_per_m` holds for every tap, since friction only takes energy. An exponential
/// contact is stiffer on a large tap's inner side: the answer may be lower.
namespace lmdbench {

inline constexpr double FIRST_BRACKET = 0.01;
inline constexpr double BRACKET_FACTOR = 1.5;
inline constexpr double STIFFNESS_TOLERANCE = 1e-5;  ///< Relative width of the last bracket.
inline constexpr double FRICTION_FACTOR = 2.0;
inline constexpr double FRICTION_TOLERANCE = 1e-3;
inline constexpr int MOST_BRACKETINGS = 60;
inline constexpr int MOST_REFINEMENTS = 40;

/// Result of one search.
struct StabilityRow {
  std::string method;   ///< Label of its entry in the experiment.
  std::string profile;  ///< Of the force profile; if unnamed, its law.
  std::int64_t delay_frames = 0;
  double servo_rate_hz = UNSET;
  double mass_kg = UNSET;
  double damping_n_s_per_m = UNSET;
  double friction_n = 0.0;  ///< Coulomb friction of each axis.
  /// Largest clean stiffness of all trials; NaN without one.
  double critical_stiffness_n_per_m = UNSET;
  /// Boundary of the linear loop (`phantom/stability_boundary.h`); of a device that turns as well,
  /// with the lever of the contact at rest.
  double exact_n_per_m = UNSET;
  double bound_n_per_m = UNSET;  ///< The sufficient bound b / (T/2 + t_d).
  /// End of the clean range: the fastest growing measure just above it ("amplitude", "energy" or
  /// "force_above_30_hz"); "limit_cycle": a device with friction goes on swinging; "device_force":
  /// the device clips the resting force or torque first; "within_counts": above it a contact leaves
  /// less motion than encoders count; "nothing": no end found. Without a stiffness (has_answer):
  /// "never": none was clean (or none that carries the push); "no_contact":
  /// no force and stiffness at the first pose, or within the push's reach; "saturated": nearer than
  /// the saturation distance; "gives_way": the force does not fall along itself; "stuck": friction
  /// holds against every tap that the contact bears; "within_counts": it leaves less motion than
  /// encoders count; "undecided": the budget ended first, with the largest clean stiffness so far.
  std::string clean_until;
  double tap_m = UNSET;     ///< Swing of the tap at the stiffness found [m].
  std::int64_t trials = 0;  ///< Closed loops simulated or skipped.

  /// Whether a stiffness was found, and the end of the clean range.
  bool has_answer() const;
};

/// Limits of one search.
struct StabilityBudget {
  std::int64_t trials = 400;
  double seconds = 120.0;  ///< Wall clock: machine-dependent, "undecided".
};

/// Searches for every method of the experiment.
/// @param progress the phase tells method, trial and result so far; the total is unknown (-1)
/// @throws UsageError for an open loop; Interrupted when `progress` returned false
std::vector<StabilityRow> find_critical_stiffness(const Experiment& experiment,
                                                  const RunProgress& progress = {},
                                                  const StabilityBudget& budget = {});

/// Why there is no answer, and the remedy; empty where there is an answer.
std::string advice(const StabilityRow& row);

/// JSON array of the rows, null for NaN.
std::string stability_json(const std::vector<StabilityRow>& rows);

/// For people: a line for each row.
std::string stability_text(const std::vector<StabilityRow>& rows);

}  // namespace lmdbench
