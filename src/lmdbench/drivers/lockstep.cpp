// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/own_time.h>
#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/drivers/direction_memory.h>
#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/drivers/planted_slowdown.h>
#include <lmdbench/drivers/render_movers.h>
#include <lmdbench/drivers/run_keeper.h>
#include <lmdbench/drivers/two_rate.h>
#include <lmdbench/lmd/method_description.h>

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

/// Seconds that `work` takes, but for those of others.
template <typename Work>
double timed(Work&& work, double planted_share) {
  seconds_of_others() = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  work();
  if (planted_share > 0.0) work_longer(begin, planted_share);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() -
         seconds_of_others();
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

/// One method in one repetition.
class MethodRun {
 public:
  MethodRun(const DrivenMethod& method, const DriverInput& input, const DriverChoice& driver)
      : input_(input),
        profile_(method.profile),
        bodies_(method.scene, input.motion),
        contacts_(*method.aggregation, bodies_.scene()),
        poses_(pose_source(input)),
        memory_(method.profile.cutoff),
        planted_(method.label) {
    std::unique_ptr<Method> first = method.make_for(bodies_);
    // The first repetition alone: the others leave the same.
    keeps_both_laws_ = input.keep_lmds && first->description().plugin.empty() &&
                       !first->description().tracks_locally &&
                       first->description().promise == Promise::COMPLETE_SET;
    if (first->description().tracks_locally)
      two_rate_.emplace(std::move(first), method.make_for(bodies_), driver);
    else
      every_frame_ = std::move(first);
    bodies_.prepare_to_deform();
    is_from_outside_ = every_frame_ && !every_frame_->description().plugin.empty();
    record_.label = method.label;
    record_.repetitions.resize(1);
    record_.frames.reserve(input.poses.size());
  }

  void step(std::int64_t frame) {
    FrameRecord result;
    frame_counters_ = &result.counters;
    const double following = bodies_.to_frame(frame);
    if (every_frame_) {
      found_.clear();
      run(Stage::LOCAL_UPDATE,
          [&](WorkCounters& counters) { contacts_.search(*every_frame_, pose(), found_, counters); });
      if (is_from_outside_) times().way.push_back(seconds_of_others());
      result.lmd_count_before_reduction = result.kept_after_reduction = static_cast<double>(found_.size());
      result.lmd_age = 0.0;
    } else {
      two_rate_->step(frame, pose(), *this);
      if (const auto& origin = two_rate_->origin()) {
        result.lmd_count_before_reduction = static_cast<double>(origin->candidates);
        result.kept_after_reduction = static_cast<double>(origin->kept_after_reduction);
        result.lmd_age = static_cast<double>(frame - origin->frame) / input_.frame_rate_hz;
      }
    }
    if (bodies_.deforms()) {
      times().local_update.back() += following;
      times().following.push_back(following);
    }
    finish_frame(frame, every_frame_ ? found_ : two_rate_->working_set(), std::move(result));
  }

  // As observer of the clock: times and counters of each stage.
  void look_at(std::int64_t frame) { bodies_.move_to_frame(frame); }
  void search_starts(std::int64_t frame) {
    search_changed_ = true;
    record_.searches.emplace_back().frame = frame;
    for (std::vector<double>* of_searches :
         {&times().global_search, &times().first_reduction, &times().second_tracking})
      of_searches->push_back(UNSET);
  }
  template <typename Work>
  void run(Stage stage, Work&& work) {
    if (stage == Stage::LOCAL_UPDATE) {
      times().local_update.push_back(timed([&] { work(*frame_counters_); }, planted_.share(stage)));
      return;
    }
    search_changed_ = true;
    // A search arrives before the next one starts, so all other stages belong to the last one.
    std::vector<double>& column = stage == Stage::GLOBAL_SEARCH     ? times().global_search
                                  : stage == Stage::FIRST_REDUCTION ? times().first_reduction
                                                                    : times().second_tracking;
    column.back() = timed([&] { work(record_.searches.back().counters); }, planted_.share(stage));
  }
  void search_ends(const TwoRate::Search& search) {
    record_.searches.back().candidates = search.candidates;
    record_.searches.back().kept_after_reduction = search.kept_after_reduction;
  }

  /// Keeps the last frame.
  void keep(RunKeeper& keeper, std::int64_t repetition, std::size_t method) {
    keeper.keep(repetition, method, record_, std::exchange(search_changed_, false));
  }

  MethodRecord take_record() {
    record_.result_hash = result_hash_.value();
    for (const SearchRecord& search : record_.searches) work_hash_.add(search.counters.values);
    record_.work_hash = work_hash_.value();
    return std::move(record_);
  }

 private:
  const Pose& pose() const { return poses_->pose(); }
  RepetitionTimes& times() { return record_.repetitions.front(); }

  /// From the working set to force, record and hash; not timed.
  void finish_frame(std::int64_t frame, const LmdSet& working, FrameRecord result) {
    LMDBENCH_ALWAYS(frame == static_cast<std::int64_t>(record_.frames.size()),
                    "a frame left out: every later row would be of another frame");
    LmdSet lmds = within_cutoff(working, profile_.cutoff);
    std::stable_sort(lmds.begin(), lmds.end(),
                     lmd_less);  // summation in an order that the scene alone decides
    result.contact_without_direction = memory_.complete(lmds);
    const Vec3 reference_W = RigidTransform(pose()).point(input_.reference_M);
    const Wrench wrench = contacts_.combine(lmds, profile_, reference_W, every_frame_.get());
    if (input_.motion.movers) finish_movers(*input_.motion.movers);
    const RenderedForce rendered = input_.device.render(wrench, profile_.largest_sum);
    result.force = rendered.force;
    result.force_clipped = rendered.clipped;
    result.force_above_continuous = rendered.exceeds_continuous_force;
    result.torque = wrench.torque;
    result.effective_stiffness = wrench.stiffness;
    result.lmd_count = static_cast<std::int64_t>(lmds.size());
    result.tracked_count = static_cast<std::int64_t>(working.size());
    result.minimum_distance = minimum_distance(lmds);
    result.lmds_without_index = contacts_.without_index(profile_.cutoff);

    for (int axis = 0; axis < 3; ++axis) result_hash_.add(result.force[axis]);
    result_hash_.add(result.lmd_count);
    for (const Lmd& lmd : lmds) {
      result_hash_.add(lmd.fixed_body);
      add_feature(result_hash_, lmd.feature_moving);
      add_feature(result_hash_, lmd.feature_fixed);
    }
    work_hash_.add(result.counters.values);
    if (keeps_both_laws_) keep_both_laws(lmds, reference_W, result);
    record_.frames.push_back(result);
    if (input_.keep_lmds && input_.keep_lmds(frame)) record_.lmds.emplace(frame, std::move(lmds));
    const Pose X_WM = poses_->pose();
    if (const std::optional<LoopFrame> moved = poses_->render(rendered)) {
      LMDBENCH_EXPECTS(record_.poses.size() == record_.loop.size(), "a loop that moved in some frames only");
      record_.poses.push_back(X_WM);
      record_.loop.push_back(*moved);
    }
  }

  /// What each mover feels of the set that was combined.
  void finish_movers(const MoverPlay& play) {
    const std::vector<MoverFrame> movers =
        render_movers(contacts_, bodies_.scene(), pose(), play, profile_, input_.device, every_frame_.get());
    for (const std::size_t number : play.number)
      for (int axis = 0; axis < 3; ++axis) result_hash_.add(movers[number].force[axis]);
    record_.movers.insert(record_.movers.end(), movers.begin(), movers.end());
  }

  void keep_both_laws(const LmdSet& lmds, const Vec3& reference_W, const FrameRecord& own) {
    for (const ForceLaw law : force_laws()) {
      ForceProfile profile = profile_;
      profile.law = law;
      Vec3 force = own.force;
      if (own.contact_without_direction > 0)
        force.setConstant(UNSET);  // no force is the true one
      else if (law != profile_.law)
        force =
            input_.device.render(contacts_.combine(lmds, profile, reference_W), profile.largest_sum).force;
      record_.force_by_law[static_cast<std::size_t>(law)].push_back(force);
    }
  }

  const DriverInput& input_;
  const ForceProfile profile_;
  SceneFrames bodies_;  ///< The method's own where they deform or others move.
  ContactFinder contacts_;
  std::unique_ptr<PoseSource> poses_;
  std::optional<TwoRate> two_rate_;      ///< Unset for a method without local tracking, ...
  std::unique_ptr<Method> every_frame_;  ///< ... which searches in every frame instead.
  DirectionMemory memory_;
  bool keeps_both_laws_ = false;
  bool is_from_outside_ = false;
  [[no_unique_address]] const PlantedSlowdown planted_;
  LmdSet found_;                            ///< Of `every_frame_`.
  WorkCounters* frame_counters_ = nullptr;  ///< Of the frame under way.
  bool search_changed_ = false;             ///< Since the last frame that was kept.
  MethodRecord record_;
  Hash result_hash_;
  Hash work_hash_;
};

void merge_repetition(MethodRecord& first, MethodRecord&& again, std::int64_t repetition) {
  const bool differs = again.result_hash != first.result_hash || again.work_hash != first.work_hash;
  if (differs && !first.repetitions.front().way.empty())
    ++first.other_repetitions;
  else if (differs)
    throw Error(ExitCode::INTERNAL, "", "method " + first.label,
                fmt::format("repetition {} left other {} than the first one", repetition,
                            again.result_hash != first.result_hash ? "forces or LMDs" : "work counters"),
                "results must not depend on the repetition: report this with the experiment file");
  first.repetitions.push_back(std::move(again.repetitions.front()));
}

/// Tells progress after blocks and between slow frames, so that a run can be stopped before long.
class Reporter {
 public:
  Reporter(const Progress& progress, std::int64_t total) : progress_(progress), total_(total) {}

  /// @param certainly  whatever the clock says
  void tell(std::int64_t done, bool certainly) {
    constexpr std::chrono::milliseconds LONGEST_SILENCE{100};
    if (!progress_) return;
    const auto now = std::chrono::steady_clock::now();
    if (!certainly && now - last_ < LONGEST_SILENCE) return;
    last_ = now;
    if (!progress_(done, total_)) throw Interrupted();
  }

 private:
  const Progress& progress_;
  std::int64_t total_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

std::vector<MethodRecord> run_lockstep(const std::vector<DrivenMethod>& methods, const DriverInput& input,
                                       const DriverChoice& driver, const Progress& progress,
                                       RunKeeper* keeper) {
  const std::int64_t frame_count = input.frames.value_or(static_cast<std::int64_t>(input.poses.size()));
  const auto method_count = static_cast<std::int64_t>(methods.size());
  const std::int64_t total = frame_count * method_count * driver.repetitions;
  std::vector<MethodRecord> records;
  std::int64_t done = 0;
  // Random: in a fixed order each method finds the same other one's caches. The same in every run:
  // only times depend on it.
  std::vector<std::size_t> turns(methods.size());
  std::iota(turns.begin(), turns.end(), std::size_t{0});
  std::mt19937 shuffled(0);
  DriverInput later_input =
      input;  // only the first repetition keeps LMD lists: the hash proves the others equal
  later_input.keep_lmds = nullptr;
  Reporter reporter(progress, total);
  for (std::int64_t repetition = 0; repetition < driver.repetitions; ++repetition) {
    // The first repetition is run in any case: what is no time comes from it.
    if (keeper != nullptr && repetition > 0 && keeper->knows_repetition(repetition)) {
      for (std::size_t i = 0; i < methods.size(); ++i) {
        records[i].repetitions.push_back(keeper->times(repetition, i, records[i].searches.size()));
        records[i].repetitions.back().way.assign(records[i].repetitions.front().way.size(), UNSET);
      }
      done += frame_count * method_count;
      continue;
    }
    std::vector<MethodRun> runs;
    runs.reserve(methods.size());
    for (const DrivenMethod& method : methods)
      runs.emplace_back(method, repetition == 0 ? input : later_input, driver);
    for (std::int64_t begin = 0; begin < frame_count; begin += driver.block_frames) {
      const std::int64_t end = std::min(begin + driver.block_frames, frame_count);
      std::shuffle(turns.begin(), turns.end(), shuffled);
      for (const std::size_t method : turns) {
        for (std::int64_t frame = begin; frame < end; ++frame) {
          runs[method].step(frame);
          if (keeper != nullptr) runs[method].keep(*keeper, repetition, method);
          reporter.tell(done + frame + 1 - begin, frame + 1 == end);
        }
        done += end - begin;
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
