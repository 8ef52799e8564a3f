// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/whole_frame/implementation.h>
#include <micro/whole_frame/rendered.h>

#include <optional>
#include <utility>

namespace lmdbench::micro {
namespace {

/// Global and local thread of one method in turns, on the clock of the lockstep driver
/// (experiment/lockstep.h).
class TwoRate : public FrameLoop {
 public:
  TwoRate(const LockstepMethod& method, const RecordedPath& path)
      : path_(path), global_(method.make()), local_(method.make()) {}

  void step(std::size_t frame) override {
    const Pose& X_WM = path_.poses()[frame];
    const auto now = static_cast<std::int64_t>(frame);
    if (frame == 0) {
      pending_.reset();
      working_.clear();
    }
    if (pending_ && now == pending_->frame + path_.driver.search_latency_frames) receive(X_WM);
    if (now % path_.driver.search_every_frames == 0) {
      search(X_WM, now);
      if (path_.driver.search_latency_frames == 0) receive(X_WM);
    }
    local_->track(X_WM, working_, counters_);
  }
  double minimum_distance() const override { return lmdbench::minimum_distance(working_); }
  const LmdSet* lmds() const override {
    reported_ = within_cutoff(working_, path_.scene.cutoff);
    return &reported_;
  }

 private:
  struct Pending {
    LmdSet lmds;
    std::int64_t frame;
  };

  void search(const Pose& X_WM, std::int64_t frame) {
    pending_ = Pending{{}, frame};
    global_->search(X_WM, pending_->lmds, counters_);
    if (global_->trackings_after_search() > 0) global_->track(X_WM, pending_->lmds, counters_);
  }

  void receive(const Pose& X_WM) {
    for (int i = 1; i < global_->trackings_after_search(); ++i)
      global_->track(X_WM, pending_->lmds, counters_);
    working_ = std::move(pending_->lmds);
    pending_.reset();
  }

  const RecordedPath& path_;
  std::unique_ptr<Method> global_, local_;
  std::optional<Pending> pending_;
  LmdSet working_;
  mutable LmdSet reported_;
  WorkCounters counters_;
};

}  // namespace

FrameImplementation rendered_tracking(const std::string& label) {
  return {label, Exactness::APPROXIMATE, false, [label](const RecordedPath& path) {
            const LockstepMethod& method = path.method(label);
            return std::make_unique<Rendered>(std::make_unique<TwoRate>(method, path), method.profile, path);
          }};
}

}  // namespace lmdbench::micro
