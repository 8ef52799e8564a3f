// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/global_search/check.h>

namespace lmdbench::experiments {

LmdError check_search(const SearchImplementation& implementation, GlobalSearch& search, const Scene& scene,
                      const std::vector<Pose>& poses, const Truth& truth) {
  LmdError error;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    search.run(poses[i]);
    // The paper's searches yield candidates: a pair appears once per triangle pair that found it.
    const LmdSet* lmds = search.lmds();
    LmdSet candidates;
    if (lmds != nullptr && implementation.promise == Promise::APPROXIMATION) {
      candidates = distinct_pairs(*lmds);
      lmds = &candidates;
    }
    error.add(implementation.promise, "pose " + std::to_string(i), scene, truth[i], lmds,
              search.minimum_distance());
  }
  return error;
}

}  // namespace lmdbench::experiments
