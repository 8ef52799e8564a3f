// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/realtime/driver.h>
#include <lmdbench/realtime/recorder.h>
#include <lmdbench/realtime/servo_caller.h>
#include <lmdbench/realtime/servo_role.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace lmdbench {
namespace {

constexpr std::int64_t MS = 1'000'000;              // ns
constexpr std::int64_t SCENE_PERIOD = 10 * MS;      // the recorder's: too short to fill the queue
constexpr std::int64_t LEAST_LISTED = MS / 2;       // between recorded turns of a free loop
constexpr std::int64_t START_AHEAD = 20 * MS;       // of the servo's first tick
constexpr std::int64_t NEIGHBOUR_PERIOD = 50 * MS;  // of a planted busy neighbour
constexpr int TRACKING_BELOW_SERVO = 10;            // in priority
constexpr std::size_t PRIMING_POSES = 20'000;       // path poses before the run: all of a recording
constexpr std::size_t LIST_ROWS = 1U << 16U;        // of LMD lists on their way to the recorder

/// Cores of the roles.
struct CorePlan {
  std::optional<int> servo, tracking, search, scene;
  std::vector<int> used;
};

/// The servo loop gets the last core, since interrupts use the first. Sharing: section 6.1.
CorePlan plan_cores(const RealtimeChoice& choice, bool tracks) {
  std::vector<int> cores = usable_cores();
  if (choice.cores && static_cast<std::size_t>(*choice.cores) < cores.size())
    cores.erase(cores.begin(), cores.end() - static_cast<std::ptrdiff_t>(*choice.cores));
  CorePlan plan;
  const std::size_t count = cores.size();
  const auto from_last = [&](std::size_t back) { return cores[count - 1 - std::min(back, count - 1)]; };
  plan.servo = from_last(0);
  if (tracks) {
    plan.tracking = from_last(count >= 4 ? 1 : 0);
    plan.search = from_last(count >= 4 ? 2 : 1);
    plan.scene = from_last(count >= 4 ? 3 : count >= 3 ? 2 : 1);
  } else {
    plan.scene = from_last(1);
  }
  for (const std::optional<int>& core : {plan.servo, plan.tracking, plan.search, plan.scene})
    if (core && std::find(plan.used.begin(), plan.used.end(), *core) == plan.used.end())
      plan.used.push_back(*core);
  if (!choice.pin) plan.servo = plan.tracking = plan.search = plan.scene = std::nullopt;
  return plan;
}

/// Pose `ahead` ns after the note, if the motion of the last two ticks goes on.
Pose predicted(const PoseNote& note, std::int64_t ahead) {
  if (note.since <= 0 || ahead <= 0) return note.pose;
  return extrapolated(note.before, note.pose, static_cast<double>(ahead) / static_cast<double>(note.since));
}

double seconds_between(std::int64_t begin, std::int64_t end) {
  return 1e-9 * static_cast<double>(end - begin);
}

void require_granted(const std::vector<Grant>& grants) {
  for (const Grant& grant : grants)
    if (!grant.granted)
      throw EnvironmentError("", "/driver/realtime/required",
                             fmt::format("{}: {} was refused: {}", grant.thread, grant.asked, grant.reason),
                             "permit it, or run without --require-realtime");
}

/// One method on the clock.
class MethodOnClock {
 public:
  MethodOnClock(const DrivenMethod& method, const DriverInput& input, const RealtimeSettings& settings,
                RunKeeper* keeper, std::size_t index)
      : input_(input),
        settings_(settings),
        choice_(settings.choice),
        profile_(method.profile),
        period_(std::llround(1e9 / input.frame_rate_hz)),
        frames_(static_cast<std::int64_t>(input.poses.size())),
        first_frames_(method.scene, input.motion),
        local_frames_(method.scene, input.motion),
        first_(method.make_for(first_frames_)),
        tracks_(first_->description().tracks_locally),
        local_(tracks_ ? method.make_for(local_frames_) : nullptr),
        aggregation_(*method.aggregation),
        cores_(plan_cores(choice_, tracks_)),
        kept_(static_cast<std::size_t>(frames_)),
        queues_(static_cast<std::size_t>(choice_.queue_ticks), LIST_ROWS),
        memory_(profile_.cutoff) {
    for (std::int64_t frame = 0; frame < frames_; ++frame)
      kept_[static_cast<std::size_t>(frame)] = input.keep_lmds && input.keep_lmds(frame) ? 1 : 0;
    recorder_ = std::make_unique<RealtimeRecorder>(queues_, method.label, frames_, input.loop.closed,
                                                   input.poses.front(), kept_, keeper, index);
    recorder_->clock.period = period_;
    recorder_->deforms = first_frames_.deforms();
  }

  /// @return false when `progress` stopped it
  bool run(const std::function<bool(std::int64_t frames)>& progress) {
    if (!prime(progress)) return false;
    const double stolen_before = stolen_seconds(cores_.used);
    std::vector<std::thread> threads;
    const auto start_thread = [&](auto body) {
      threads.emplace_back([this, body] {
        try {
          (this->*body)();
        } catch (...) {
          fail();
        }
      });
    };
    try {
      start_thread(&MethodOnClock::servo_thread);
      start_thread(&MethodOnClock::scene_thread);
      if (tracks_) {
        start_thread(&MethodOnClock::search_thread);
        start_thread(&MethodOnClock::tracking_thread);
      }
      if (choice_.plant.neighbour_busy_s > 0.0) start_thread(&MethodOnClock::neighbour_thread);
    } catch (...) {  // refused by the system: those that run have to end
      fail();
    }
    bool wanted = true;
    while (!servo_ended_ && !stop_) {
      sleep_until_ns(monotonic_ns() + 50 * MS);
      if (wanted && !progress(recorder_->frames_done())) {
        wanted = false;
        stop_ = true;
      }
    }
    for (std::thread& thread : threads) thread.join();
    recorder_->drain();
    if (error_) std::rethrow_exception(error_);
    recorder_->clock.stolen_s = stolen_seconds(cores_.used) - stolen_before;
    return wanted;
  }

  RealtimeRecorder& finished() {
    recorder_->finish();
    RealtimeRecord& clock = recorder_->clock;
    if (!tracks_) {
      const auto behind = [](const RoleRecord& role) {
        return role.name == "search" || role.name == "tracking";
      };
      clock.roles.erase(std::remove_if(clock.roles.begin(), clock.roles.end(), behind), clock.roles.end());
    }
    return *recorder_;
  }

 private:
  RoleRecord& role(RoleIndex index) { return recorder_->clock.roles[static_cast<std::size_t>(index)]; }

  /// Before the clock starts: allocates what is allocated once; the first tick finds a set.
  /// @return false when `progress` stopped it
  bool prime(const std::function<bool(std::int64_t frames)>& progress) {
    LmdSet lmds;
    WorkCounters ignored;
    if (!tracks_) {
      const std::size_t poses = std::min(input_.poses.size(), PRIMING_POSES);
      // In path order, since memory kept from frame to frame grows along the path. Twice, because
      // the return to the first pose is a jump, after which that memory is laid out anew.
      const auto search_at = [&](std::size_t i) {
        first_frames_.to_frame(static_cast<std::int64_t>(i));
        first_->search(input_.poses[i], lmds, ignored);
      };
      for (int round = 0; round < 2; ++round)
        for (std::size_t i = 0; i < poses; ++i) {
          if (!progress(0)) return false;
          search_at(i);
        }
      search_at(0);
      return true;
    }
    PoseNote note;
    note.pose = note.before = input_.poses.front();
    note.at = monotonic_ns();
    exchange_.pose_for_search.slot() = note;
    exchange_.pose_for_search.publish();
    exchange_.pose_for_tracking.slot() = note;
    exchange_.pose_for_tracking.publish();
    search_once({}, false);
    track_once(0);
    return true;
  }

  void fail() {
    const std::lock_guard lock(error_mutex_);
    if (!error_) error_ = std::current_exception();
    stop_ = true;
    release_start();
  }

  /// Gives the thread its policy.
  void take_policy(const std::string& name, const ThreadPolicy& policy) {
    touch_stack();
    const std::vector<Grant> grants = apply(policy, name);
    const std::lock_guard lock(error_mutex_);
    recorder_->clock.grants.insert(recorder_->clock.grants.end(), grants.begin(), grants.end());
    if (choice_.required) require_granted(grants);
  }

  void release_start() {
    std::int64_t unset = 0;
    start_.compare_exchange_strong(unset, -1);
    start_.notify_all();
  }
  std::int64_t wait_for_start() {
    start_.wait(0);
    return start_;
  }

  /// Stops where this is planted.
  void stand_still(const char* name) {
    if (choice_.plant.stopped_role != name || stood_still_ || monotonic_ns() < quarter()) return;
    stood_still_ = true;
    sleep_for_s(choice_.plant.stop_s);
  }
  std::int64_t quarter() const { return start_ + frames_ * period_ / 4; }
  void sleep_for_s(double seconds) const {
    sleep_until_ns(monotonic_ns() + static_cast<std::int64_t>(1e9 * seconds));
  }

  void servo_thread() {
    const ThreadPolicy policy{cores_.servo, choice_.priority};
    take_policy("servo", policy);
    RoleRecord& own = role(RoleIndex::SERVO);
    own.core = cores_.servo;
    const auto floor_ticks =
        std::max<std::int64_t>(std::llround(1e9 * choice_.floor_s / static_cast<double>(period_)), 1);
    recorder_->clock.floor_before = run_empty_loop(period_, floor_ticks);
    const std::int64_t start = monotonic_ns() + START_AHEAD;
    recorder_->clock.start = start;
    std::unique_ptr<ServoDevice> device;
    const double calls_a_period = choice_.caller == ServoCaller::CALLBACK
                                      ? 1e-9 * static_cast<double>(period_) * choice_.callback_rate_hz
                                      : 1.0;
    if (input_.loop.closed)
      device =
          std::make_unique<SimulatedServoDevice>(input_.loop, input_.poses, start, period_,
                                                 choice_.device_steps, calls_a_period, input_.reference_M);
    else
      device = std::make_unique<RecordedDevice>(input_.poses);
    ServoRole servo(profile_, aggregation_, input_, start, exchange_, queues_, *device, first_frames_,
                    tracks_ ? nullptr : first_.get(), kept_);
    start_ = start;
    start_.notify_all();
    bool begun = false;
    std::int64_t ran_until = start;
    const ServoTick tick = [&](const Tick& turn) {
      if (!begun) {
        begun = true;
        servo.begin();
      }
      if (turn.period >= frames_ || stop_.load(std::memory_order_relaxed)) {
        servo.end();
        ran_until = turn.woken;
        return false;
      }
      servo.tick(turn);
      return true;
    };
    if (choice_.caller == ServoCaller::CALLBACK) {
      DeviceScheduler scheduler;
      call_from_device(
          scheduler, choice_.callback_rate_hz, start, period_, [&] { apply(policy, "servo"); }, tick);
    } else {
      call_on_grid(start, period_, tick);
    }
    own.use = servo.use();
    own.turns = servo.ticks();
    own.lost = servo.lost();
    own.ran_ns = ran_until - start;
    stop_ = true;
    recorder_->clock.floor_after = run_empty_loop(period_, floor_ticks);
    servo_ended_ = true;
  }

  /// Calls turn(tick) on a grid, or without a pause, until the run is over.
  template <typename Turn>
  void loop(RoleIndex index, double rate_hz, std::int64_t offset, const Turn& turn) {
    const std::int64_t start = wait_for_start();
    if (start < 0) return;
    RoleRecord& own = role(index);
    const ThreadUse before = ThreadUse::now();
    std::optional<TickGrid> grid;
    if (rate_hz > 0.0) grid.emplace(start + offset, std::llround(1e9 / rate_hz));
    // A free loop does not wait for the start.
    const std::int64_t began = grid ? start : monotonic_ns();
    std::int64_t turns = 0;
    while (!stop_.load(std::memory_order_relaxed)) {
      Tick tick;
      if (grid)
        tick = grid->wait();
      else
        tick.asked = tick.woken = monotonic_ns();
      turn(tick);
      ++turns;
    }
    own.turns = turns;
    own.use = ThreadUse::now() - before;
    own.ran_ns = monotonic_ns() - began;
  }

  void search_thread() {
    take_policy("search", {cores_.search, 0});
    role(RoleIndex::SEARCH).core = cores_.search;
    loop(RoleIndex::SEARCH, choice_.search_rate_hz, 0, [&](const Tick& tick) {
      stand_still("search");
      search_once(tick, true);
    });
  }

  /// @param listed  whether to record it
  void search_once(const Tick& tick, bool listed) {
    exchange_.pose_for_search.fetch();
    const PoseNote note = exchange_.pose_for_search.value();
    const std::int64_t begin = monotonic_ns();
    const std::int64_t ahead = settings_.predict ? begin + last_search_ns_ - note.at : 0;
    const Pose pose = predicted(note, ahead);
    first_frames_.to_frame(note.period + std::max<std::int64_t>(ahead, 0) / period_);
    SearchTurn turn;
    SearchedSet& found = exchange_.searched.slot();
    first_->search(pose, found.lmds, turn.search.counters);
    const std::int64_t searched = monotonic_ns();
    turn.search.frame = note.period;
    turn.search.candidates = found.candidates = static_cast<std::int64_t>(found.lmds.size());
    turn.search_s = seconds_between(begin, searched);
    const int trackings = first_->description().trackings_after_search;
    if (trackings > 0) {
      first_->track(pose, found.lmds, turn.search.counters);
      turn.reduction_s = seconds_between(searched, monotonic_ns());
    }
    turn.search.kept_after_reduction = found.kept_after_reduction =
        static_cast<std::int64_t>(found.lmds.size());
    if (choice_.plant.search_sleep_s > 0.0 && listed) sleep_for_s(choice_.plant.search_sleep_s);
    // Decision E11: the later trackings of section 4.3 use the pose of their own time.
    if (trackings > 1) {
      exchange_.pose_for_search.fetch();
      const std::int64_t second = monotonic_ns();
      for (int i = 1; i < trackings; ++i)
        first_->track(exchange_.pose_for_search.value().pose, found.lmds, turn.search.counters);
      turn.second_s = seconds_between(second, monotonic_ns());
    }
    found.at = note.at;
    exchange_.searched.publish();
    const std::int64_t done = monotonic_ns();
    last_search_ns_ = done - begin;
    if (!listed) return;
    turn.turn = {tick, done, done - std::max<std::int64_t>(note.at, start_)};
    if (!queues_.searches.push(turn)) ++role(RoleIndex::SEARCH).lost;
  }

  void tracking_thread() {
    const double rate = choice_.tracking_rate_hz.value_or(input_.frame_rate_hz);
    // A free loop of real-time priority would block its core for all others.
    const int priority =
        rate > 0.0 && choice_.priority > 0 ? std::max(choice_.priority - TRACKING_BELOW_SERVO, 1) : 0;
    take_policy("tracking", {cores_.tracking, priority});
    role(RoleIndex::TRACKING).core = cores_.tracking;
    std::int64_t last_listed = 0;
    loop(RoleIndex::TRACKING, rate, period_ / 2, [&](const Tick& tick) {
      stand_still("tracking");
      const std::int64_t age = track_once(start_);
      if (tick.woken - last_listed < LEAST_LISTED) return;
      last_listed = tick.woken;
      if (!queues_.tracking.push({tick, monotonic_ns(), age})) ++role(RoleIndex::TRACKING).lost;
    });
  }

  /// @return age of the pose at the end of the update
  std::int64_t track_once(std::int64_t start) {
    if (exchange_.searched.fetch()) {
      const SearchedSet& searched = exchange_.searched.value();
      working_ = searched.lmds;
      candidates_ = searched.candidates;
      kept_after_reduction_ = searched.kept_after_reduction;
      searched_at_ = searched.at;
    }
    exchange_.pose_for_tracking.fetch();
    const PoseNote& note = exchange_.pose_for_tracking.value();
    const std::int64_t begin = monotonic_ns();
    std::int64_t ahead = 0;
    // The next servo tick uses the set.
    if (settings_.predict && start > 0) ahead = start + ((begin - start) / period_ + 1) * period_ - note.at;
    const Pose pose = predicted(note, ahead);
    const double following_s =
        local_frames_.to_frame(note.period + std::max<std::int64_t>(ahead, 0) / period_);
    TrackedSet& out = exchange_.tracked.slot();
    out.counters = {};
    local_->track(pose, working_, out.counters);
    out.update_s = seconds_between(begin, monotonic_ns());
    out.following_s = following_s;
    out.lmds.clear();
    for (const Lmd& lmd : working_)
      if (lmd.distance <= profile_.cutoff) out.lmds.push_back(lmd);
    std::stable_sort(out.lmds.begin(), out.lmds.end(), lmd_less);
    out.contact_without_direction = memory_.complete(out.lmds);
    out.tracked_count = static_cast<std::int64_t>(working_.size());
    out.candidates = candidates_;
    out.kept_after_reduction = kept_after_reduction_;
    out.at = note.at;
    out.searched_at = searched_at_;
    exchange_.tracked.publish();
    return monotonic_ns() - std::max(note.at, start);
  }

  void scene_thread() {
    take_policy("scene", {cores_.scene, 0});
    role(RoleIndex::SCENE).core = cores_.scene;
    bool stalled = choice_.plant.recorder_stall_s == 0.0;
    loop(RoleIndex::SCENE, 1e9 / SCENE_PERIOD, 0, [&](const Tick&) {
      if (!stalled && monotonic_ns() >= quarter()) {
        stalled = true;
        sleep_for_s(choice_.plant.recorder_stall_s);
      }
      recorder_->drain();
    });
  }

  void neighbour_thread() {
    take_policy("planted neighbour", {cores_.servo, choice_.priority});
    const std::int64_t start = wait_for_start();
    if (start < 0) return;
    TickGrid grid(start, NEIGHBOUR_PERIOD);
    while (!stop_) {
      const Tick tick = grid.wait();
      const std::int64_t end = tick.woken + static_cast<std::int64_t>(1e9 * choice_.plant.neighbour_busy_s);
      while (monotonic_ns() < end && !stop_) {
      }
    }
  }

  const DriverInput& input_;
  const RealtimeSettings& settings_;
  const RealtimeChoice& choice_;
  const ForceProfile profile_;
  const std::int64_t period_, frames_;
  SceneFrames first_frames_, local_frames_;  ///< Each in its own thread, as:
  std::unique_ptr<Method> first_;            ///< The search's; without another loop the servo's.
  const bool tracks_;
  std::unique_ptr<Method> local_;  ///< The tracking's.
  const Aggregation& aggregation_;
  const CorePlan cores_;
  std::vector<char> kept_;
  ServoExchange exchange_;
  RecordQueues queues_;
  std::unique_ptr<RealtimeRecorder> recorder_;

  // Used by the search alone.
  std::int64_t last_search_ns_ = 0;
  // Used by the tracking alone.
  LmdSet working_;
  std::int64_t candidates_ = 0, kept_after_reduction_ = 0, searched_at_ = 0;
  DirectionMemory memory_;

  bool stood_still_ = false;            ///< One role stops, once.
  std::atomic<std::int64_t> start_{0};  ///< 0: not yet; -1: never.
  std::atomic<bool> stop_{false}, servo_ended_{false};
  std::mutex error_mutex_;  ///< Before and after the run; loops never lock it.
  std::exception_ptr error_;
};

}  // namespace

RealtimeRun run_realtime(const std::vector<DrivenMethod>& methods, const DriverInput& input,
                         const RealtimeSettings& settings, const Progress& progress, RunKeeper* keeper) {
  const LockedMemory memory(settings.choice.lock_memory);
  if (settings.choice.required) require_granted(memory.grants());
  const auto frames = static_cast<std::int64_t>(input.poses.size());
  RealtimeRun run;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    MethodOnClock method(methods[i], input, settings, keeper, i);
    const auto tell = [&](std::int64_t done) {
      return !progress || progress(static_cast<std::int64_t>(i) * frames + done,
                                   static_cast<std::int64_t>(methods.size()) * frames);
    };
    if (!method.run(tell)) throw Interrupted();
    RealtimeRecorder& recorder = method.finished();
    RealtimeRecord& clock = recorder.clock;
    clock.grants.insert(clock.grants.begin(), memory.grants().begin(), memory.grants().end());
    run.records.push_back(std::move(recorder.record));
    run.clocks.push_back(std::move(clock));
  }
  return run;
}

}  // namespace lmdbench
