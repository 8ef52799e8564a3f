// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/metrics/method_summary.h>
#include <lmdbench/probes/truth_probe.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench {

/// Fewer events have no rate: the 95 % interval of ten spans 0.48 to 1.84 times their number, that of two 0.12 to 3.6.
inline constexpr std::int64_t LEAST_EVENTS = 10;

/// Rare events of a run: how many, in what time, and what that says of their rate.
struct Events {
  double count = UNSET;
  double per_second = UNSET;  ///< [1/s]; unset below LEAST_EVENTS.
  /// Limits of the rate [1/s] at 95 %, those of a Poisson count (Garwood, Biometrika 28, 1936). Events that come in bursts
  /// scatter more than that.
  double low = UNSET;
  double high = UNSET;
};

/// @param seconds in which they were looked for; all is unset where it is not above 0
Events count_events(std::int64_t count, double seconds);

/// "2 in 0.598 s (95 %: 0.405 to 12.1 a second)", and before the interval the rate where there is one; "-" for what was not
/// counted. `within` says what the time is of, such as " in contact".
std::string events_text(const Events& events, double seconds, const std::string& within);

/// What the LMD sets and forces of a run are worth: the one definition of every reported error.

/// A change of force within one frame that a hand feels as a jerk, as a share of F_max of one LMD.
inline constexpr double JUMP_SHARE = 0.25;

/// What the statistics of a run are taken over.
struct RunFrames {
  std::vector<bool> in_contact;  ///< One a frame (contact.h).
  double frame_rate_hz = 0.0;
  double maximum_force = 0.0;  ///< F_max of one LMD [N].
};

/// Numbers of LMDs over the frames in contact, and of candidates and reduction over the searches that start
/// in one. The reduction ratio is the sum of all candidates over the sum of all that the first reductions
/// kept; NaN for a method without searches of its own rate.
void summarise_counts(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames);

/// Puts events into the four numbers of a summary that tell them.
void set_jumps(MethodSummary& summary, const Events& events);
void set_true_jumps(MethodSummary& summary, const Events& events, std::int64_t frames);

/// Changes of force above JUMP_SHARE of F_max from a frame to the next, over all frames; their rate is per second in contact.
void summarise_jumps(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames);

/// What was rendered: quantiles of force and of K_eff and the share of clipped frames over the frames in contact; what a hand
/// feels as buzzing (cleanliness.h; NaN below 60 Hz, which cannot render it) over all frames; in a closed loop the energies.
void summarise_rendering(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames);

/// Errors over the probed frames:
/// - recall and precision are pooled (lmd/agreement.h) over all of them;
/// - force errors and the angle count the frames in contact, so that free flight does not flatter them, and
///   leave out those whose true minimum distance is 0: touching triangles have no direction, so no force is
///   the true one. The angle also needs two forces.
/// - changes of force, the method's and the true one, are over the same frames in contact, true jumps among them. Where truth
///   is known in every frame, `summarise_true_steps` says them better;
/// - the minimum distance is compared where both the method and truth have an LMD.
/// @param law  the method's
void summarise_errors(MethodSummary& summary, ForceLaw law, const std::vector<TruthFrame>& truth,
                      const std::vector<TruthComparison>& comparisons, const RunFrames& frames);

/// Jumps and changes of force, the method's and the true one's under its law, with truth in every frame: jumps by the rule of
/// `summarise_jumps`, so that a method whose sets are the true ones has as many as the truth; quantiles over the frames in
/// contact.
void summarise_true_steps(MethodSummary& summary, ForceLaw law, const MethodRecord& record,
                          const CompleteTruth& truth, const RunFrames& frames);

}  // namespace lmdbench
