// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/motion/interpolate.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace lmdbench {

/// What runs on the two-rate clock.
enum class Stage : std::uint8_t { GLOBAL_SEARCH, FIRST_REDUCTION, SECOND_TRACKING, LOCAL_UPDATE };

/// The clock of lockstep.h, steps 1 to 3: when a global search starts, when its set arrives, and
/// what is tracked in between. The global and the local thread own an instance of the method each.
/// Runs and benchmarks share it and measure as observers:
/// - `observer.search_starts(frame)` before a search;
/// - `observer.run(stage, work)` must call `work(counters)` once, with the WorkCounters to add to;
/// - `observer.search_ends(search)` after the first reduction;
/// - `observer.look_at(frame)`, if it exists, moves other movers to their place in a frame. With
///   prediction (the paper's future work) a search and its first reduction take the pose that the
///   mesh will have at arrival if it goes on as in the last frame.
class TwoRate {
 public:
  /// Where a working set comes from.
  struct Search {
    std::int64_t frame = 0;                 ///< Frame that the search started in.
    std::int64_t candidates = 0;            ///< LMDs that it found.
    std::int64_t kept_after_reduction = 0;  ///< LMDs left by the first tracking; all without one.
  };

  TwoRate(std::unique_ptr<Method> global, std::unique_ptr<Method> local, const DriverChoice& driver)
      : every_(driver.search_every_frames),
        latency_(driver.search_latency_frames),
        predicts_(driver.predict),
        global_(std::move(global)),
        local_(std::move(local)) {}

  /// One haptic frame; frames come in ascending order.
  template <typename Observer>
  void step(std::int64_t frame, const Pose& X_WM, Observer& observer) {
    LMDBENCH_EXPECTS(frame >= 0 && (!pending_ || frame <= pending_->search.frame + latency_),
                     "frames out of order: the search under way would never arrive");
    if (pending_ && frame == pending_->search.frame + latency_) receive(X_WM, observer);
    if (frame % every_ == 0) {
      const bool ahead = predicts_ && last_pose_;
      if (ahead) look_at(frame + latency_, observer);
      search(frame, ahead ? extrapolated(*last_pose_, X_WM, static_cast<double>(latency_)) : X_WM, observer);
      if (ahead) look_at(frame, observer);
      if (latency_ == 0) receive(X_WM, observer);
    }
    observer.run(Stage::LOCAL_UPDATE,
                 [&](WorkCounters& counters) { local_->track(X_WM, working_, counters); });
    last_pose_ = X_WM;
  }

  /// As before the first frame.
  void restart() {
    pending_.reset();
    origin_.reset();
    last_pose_.reset();
    working_.clear();
  }

  const LmdSet& working_set() const { return working_; }
  /// Search that the working set comes from; unset before the first arrival.
  const std::optional<Search>& origin() const { return origin_; }

 private:
  struct Pending {
    LmdSet lmds;
    Search search;
  };

  template <typename Observer>
  static void look_at(std::int64_t frame, Observer& observer) {
    if constexpr (requires { observer.look_at(frame); }) observer.look_at(frame);
  }

  template <typename Observer>
  void search(std::int64_t frame, const Pose& X_WM, Observer& observer) {
    pending_ = Pending{{}, {.frame = frame}};
    LmdSet& lmds = pending_->lmds;
    Search& search = pending_->search;
    observer.search_starts(frame);
    observer.run(Stage::GLOBAL_SEARCH,
                 [&](WorkCounters& counters) { global_->search(X_WM, lmds, counters); });
    search.candidates = static_cast<std::int64_t>(lmds.size());
    if (global_->description().trackings_after_search > 0)
      observer.run(Stage::FIRST_REDUCTION,
                   [&](WorkCounters& counters) { global_->track(X_WM, lmds, counters); });
    search.kept_after_reduction = static_cast<std::int64_t>(lmds.size());
    observer.search_ends(search);
  }

  /// Decision E11: the later trackings of section 4.3 run where the search ends, at that pose.
  template <typename Observer>
  void receive(const Pose& X_WM, Observer& observer) {
    const int later_trackings = global_->description().trackings_after_search - 1;
    if (later_trackings > 0) {
      observer.run(Stage::SECOND_TRACKING, [&](WorkCounters& counters) {
        for (int i = 0; i < later_trackings; ++i) global_->track(X_WM, pending_->lmds, counters);
      });
    }
    working_ = std::move(pending_->lmds);
    origin_ = pending_->search;
    pending_.reset();
  }

  std::int64_t every_;
  std::int64_t latency_;
  bool predicts_;
  std::unique_ptr<Method> global_;
  std::unique_ptr<Method> local_;
  LmdSet working_;
  std::optional<Pending> pending_;
  std::optional<Pose> last_pose_;  ///< Of the frame before.
  std::optional<Search> origin_;
};

}  // namespace lmdbench
