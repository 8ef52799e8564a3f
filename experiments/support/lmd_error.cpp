// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>

#include <support/lmd_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench::experiments {

Truth exhaustive_truth(const Scene& scene, const std::vector<Pose>& poses) {
  const std::unique_ptr<Method> method = make_method("exhaustive", scene);
  Truth truth(poses.size());
  WorkCounters counters;
  for (std::size_t i = 0; i < poses.size(); ++i) method->search(poses[i], truth[i], counters);
  return truth;
}

void LmdError::add(Promise promise, const std::string& where, const Scene& scene, const LmdSet& truth,
                   const LmdSet* lmds, double minimum) {
  const auto object = [&](const std::string& what) {
    if (objection.empty()) objection = where + ": " + what;
  };
  if (lmds != nullptr) {
    const Agreement here = agreement(truth, *lmds, Match::SAME_FEATURES, scene);
    same += here;
    neighbours += agreement(truth, *lmds, Match::NEIGHBOURING_FEATURES, scene);
    if (promise == Promise::COMPLETE_SET && !here.exact()) object("not the true LMD set");
  }
  if (truth.empty()) return;
  const double true_minimum = minimum_distance(truth);
  const double relative =
      std::isnan(minimum) ? std::numeric_limits<double>::infinity() : (minimum - true_minimum) / true_minimum;
  if (relative < -MINIMUM_TOLERANCE) object("a minimum distance below the true one");
  worst_minimum_error = std::max(worst_minimum_error, relative);
  if (std::abs(relative) <= MINIMUM_TOLERANCE) return;
  ++minimum_missed;
  if (promise != Promise::APPROXIMATION) object("not the true minimum distance");
}

}  // namespace lmdbench::experiments
