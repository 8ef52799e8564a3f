// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/registry.h>

#include <micro/lmd_error.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench::micro {

/// Task "global search": from a pose, what is near what. One implementation a file; each is checked against
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
  Exactness exactness = Exactness::APPROXIMATE;
  bool slow = false;  ///< Only timed where asked for.
  std::function<std::unique_ptr<GlobalSearch>(const Scene&)> make;
};

SearchImplementation original_search();
SearchImplementation improved_search();
SearchImplementation improved_search_with_reduction();
SearchImplementation certified_search();
SearchImplementation certified_search_from_scratch();
SearchImplementation exhaustive_search();
SearchImplementation fcl_cold_search();
SearchImplementation fcl_warm_search();
SearchImplementation embree_search();
SearchImplementation cgal_vertex_search();

/// All that this build knows, in the order of reports, but for `cgal_vertex_search`,
/// which has a program of its own.
std::vector<SearchImplementation> search_implementations();

/// A method's `search` as an implementation, followed by its trackings in the global thread where wanted.
std::unique_ptr<GlobalSearch> make_method_search(const std::string& method, const Scene& scene, int trackings,
                                                 const MethodOptions& options = {});

}  // namespace lmdbench::micro
