// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/timing_verdict.h>

#include <algorithm>
#include <vector>

namespace lmdbench {
namespace {

Verdict judge_single(double base, double candidate, double ratio, double least_effect) {
  if (ratio <= 1.0 + least_effect && ratio >= 1.0 / (1.0 + least_effect)) return Verdict::SAME;
  if (std::max(base, candidate) < SINGLE_PROCESS_SECONDS) return Verdict::UNSURE;
  if (ratio >= SINGLE_PROCESS_FACTOR) return Verdict::SLOWER;
  if (ratio <= 1.0 / SINGLE_PROCESS_FACTOR) return Verdict::FASTER;
  return Verdict::UNSURE;
}

Verdict judge_replicated(const Timing& timing, double least_effect, double error) {
  const double most = 1.0 + least_effect, least = 1.0 / most;
  const RatioEstimate& e = timing.estimate;
  if (e.low >= least && e.high <= most) return Verdict::SAME;
  const bool ranks_say_larger = timing.ranks.p_larger <= error || timing.ranks.agreement == 1.0;
  const bool ranks_say_smaller = timing.ranks.p_smaller <= error || timing.ranks.agreement == 0.0;
  if (e.low > 1.0 && e.high > most && ranks_say_larger) return Verdict::SLOWER;
  if (e.high < 1.0 && e.low < least && ranks_say_smaller) return Verdict::FASTER;
  return Verdict::UNSURE;
}

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::SAME:
      return "same";
    case Verdict::FASTER:
      return "faster";
    case Verdict::SLOWER:
      return "slower";
    case Verdict::CHANGED:
      return "changed";
    case Verdict::UNSURE:
      break;
  }
  return "unsure";
}

Timing judge_timing(std::span<const double> base, std::span<const double> candidate, double least_effect,
                    double error) {
  Timing timing;
  timing.base_seconds = median({base.begin(), base.end()});
  timing.candidate_seconds = median({candidate.begin(), candidate.end()});
  timing.estimate = estimate_ratio(base, candidate, error);
  timing.ranks = rank_test(base, candidate);
  timing.verdict = timing.estimate.spread ? judge_replicated(timing, least_effect, error)
                                          : judge_single(timing.base_seconds, timing.candidate_seconds,
                                                         timing.estimate.ratio, least_effect);
  if (timing.verdict == Verdict::UNSURE && timing.estimate.spread)
    timing.processes_needed = processes_needed(*timing.estimate.spread, least_effect, error);
  return timing;
}

}  // namespace lmdbench
