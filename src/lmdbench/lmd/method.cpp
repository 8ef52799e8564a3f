// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_description.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace lmdbench {

void Method::find_critical(const Pose&, CriticalSet&, WorkCounters&) {
  throw std::logic_error(description().name + " finds no critical pairs");
}

LmdSet lmds_at(Method& method, const Pose& X_WM) {
  LmdSet lmds;
  WorkCounters ignored;
  method.search(X_WM, lmds, ignored);
  return lmds;
}

CriticalSet critical_at(Method& method, const Pose& X_WM) {
  CriticalSet critical;
  WorkCounters ignored;
  method.find_critical(X_WM, critical, ignored);
  return critical;
}

LmdSet within_cutoff(const LmdSet& lmds, double cutoff) {
  LmdSet result;
  std::copy_if(lmds.begin(), lmds.end(), std::back_inserter(result),
               [cutoff](const Lmd& lmd) { return lmd.distance <= cutoff; });
  return result;
}

}  // namespace lmdbench
