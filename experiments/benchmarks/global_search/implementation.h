// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/registry.h>

#include <support/lmd_error.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Task "global search": from a pose, what is near what. Each implementation is checked against
/// ground truth before it is timed.
class GlobalSearch {
 public:
  virtual ~GlobalSearch() = default;
  /// What is timed.
  virtual void run(const Pose& X_WM) = 0;
  /// Smallest distance that the last `run` found [m]; NaN where it found nothing.
  virtual double minimum_distance() const = 0;
  /// LMD set of the last `run`; null for peers that find a nearest pair only.
  virtual const LmdSet* lmds() const = 0;
};

struct SearchImplementation {
  std::string name;
  Promise promise = Promise::APPROXIMATION;
  bool slow = false;  ///< Only timed where asked for.
  std::function<std::unique_ptr<GlobalSearch>(const Scene&)> make;
};

/// A method's `search`, followed by as many trackings as the global thread adds (paper, section 4.3): named
/// after the method, with "+reduction" where trackings follow.
SearchImplementation method_search(const std::string& method, int trackings = 0,
                                   const nlohmann::json& options = nlohmann::json::object());

/// Every method of the registry; those that reduce with and without the first reduction.
std::vector<SearchImplementation> method_searches();

/// `certified` without frame coherence.
SearchImplementation certified_search_from_scratch();
SearchImplementation fcl_cold_search();
SearchImplementation fcl_warm_search();
SearchImplementation embree_search();
SearchImplementation cgal_vertex_search();

/// All that this build knows, in the order of reports, but for `cgal_vertex_search`,
/// which has a program of its own.
std::vector<SearchImplementation> search_implementations();

}  // namespace lmdbench::experiments
