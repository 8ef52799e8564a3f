// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <micro/global_search/implementation.h>

namespace lmdbench::micro {
namespace {

class FclCold : public GlobalSearch {
 public:
  explicit FclCold(const Scene& scene) : fcl_(scene.moving->surface(), {&scene.fixed.at(0)->surface()}) {}
  void run(const Pose& X_WM) override { result_ = fcl_.distance(X_WM); }
  double minimum_distance() const override { return result_.distance; }
  const LmdSet* lmds() const override { return nullptr; }

 private:
  FclCrosscheck fcl_;
  FclResult result_;
};

}  // namespace

/// FCL's nearest pair, every query from scratch: how FCL itself works.
SearchImplementation fcl_cold_search() {
  return {"fcl-cold", Exactness::MINIMUM_DISTANCE, false,
          [](const Scene& scene) { return std::make_unique<FclCold>(scene); }};
}

}  // namespace lmdbench::micro
