// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/timing_verdict.h>

#include <algorithm>

namespace lmdbench {
namespace {

bool within(double low, double high, double least_effect) {
  return low >= 1.0 / (1.0 + least_effect) && high <= 1.0 + least_effect;
}

Verdict judge(const Timing& timing, double least_effect) {
  const RatioEstimate& e = timing.estimate;
  if (within(e.low, e.high, least_effect)) return Verdict::SAME;
  if (e.alarm_low > 1.0) return Verdict::SLOWER;
  if (e.alarm_high < 1.0) return Verdict::FASTER;
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
  timing.verdict = judge(timing, least_effect);
  if (timing.verdict == Verdict::UNSURE)
    timing.processes_needed =
        processes_needed(timing.estimate, std::min(base.size(), candidate.size()), least_effect, error);
  return timing;
}

}  // namespace lmdbench
