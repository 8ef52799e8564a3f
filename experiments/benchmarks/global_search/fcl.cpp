// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <benchmarks/global_search/implementation.h>

namespace lmdbench::experiments {
namespace {

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

}  // namespace lmdbench::experiments
