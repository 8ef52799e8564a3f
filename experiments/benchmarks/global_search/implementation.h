// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/registry.h>

#include <support/lmd_error.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Task "global search": near features at a pose. Each implementation is checked against the truth
/// before it is timed.
class GlobalSearch {
 public:
  virtual ~GlobalSearch() = default;
  /// The timed work.
  virtual void run(const Pose& X_WM) = 0;
  /// Smallest distance of the last `run` [m]; NaN where it found nothing.
  virtual double minimum_distance() const = 0;
  /// LMD set of the last `run`; null for peers that find a nearest pair only.
  virtual const LmdSet* lmds() const = 0;
};

struct SearchImplementation {
  std::string name;
  Promise promise = Promise::APPROXIMATION;
  bool slow = false;  ///< Only timed on request.
  std::function<std::unique_ptr<GlobalSearch>(const Scene&)> make;
};

/// A method's `search`, followed by as many trackings as the global thread adds (paper, section
/// 4.3). It is named after the method, with "+reduction" where trackings follow.
SearchImplementation method_search(const std::string& method, int trackings = 0,
                                   const nlohmann::json& options = nlohmann::json::object());

/// Every method of the registry; those with a first reduction also without it.
std::vector<SearchImplementation> method_searches();

/// `certified` without frame coherence.
SearchImplementation certified_search_from_scratch();
SearchImplementation fcl_cold_search();
SearchImplementation fcl_warm_search();
SearchImplementation embree_search();
SearchImplementation cgal_vertex_search();

/// All implementations of this build, in the order of reports, except `cgal_vertex_search`, which
/// has its own program.
std::vector<SearchImplementation> search_implementations();

/// Runs the implementation at every pose and compares with truth.
LmdError check_search(const SearchImplementation& implementation, GlobalSearch& search, const Scene& scene,
                      const std::vector<Pose>& poses, const Truth& truth);

}  // namespace lmdbench::experiments
