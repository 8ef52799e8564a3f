// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/run_keeper.h>
#include <lmdbench/realtime/recorder.h>

#include <algorithm>

namespace lmdbench {
namespace {

RoleRecord& role_of(RealtimeRecord& clock, RoleIndex index) {
  return clock.roles[static_cast<std::size_t>(index)];
}

LoopFrame at_rest(const Pose& X_WM) {
  LoopFrame frame;
  frame.position = X_WM.translation;
  frame.orientation = X_WM.rotation;
  return frame;
}

void add_turn(RoleRecord& role, const RoleTurn& turn) {
  role.times.add(turn.tick, turn.done);
  role.age.push_back(turn.age);
}

}  // namespace

RealtimeRecorder::RealtimeRecorder(RecordQueues& queues, const std::string& label, std::int64_t frames,
                                   bool closed_loop, const Pose& start, const std::vector<char>& kept,
                                   RunKeeper* keeper, std::size_t method)
    : queues_(queues),
      frames_(frames),
      closed_loop_(closed_loop),
      kept_(kept),
      keeper_(keeper),
      method_(method) {
  held_.pose = start;
  held_.loop = at_rest(start);
  record.label = clock.label = label;
  record.repetitions.resize(1);
  record.frames.reserve(static_cast<std::size_t>(frames));
  for (const char* name : {"servo", "search", "tracking", "scene"}) {
    clock.roles.emplace_back();
    clock.roles.back().name = name;
  }
}

void RealtimeRecorder::drain() {
  SearchTurn search;
  while (queues_.searches.pop(search)) note_search(search);
  RoleTurn turn;
  while (queues_.tracking.pop(turn)) add_turn(role_of(clock, RoleIndex::TRACKING), turn);
  TickRecord tick;
  while (queues_.ticks.pop(tick)) take(tick);
}

void RealtimeRecorder::note_search(const SearchTurn& search) {
  add_turn(role_of(clock, RoleIndex::SEARCH), search.turn);
  // The record has at most one search a frame; the clock's record has all.
  const std::int64_t last = !waiting_.empty()          ? waiting_.back().search.frame
                            : !record.searches.empty() ? record.searches.back().frame
                                                       : -1;
  if (search.search.frame > last && search.search.frame < frames_) waiting_.push_back(search);
}

void RealtimeRecorder::take(const TickRecord& tick) {
  const bool lost = tick.sequence != next_sequence_;
  next_sequence_ = tick.sequence + 1;
  const std::int64_t frame = tick.tick.period;
  hold_until(frame, lost ? FrameSource::LOST : FrameSource::SKIPPED);
  add_turn(role_of(clock, RoleIndex::SERVO), {tick.tick, tick.done, tick.set_age});
  clock.search_age.push_back(tick.search_age);
  clock.tick_frame.push_back(frame);
  take_list(tick);
  held_ = tick;
  // A device faster than the grid gives a period two ticks: the first one is the frame, and what is
  // held from there on is the second one's.
  if (static_cast<std::int64_t>(record.frames.size()) > frame) return;
  record.frames.push_back(tick.frame);
  note_times(tick.update_s, tick.following_s);
  if (closed_loop_) {
    record.poses.push_back(tick.pose);
    record.loop.push_back(tick.loop);
  }
  if (tick.list >= 0) record.lmds.emplace(frame, last_list_);
  clock.frame_source.push_back(FrameSource::TICK);
  frame_complete();
}

void RealtimeRecorder::note_times(double update_s, double following_s) {
  record.repetitions.front().local_update.push_back(update_s);
  if (deforms) record.repetitions.front().following.push_back(following_s);
}

void RealtimeRecorder::take_list(const TickRecord& tick) {
  if (tick.list == TickRecord::NO_ROOM) ++clock.lmd_lists_lost;
  if (tick.list < 0) return;
  last_list_.clear();
  Lmd lmd;
  for (std::int64_t i = 0; i < tick.list && queues_.lists.pop(lmd); ++i) last_list_.push_back(lmd);
}

void RealtimeRecorder::hold_until(std::int64_t frame, FrameSource source) {
  const double period_s = 1e-9 * static_cast<double>(clock.period);
  while (static_cast<std::int64_t>(record.frames.size()) < std::min(frame, frames_)) {
    const auto at = record.frames.size();
    held_.frame.counters = {};
    held_.frame.lmd_age += period_s;
    record.frames.push_back(held_.frame);
    note_times(UNSET, UNSET);
    if (closed_loop_) {
      record.poses.push_back(held_.pose);
      record.loop.push_back(held_.loop);
    }
    // What the device held is known if the previous tick gave its list.
    if (source == FrameSource::SKIPPED && held_.list >= 0 && kept_[at] != 0)
      record.lmds.emplace(static_cast<std::int64_t>(at), last_list_);
    clock.frame_source.push_back(source);
    frame_complete();
  }
}

void RealtimeRecorder::frame_complete() {
  const bool has_search = !waiting_.empty();
  if (has_search) {
    const SearchTurn& search = waiting_.front();
    record.searches.push_back(search.search);
    RepetitionTimes& times = record.repetitions.front();
    times.global_search.push_back(search.search_s);
    times.first_reduction.push_back(search.reduction_s);
    times.second_tracking.push_back(search.second_s);
    waiting_.pop_front();
  }
  if (keeper_ != nullptr) keeper_->keep(0, method_, record, has_search);
  done_.store(static_cast<std::int64_t>(record.frames.size()), std::memory_order_relaxed);
}

void RealtimeRecorder::finish() {
  drain();
  hold_until(frames_, FrameSource::SKIPPED);
}

}  // namespace lmdbench
