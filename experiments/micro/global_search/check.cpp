// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/check.h>

#include <algorithm>
#include <cmath>

namespace lmdbench::micro {

Truth exhaustive_truth(const Scene& scene, const std::vector<Pose>& poses) {
  const std::unique_ptr<Method> method = make_method("exhaustive", scene);
  Truth truth(poses.size());
  WorkCounters counters;
  for (std::size_t i = 0; i < poses.size(); ++i) method->search(poses[i], truth[i], counters);
  return truth;
}

SearchError check_search(const SearchImplementation& implementation, GlobalSearch& search, const Scene& scene,
                         const std::vector<Pose>& poses, const Truth& truth) {
  SearchError error;
  const auto object = [&](std::size_t pose, const std::string& what) {
    if (error.objection.empty()) error.objection = "pose " + std::to_string(pose) + ": " + what;
  };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    search.run(poses[i]);
    if (const LmdSet* lmds = search.lmds()) {
      const MatchCount count = count_matches(truth[i], *lmds, Match::FEATURE_PAIR, scene);
      error.feature_pairs += count;
      const bool complete = count.missed() == 0 && count.right == lmds->size();
      if (implementation.exactness == Exactness::COMPLETE_SET && !complete) object(i, "not the true LMD set");
    }
    if (truth[i].empty()) continue;
    const double minimum = minimum_distance(truth[i]);
    const double relative = std::isnan(search.minimum_distance())
                                ? std::numeric_limits<double>::infinity()
                                : (search.minimum_distance() - minimum) / minimum;
    if (relative < -MINIMUM_TOLERANCE) object(i, "a minimum distance below the true one");
    error.worst_minimum_error = std::max(error.worst_minimum_error, relative);
    if (std::abs(relative) <= MINIMUM_TOLERANCE) continue;
    ++error.minimum_missed;
    if (implementation.exactness != Exactness::APPROXIMATE) object(i, "not the true minimum distance");
  }
  return error;
}

}  // namespace lmdbench::micro
