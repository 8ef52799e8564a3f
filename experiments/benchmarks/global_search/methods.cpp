// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/global_search/implementation.h>

namespace lmdbench::experiments {
namespace {

class MethodSearch : public GlobalSearch {
 public:
  MethodSearch(std::unique_ptr<Method> method, double cutoff, int trackings)
      : method_(std::move(method)), cutoff_(cutoff), trackings_(trackings) {}

  void run(const Pose& X_WM) override {
    method_->search(X_WM, lmds_, counters_);
    for (int i = 0; i < trackings_; ++i) method_->track(X_WM, lmds_, counters_);
  }
  double minimum_distance() const override { return lmdbench::minimum_distance(lmds_); }
  const LmdSet* lmds() const override {
    // Tracking may carry a pair beyond the cutoff, where it is no LMD.
    reported_ = within_cutoff(lmds_, cutoff_);
    return &reported_;
  }

 private:
  std::unique_ptr<Method> method_;
  double cutoff_;
  int trackings_;
  LmdSet lmds_;
  mutable LmdSet reported_;
  WorkCounters counters_;
};

}  // namespace

SearchImplementation method_search(const std::string& method, int trackings, const nlohmann::json& options) {
  const MethodDescription& description = method_description(method);
  return {method + (trackings > 0 ? "+reduction" : ""), description.promise, description.brute_force,
          [method, trackings, options](const Scene& scene) {
            return std::make_unique<MethodSearch>(make_method(method, scene, options), scene.cutoff,
                                                  trackings);
          }};
}

std::vector<SearchImplementation> method_searches() {
  std::vector<SearchImplementation> all;
  for (const MethodDescription& description : method_descriptions()) {
    all.push_back(method_search(description.name));
    if (description.trackings_after_search > 0) all.push_back(method_search(description.name, 1));
  }
  return all;
}

SearchImplementation certified_search_from_scratch() {
  SearchImplementation search = method_search("certified", 0, {{"frame_coherence", false}});
  search.name = "certified-from-scratch";
  return search;
}

}  // namespace lmdbench::experiments
