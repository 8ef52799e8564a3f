// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/ratio_estimate.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lmdbench {

/// Result of a comparison, of one stage or as a whole.
enum class Verdict {
  SAME,     ///< Any change is smaller than the least effect.
  FASTER,   ///< Surely faster.
  SLOWER,   ///< Surely slower.
  CHANGED,  ///< Results or counters differ.
  UNSURE    ///< The samples cannot tell.
};

/// "same", "faster", ...
std::string_view verdict_name(Verdict verdict);

/// One stage of one method, candidate over base.
struct Timing {
  std::string method;
  std::string stage;
  double base_seconds = 0.0;       ///< Median over processes
  double candidate_seconds = 0.0;  ///< Likewise
  RatioEstimate estimate;
  Verdict verdict = Verdict::UNSURE;
  std::optional<std::size_t> processes_needed;  ///< A side, to become sure; only where unsure
  std::string work;  ///< Where slower or faster: whether the counters of the stage moved with it
};

/// The rule, in this order:
///   same    the interval is within the least effect of 1;
///   slower  an alarm's interval is above 1 (so it reaches beyond the least effect);
///   faster  it lies below 1, likewise;
///   unsure  everything else.
/// With too few processes for a rank test the result is `unsure`: with one or two a side always.
/// @param least_effect relative change that matters, e.g. 0.05
/// @param error        probability of a false "slower" that is allowed for this stage
Timing judge_timing(std::span<const double> base, std::span<const double> candidate, double least_effect,
                    double error);

}  // namespace lmdbench
