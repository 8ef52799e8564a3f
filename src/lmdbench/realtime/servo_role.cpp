// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregation.h>
#include <lmdbench/realtime/servo_clock.h>
#include <lmdbench/realtime/servo_role.h>

#include <algorithm>

namespace lmdbench {

ServoRole::ServoRole(const ForceProfile& profile, const Aggregation& aggregation, const DriverInput& input,
                     std::int64_t start, ServoExchange& exchange, RecordQueues& queues, ServoDevice& device,
                     SceneFrames& frames, Method* every_frame, const std::vector<char>& kept)
    : profile_(profile),
      input_(input),
      start_(start),
      exchange_(exchange),
      queues_(queues),
      device_(device),
      frames_(frames),
      every_frame_(every_frame),
      contacts_(aggregation, frames.scene()),
      kept_(kept),
      memory_(profile.cutoff) {
  memory_.reserve(LONGEST_SET);
  found_.reserve(LONGEST_SET);
}

void ServoRole::tell_pose(const Tick& tick, const Pose& pose) {
  const std::int64_t since = last_at_ > 0 ? tick.woken - last_at_ : 0;
  for (LatestValue<PoseNote>* reader : {&exchange_.pose_for_search, &exchange_.pose_for_tracking}) {
    reader->slot() = {pose, last_pose_, tick.woken, since, tick.period};
    reader->publish();
  }
  last_pose_ = pose;
  last_at_ = tick.woken;
}

const LmdSet& ServoRole::found_here(const Tick& tick, const Pose& pose) {
  FrameRecord& frame = record_.frame;
  const std::int64_t begin = monotonic_ns();
  record_.following_s = frames_.to_frame(tick.period);
  contacts_.search(*every_frame_, pose, found_, frame.counters);
  record_.update_s = 1e-9 * static_cast<double>(monotonic_ns() - begin);
  frame.lmd_count_before_reduction = frame.kept_after_reduction = static_cast<double>(found_.size());
  frame.tracked_count = static_cast<std::int64_t>(found_.size());
  found_.erase(std::remove_if(found_.begin(), found_.end(),
                              [&](const Lmd& lmd) { return !(lmd.distance <= profile_.cutoff); }),
               found_.end());
  frame.contact_without_direction = memory_.complete(found_);
  record_.set_age = record_.search_age = 0;
  return found_;
}

const LmdSet& ServoRole::set_in_use(const Tick& tick, const Pose& pose) {
  if (every_frame_ != nullptr) return found_here(tick, pose);
  const bool is_new = exchange_.tracked.fetch();
  const TrackedSet& set = exchange_.tracked.value();
  FrameRecord& frame = record_.frame;
  // An update's work is of the first frame that uses its set.
  if (is_new) frame.counters = set.counters;
  frame.lmd_count_before_reduction = static_cast<double>(set.candidates);
  frame.kept_after_reduction = static_cast<double>(set.kept_after_reduction);
  frame.tracked_count = set.tracked_count;
  frame.contact_without_direction = set.contact_without_direction;
  record_.update_s = is_new ? set.update_s : UNSET;
  record_.following_s = is_new ? set.following_s : UNSET;
  record_.set_age = tick.woken - std::max(set.at, start_);
  record_.search_age = tick.woken - std::max(set.searched_at, start_);
  return set.lmds;
}

void ServoRole::record_lists(std::int64_t frame, const LmdSet& lmds) {
  record_.list = TickRecord::NOT_ASKED;
  if (static_cast<std::size_t>(frame) >= kept_.size() || kept_[static_cast<std::size_t>(frame)] == 0) return;
  record_.list = TickRecord::NO_ROOM;
  if (queues_.lists.write_available() < lmds.size()) return;
  queues_.lists.push(lmds.begin(), lmds.end());
  record_.list = static_cast<std::int64_t>(lmds.size());
}

void ServoRole::tick(const Tick& tick) {
  const ServoWatch watch;
  record_.sequence = sequence_++;
  record_.tick = tick;
  FrameRecord& frame = record_.frame;
  frame = FrameRecord();
  const Pose& pose = device_.sense(tick.period, tick.woken);
  record_.pose = pose;
  if (every_frame_ == nullptr) tell_pose(tick, pose);
  const LmdSet& lmds = set_in_use(tick, pose);
  const Vec3 reference_W = RigidTransform(pose).point(input_.reference_M);
  const Wrench wrench = contacts_.combine(lmds, profile_, reference_W, every_frame_);
  const RenderedForce rendered = input_.device.render(wrench, profile_.largest_sum);
  const std::int64_t ready = monotonic_ns();
  device_.render(rendered, ready);
  record_.done = ready;

  frame.force = rendered.force;
  frame.force_clipped = rendered.clipped;
  frame.force_above_continuous = rendered.exceeds_continuous_force;
  frame.torque = wrench.torque;
  frame.effective_stiffness = wrench.stiffness;
  frame.lmd_count = static_cast<std::int64_t>(lmds.size());
  frame.lmds_without_index = contacts_.without_index(profile_.cutoff);
  frame.minimum_distance = minimum_distance(lmds);
  frame.lmd_age = 1e-9 * static_cast<double>(record_.search_age);
  if (const LoopFrame* moved = device_.moved()) record_.loop = *moved;
  // A list is recorded with its tick only: without room for the tick it is dropped.
  if (queues_.ticks.write_available() == 0) {
    ++lost_;
    return;
  }
  record_lists(tick.period, lmds);
  queues_.ticks.push(record_);
}

}  // namespace lmdbench
