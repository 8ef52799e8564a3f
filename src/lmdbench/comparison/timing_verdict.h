// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/ratio_estimate.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lmdbench {

/// What a comparison says, of one stage or as a whole.
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
  std::optional<std::size_t>
      processes_needed;  ///< A side, to become sure; only where unsure and where it can be told
  std::string work;      ///< Where slower or faster: whether the counters of the stage moved with it
};

/// The rule, in this order:
///   same    the interval is within the least effect of 1;
///   slower  the interval of an alarm lies above 1; the first line leaves only those that reach beyond the least effect;
///   faster  it lies below 1, likewise;
///   unsure  everything else.
/// Of so few processes that a rank test cannot reach `error` every pairing has to show a factor of SINGLE_PROCESS_FACTOR, in a
/// stage that takes SINGLE_PROCESS_SECONDS on one of the sides; where they are too few for the interval as well (one or two a
/// side) every pairing within the least effect is `same`.
/// @param least_effect relative change that matters, e.g. 0.05
/// @param error        probability of a false "slower" that is allowed for this stage
Timing judge_timing(std::span<const double> base, std::span<const double> candidate, double least_effect,
                    double error);

}  // namespace lmdbench
