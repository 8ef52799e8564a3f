// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {
namespace {

class MethodSearch : public GlobalSearch {
 public:
  MethodSearch(const std::string& method, const Scene& scene, int trackings, const MethodOptions& options)
      : method_(make_method(method, scene, options)), cutoff_(scene.cutoff), trackings_(trackings) {}

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

std::unique_ptr<GlobalSearch> make_method_search(const std::string& method, const Scene& scene, int trackings,
                                                 const MethodOptions& options) {
  return std::make_unique<MethodSearch>(method, scene, trackings, options);
}

}  // namespace lmdbench::micro
