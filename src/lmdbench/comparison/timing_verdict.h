// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/rank_test.h>
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
  RankTest ranks;
  Verdict verdict = Verdict::UNSURE;
  std::optional<std::size_t>
      processes_needed;  ///< A side, to become sure; only where unsure and where it can be told
  std::string work;      ///< Where slower or faster: whether the counters of the stage moved with it
};

/// The rule. With one process a side:
///   same  within the least effect;  slower or faster  beyond SINGLE_PROCESS_FACTOR, where one of the two took at least
///   SINGLE_PROCESS_SECONDS;  unsure  otherwise.
/// With more:
///   slower  the interval lies above 1 and an effect as large as the least one is inside it, and the rank test agrees:
///           its probability is below `error`, or, where so few processes cannot reach that, every pairing of a base
///           and a candidate process says slower;
///   faster  likewise, downwards;
///   same    the whole interval is within the least effect of 1;
///   unsure  everything else.
/// @param least_effect relative change that matters, e.g. 0.05
/// @param error        probability of a false "slower" that is allowed for this stage
Timing judge_timing(std::span<const double> base, std::span<const double> candidate, double least_effect,
                    double error);

}  // namespace lmdbench
