// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>

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

class FclSearch : public GlobalSearch {
 public:
  FclSearch(const Scene& scene, bool warm)
      : fcl_(scene.moving->surface(), {&scene.fixed.at(0)->surface()}), warm_(warm) {}
  void run(const Pose& X_WM) override { result_ = warm_ ? fcl_.distance_warm(X_WM) : fcl_.distance(X_WM); }
  double minimum_distance() const override { return result_.distance; }
  const LmdSet* lmds() const override { return nullptr; }

 private:
  FclCrosscheck fcl_;
  bool warm_;
  FclResult result_;
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

/// FCL's nearest pair, each query from scratch, as FCL itself works.
SearchImplementation fcl_cold_search() {
  return {"fcl-cold", Promise::NEAREST_PAIR, false,
          [](const Scene& scene) { return std::make_unique<FclSearch>(scene, false); }};
}

/// FCL's nearest pair, each query seeded with the last pair's distance. At unrelated poses the seed
/// is a poor bound; on a path it halves the time.
SearchImplementation fcl_warm_search() {
  return {"fcl-warm", Promise::NEAREST_PAIR, false,
          [](const Scene& scene) { return std::make_unique<FclSearch>(scene, true); }};
}

std::vector<SearchImplementation> search_implementations() {
  std::vector<SearchImplementation> all = method_searches();
  all.push_back(certified_search_from_scratch());
  all.push_back(fcl_cold_search());
  all.push_back(fcl_warm_search());
#ifdef LMDBENCH_HAS_EMBREE
  all.push_back(embree_search());
#endif
  return all;
}

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
