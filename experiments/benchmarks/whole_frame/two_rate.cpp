// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/two_rate.h>

#include <benchmarks/whole_frame/implementation.h>
#include <benchmarks/whole_frame/rendered.h>

namespace lmdbench::experiments {
namespace {

/// Global and local thread of one method in turns, on the clock of the lockstep driver.
class TwoRateLoop : public FrameLoop {
 public:
  TwoRateLoop(const DrivenMethod& method, const RecordedPath& path)
      : path_(path), two_rate_(method.make(), method.make(), path.driver) {}

  void step(std::size_t frame) override {
    if (frame == 0) two_rate_.restart();
    two_rate_.step(static_cast<std::int64_t>(frame), path_.poses()[frame], *this);
  }
  double minimum_distance() const override { return lmdbench::minimum_distance(two_rate_.working_set()); }
  const LmdSet* lmds() const override {
    reported_ = within_cutoff(two_rate_.working_set(), path_.scene.cutoff);
    return &reported_;
  }

  // As observer of the clock it does nothing: the frame is timed as a whole.
  void search_starts(std::int64_t) {}
  template <typename Work>
  void run(Stage, Work&& work) {
    work(counters_);
  }
  void search_ends(const TwoRate::Search&) {}

 private:
  const RecordedPath& path_;
  TwoRate two_rate_;
  mutable LmdSet reported_;
  WorkCounters counters_;
};

}  // namespace

FrameImplementation rendered_tracking(const std::string& method) {
  return {method, method_description(method).promise, false, [method](const RecordedPath& path) {
            const DrivenMethod chosen = path.method(method);
            return std::make_unique<Rendered>(std::make_unique<TwoRateLoop>(chosen, path), chosen.profile,
                                              path);
          }};
}

}  // namespace lmdbench::experiments
