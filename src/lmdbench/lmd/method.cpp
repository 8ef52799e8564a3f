// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method.h>

#include <algorithm>
#include <iterator>

namespace lmdbench {

LmdSet within_cutoff(const LmdSet& lmds, double cutoff) {
  LmdSet result;
  std::copy_if(lmds.begin(), lmds.end(), std::back_inserter(result),
               [cutoff](const Lmd& lmd) { return lmd.distance <= cutoff; });
  return result;
}

}  // namespace lmdbench
