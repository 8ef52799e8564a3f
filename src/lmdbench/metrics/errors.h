// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/metrics/contact_work.h>
#include <lmdbench/metrics/method_summary.h>
#include <lmdbench/probes/truth_probe.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench {

/// Fewer events give no rate: 95 % interval of ten 0.48 to 1.84 times that, of two 0.12 to 3.6.
inline constexpr std::int64_t LEAST_EVENTS = 10;

/// Rare events of a run: their number, the time, and the rate that follows.
struct Events {
  double count = UNSET;
  double per_second = UNSET;  ///< [1/s]; unset below LEAST_EVENTS.
  /// Limits of the rate [1/s] at 95 %, of a Poisson count (Garwood, Biometrika 28, 1936). Events in
  /// bursts scatter more than that.
  double low = UNSET;
  double high = UNSET;
};

/// @param seconds observed; if not above 0, all is unset
Events count_events(std::int64_t count, double seconds);

/// "2 in 0.598 s (95 %: 0.405 to 12.1 a second)", with the rate, if any, before the interval; "-"
/// for uncounted events. `within` describes the time, as " in contact".
std::string events_text(const Events& events, double seconds, const std::string& within);

/// Errors of LMD sets and forces: the one definition of every reported error.

/// A change of force in one frame that a hand feels as a jerk, as a share of F_max of one LMD.
inline constexpr double JUMP_SHARE = 0.25;

/// The frames of a run's statistics.
struct RunFrames {
  std::vector<bool> in_contact;  ///< One a frame (contact.h).
  double frame_rate_hz = 0.0;
  double maximum_force = 0.0;  ///< F_max of one LMD [N].
  ContactPorts ports = {};     ///< For the energies of a closed loop.
};

/// Numbers of LMDs over the frames in contact (the largest: over all), of candidates over the
/// searches that start in one, and the reduction ratio over all searches: the sum of all candidates
/// over the sum of those that the first reductions kept; NaN for a method without searches of its
/// own rate.
void summarise_counts(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames);

/// Writes events into the four numbers of a summary for them.
void set_jumps(MethodSummary& summary, const Events& events);
void set_true_jumps(MethodSummary& summary, const Events& events, std::int64_t frames);

/// Jumps: changes of force over JUMP_SHARE of F_max from frame to frame, all; rate by contact time.
void summarise_jumps(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames);

/// Rendering: quantiles of force and K_eff and share of clipped frames, over frames in contact;
/// buzzing (cleanliness.h; NaN below 60 Hz) over all frames; in a closed loop the energies.
void summarise_rendering(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames);

/// Errors over the probed frames:
/// - recall and precision are pooled (lmd/agreement.h) over all of them;
/// - force errors and the angle count the frames in contact, so that free flight does not flatter
///   them, except those in which triangles intersect: they have no direction, so no force is the
///   true one. The angle also needs two forces;
/// - changes of force, the method's and the true one, and true jumps are over the same frames in
///   contact; `summarise_true_steps` is better where truth is known in every frame;
/// - the minimum distance is compared where both the method and truth have an LMD.
/// @param law  the method's
void summarise_errors(MethodSummary& summary, ForceLaw law, const std::vector<TruthFrame>& truth,
                      const std::vector<TruthComparison>& comparisons, const RunFrames& frames);

/// Jumps and changes of force, the method's and the true one's under its law, with truth in every
/// frame. Jumps follow `summarise_jumps`: true sets give the truth's jumps. Rate and quantiles are
/// over the frames in contact in which both true forces of the step are known; the last one, which
/// has no step, counts in the rate.
void summarise_true_steps(MethodSummary& summary, ForceLaw law, const MethodRecord& record,
                          const CompleteTruth& truth, const RunFrames& frames);

}  // namespace lmdbench
