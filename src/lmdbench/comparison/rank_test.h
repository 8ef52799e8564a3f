// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace lmdbench {

/// Two-sample rank test of Mann and Whitney (1947), exact for every sample size: the distribution under "both samples
/// come from one source" is enumerated, tied values included (conditional distribution of the midranks, shift algorithm
/// of Streitberg and Roehmel 1986).
struct RankTest {
  double agreement =
      0.5;  ///< Share of the pairings (base value, candidate value) in which the candidate's is larger;
            ///< ties count half. 1: all pairings say "larger".
  double p_larger = 1.0;   ///< Probability of such an agreement or a larger one when nothing differs.
  double p_smaller = 1.0;  ///< The same for such an agreement or a smaller one.
};

/// Both samples have at least one value, all finite. Time grows as the fourth power of the number of values: 0.4 s for
/// 100 on either side.
RankTest rank_test(std::span<const double> base, std::span<const double> candidate);

}  // namespace lmdbench
