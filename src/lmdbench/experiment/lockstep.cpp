// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/direction_memory.h>
#include <lmdbench/experiment/lockstep.h>
#include <lmdbench/force/aggregate.h>

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <chrono>
#include <optional>

namespace lmdbench {
namespace {

/// Seconds that `work` takes.
template <typename Work>
double timed(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Running XXH3 hash.
class Hash {
 public:
  Hash() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }
  template <typename Value>
  void add(const Value& value) {
    XXH3_64bits_update(state_.get(), &value, sizeof(value));
  }
  std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

void add_feature(Hash& hash, const FeatureId& feature) {
  hash.add(static_cast<std::int32_t>(feature.kind));
  hash.add(feature.index);
}

/// A search under way in the (simulated) global thread.
struct PendingSearch {
  LmdSet lmds;
  std::size_t index = 0;  ///< Into the record's searches.
  std::int64_t frame = 0;
};

/// One method in one repetition. The global and the local thread own an instance each, as real threads would.
class MethodRun {
 public:
  MethodRun(const LockstepMethod& method, const LockstepInput& input, const DriverChoice& driver)
      : input_(input),
        driver_(driver),
        profile_(method.profile),
        global_(method.make()),
        local_(method.make()),
        memory_(method.profile.cutoff) {
    record_.label = method.label;
    record_.repetitions.resize(1);
    record_.frames.reserve(input.poses.size());
  }

  void step(std::int64_t frame) {
    FrameRecord result;
    const Pose& X_WM = pose(frame);
    double seconds = 0.0;
    if (local_->tracks_locally()) {
      if (pending_ && frame == pending_->frame + driver_.search_latency_frames) receive(frame);
      if (frame % driver_.search_every_frames == 0) {
        start_search(frame);
        if (driver_.search_latency_frames == 0) receive(frame);
      }
      seconds = timed([&] { local_->track(X_WM, working_, result.counters); });
    } else {
      working_.clear();
      seconds = timed([&] { local_->search(X_WM, working_, result.counters); });
      candidates_ = static_cast<std::int64_t>(working_.size());
      searched_frame_ = frame;
    }
    times().local_update.push_back(seconds);
    finish_frame(frame, std::move(result));
  }

  MethodRecord take_record() {
    record_.result_hash = result_hash_.value();
    for (const SearchRecord& search : record_.searches) work_hash_.add(search.counters.values);
    record_.work_hash = work_hash_.value();
    return std::move(record_);
  }

 private:
  const Pose& pose(std::int64_t frame) const { return input_.poses[static_cast<std::size_t>(frame)]; }
  RepetitionTimes& times() { return record_.repetitions.front(); }

  void start_search(std::int64_t frame) {
    SearchRecord search;
    search.frame = frame;
    PendingSearch pending{{}, record_.searches.size(), frame};
    times().global_search.push_back(
        timed([&] { global_->search(pose(frame), pending.lmds, search.counters); }));
    search.candidates = static_cast<std::int64_t>(pending.lmds.size());
    double reduction = UNSET;
    if (global_->trackings_after_search() > 0)
      reduction = timed([&] { global_->track(pose(frame), pending.lmds, search.counters); });
    times().first_reduction.push_back(reduction);
    times().second_tracking.push_back(UNSET);
    search.kept_after_reduction = static_cast<std::int64_t>(pending.lmds.size());
    record_.searches.push_back(search);
    pending_ = std::move(pending);
  }

  /// Decision E11: the later trackings of section 4.3 run where the search ends,
  /// with the pose of that moment.
  void receive(std::int64_t frame) {
    SearchRecord& search = record_.searches[pending_->index];
    const int later_trackings = global_->trackings_after_search() - 1;
    if (later_trackings > 0) {
      times().second_tracking[pending_->index] = timed([&] {
        for (int i = 0; i < later_trackings; ++i)
          global_->track(pose(frame), pending_->lmds, search.counters);
      });
    }
    working_ = std::move(pending_->lmds);
    candidates_ = search.candidates;
    searched_frame_ = pending_->frame;
    pending_.reset();
  }

  /// From the working set to force, record and hash; not timed.
  void finish_frame(std::int64_t frame, FrameRecord result) {
    LmdSet lmds = within_cutoff(working_, profile_.cutoff);
    std::stable_sort(lmds.begin(), lmds.end(),
                     lmd_less);  // summation in an order that the scene alone decides
    result.contact_without_direction = memory_.complete(lmds);
    const Vec3 reference_W = RigidTransform(pose(frame)).point(input_.reference_M);
    const Wrench wrench = sum_forces(lmds, profile_, reference_W);
    const RenderedForce rendered = input_.device.render(wrench);
    result.force = rendered.force;
    result.force_clipped = rendered.clipped;
    result.force_above_continuous = rendered.exceeds_continuous_force;
    result.torque = wrench.torque;
    result.effective_stiffness = wrench.stiffness;
    result.lmd_count = static_cast<std::int64_t>(lmds.size());
    result.minimum_distance = minimum_distance(lmds);
    if (candidates_) result.lmd_count_before_reduction = static_cast<double>(*candidates_);
    if (searched_frame_)
      result.lmd_age = static_cast<double>(frame - *searched_frame_) / input_.frame_rate_hz;

    for (int axis = 0; axis < 3; ++axis) result_hash_.add(result.force[axis]);
    result_hash_.add(result.lmd_count);
    for (const Lmd& lmd : lmds) {
      result_hash_.add(lmd.fixed_body);
      add_feature(result_hash_, lmd.feature_moving);
      add_feature(result_hash_, lmd.feature_fixed);
    }
    work_hash_.add(result.counters.values);
    record_.frames.push_back(result);
    if (input_.keep_lmds && input_.keep_lmds(frame)) record_.lmds.emplace(frame, std::move(lmds));
  }

  const LockstepInput& input_;
  const DriverChoice& driver_;
  const ForceProfile profile_;
  std::unique_ptr<Method> global_;
  std::unique_ptr<Method> local_;
  DirectionMemory memory_;
  LmdSet working_;
  std::optional<PendingSearch> pending_;
  std::optional<std::int64_t> candidates_;      ///< Of the search that the working set comes from.
  std::optional<std::int64_t> searched_frame_;  ///< When that search started; unset before the first arrival.
  MethodRecord record_;
  Hash result_hash_;
  Hash work_hash_;
};

void merge_repetition(MethodRecord& first, MethodRecord&& again, std::int64_t repetition) {
  if (again.result_hash != first.result_hash || again.work_hash != first.work_hash)
    throw Error(ExitCode::INTERNAL, "", "method " + first.label,
                fmt::format("repetition {} left other {} than the first one", repetition,
                            again.result_hash != first.result_hash ? "forces or LMDs" : "work counters"),
                "results must not depend on the repetition: report this with the experiment file");
  first.repetitions.push_back(std::move(again.repetitions.front()));
}

}  // namespace

std::vector<MethodRecord> run_lockstep(const std::vector<LockstepMethod>& methods, const LockstepInput& input,
                                       const DriverChoice& driver, const Progress& progress) {
  const auto frame_count = static_cast<std::int64_t>(input.poses.size());
  const auto method_count = static_cast<std::int64_t>(methods.size());
  const std::int64_t total = frame_count * method_count * driver.repetitions;
  std::vector<MethodRecord> records;
  std::int64_t done = 0;
  LockstepInput later_input =
      input;  // only the first repetition keeps LMD lists: the hash proves the others equal
  later_input.keep_lmds = nullptr;
  for (std::int64_t repetition = 0; repetition < driver.repetitions; ++repetition) {
    std::vector<MethodRun> runs;
    runs.reserve(methods.size());
    for (const LockstepMethod& method : methods)
      runs.emplace_back(method, repetition == 0 ? input : later_input, driver);
    std::int64_t block = 0;
    for (std::int64_t begin = 0; begin < frame_count; begin += driver.block_frames, ++block) {
      const std::int64_t end = std::min(begin + driver.block_frames, frame_count);
      for (std::int64_t turn = 0; turn < method_count; ++turn) {
        const bool reversed = (repetition + block) % 2 != 0;  // ABBA
        MethodRun& run = runs[static_cast<std::size_t>(reversed ? method_count - 1 - turn : turn)];
        for (std::int64_t frame = begin; frame < end; ++frame) run.step(frame);
        done += end - begin;
        if (progress && !progress(done, total)) throw Interrupted();
      }
    }
    for (std::size_t i = 0; i < methods.size(); ++i) {
      MethodRecord record = runs[i].take_record();
      if (repetition == 0)
        records.push_back(std::move(record));
      else
        merge_repetition(records[i], std::move(record), repetition);
    }
  }
  return records;
}

}  // namespace lmdbench
