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

/// The largest clean stiffness of a closed loop, method by method: `lmdbench stability`. The stiffness of the contact at
/// rest is varied through F_max of the force law; each is tried as `stability_trial.h` says and judged
/// as `cleanliness.h` says. Growth changes its sign at the critical stiffness. It is looked for FIRST_BRACKET on either side of the linear
/// loop's boundary, from there on bracketed by factors of BRACKET_FACTOR, and found to STIFFNESS_TOLERANCE by TOMS 748.
///
/// With Coulomb friction (stability_trial.h) growth is no smooth function of the stiffness: the search goes down by FRICTION_FACTOR from the
/// file's stiffness until nothing shakes, up to the first stiffness that does, and halves that bracket to FRICTION_TOLERANCE. Its answer
/// holds for the tap in the row; in a linear contact `exact_n_per_m` holds for every tap, since friction only ever takes energy. An exponential
/// contact is stiffer on the inner side of a large tap than at rest, and the answer may be below it.
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
  std::string method;  ///< Label of its entry in the experiment.
  std::string
      profile;  ///< Name of its force profile; its force law where there is one profile without a name.
  std::int64_t delay_frames = 0;
  double servo_rate_hz = UNSET;
  double mass_kg = UNSET;
  double damping_n_s_per_m = UNSET;
  double friction_n = 0.0;  ///< Coulomb friction of each axis.
  /// Largest stiffness that was tried and clean; NaN where none was.
  double critical_stiffness_n_per_m = UNSET;
  /// Boundary of the linear loop (`phantom/stability_boundary.h`); of a device that turns as well, with the lever that the contact
  /// has at rest.
  double exact_n_per_m = UNSET;
  double bound_n_per_m = UNSET;  ///< The sufficient bound b / (T/2 + t_d).
  /// What ends the clean range: "amplitude", "energy" or "force_above_30_hz", whichever grows fastest just above it;
  /// "limit_cycle" of a device with friction that goes on swinging; "device_force" where the device clips the resting force or
  /// torque first; "nothing" where the search found no end. Without a stiffness (has_answer):
  /// "never" where no stiffness was clean (or none that carries the push); "no_contact" where the first pose, or all
  /// that the push can reach, has no force and stiffness; "saturated" where it is nearer than the saturation distance; "stuck" where
  /// friction holds the device against every tap that the contact bears; "within_counts" where it leaves less way than the encoders
  /// count; "undecided" where the budget was spent first, with the
  /// largest clean stiffness so far.
  std::string clean_until;
  double tap_m = UNSET;     ///< How far the tap swings the device at the stiffness found [m].
  std::int64_t trials = 0;  ///< Closed loops simulated, or found not worth it.

  /// A stiffness was found, and what ends the clean range.
  bool has_answer() const;
};

/// What one search may cost.
struct StabilityBudget {
  std::int64_t trials = 400;
  double seconds = 120.0;  ///< Of the clock; what comes of it depends on the machine, and is "undecided".
};

/// Searches for every method of the experiment.
/// @param progress  the phase tells method, trial and what is known so far; how much there is to do, nobody knows (-1)
/// @throws UsageError for an experiment whose loop is open; Interrupted when `progress` returned false
std::vector<StabilityRow> find_critical_stiffness(const Experiment& experiment,
                                                  const RunProgress& progress = {},
                                                  const StabilityBudget& budget = {});

/// Why there is no answer and what to do; empty where there is one.
std::string advice(const StabilityRow& row);

/// JSON array of the rows, null for NaN.
std::string stability_json(const std::vector<StabilityRow>& rows);

/// For people: one line a row.
std::string stability_text(const std::vector<StabilityRow>& rows);

}  // namespace lmdbench
