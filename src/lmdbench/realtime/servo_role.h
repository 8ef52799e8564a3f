// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/drivers/direction_memory.h>
#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/realtime/recorder.h>
#include <lmdbench/realtime/servo_device.h>
#include <lmdbench/realtime/thread_use.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Exchange between the servo loop and the two loops behind it.
struct ServoExchange {
  LatestValue<PoseNote> pose_for_search, pose_for_tracking;
  LatestValue<SearchedSet> searched;
  LatestValue<TrackedSet> tracked;
};

/// The servo loop's body (driver.h).
class ServoRole {
 public:
  /// @param start        of the grid [ns]; before it the mesh is at its first pose
  /// @param every_frame  a method that searches in every frame, or nullptr: sets by `exchange`
  /// @param kept         by frame, whether to keep its LMD list
  /// @param frames       the scene of that method; otherwise one used here alone
  ServoRole(const ForceProfile& profile, const Aggregation& aggregation, const DriverInput& input,
            std::int64_t start, ServoExchange& exchange, RecordQueues& queues, ServoDevice& device,
            SceneFrames& frames, Method* every_frame, const std::vector<char>& kept);

  /// For sets up to LONGEST_SET, aggregation `sum` and one rigid moving mesh, it allocates, locks,
  /// writes and faults in nothing. Saddles, several movers and changing shapes take memory.
  void tick(const Tick& tick);

  /// Called before the first tick and after the last one, in their thread.
  void begin() { first_use_ = ThreadUse::now(); }
  void end() { last_use_ = ThreadUse::now(); }
  ThreadUse use() const { return last_use_ - first_use_; }
  std::int64_t ticks() const { return sequence_; }
  std::int64_t lost() const { return lost_; }

  /// LMDs of a set whose memory is reserved from the start.
  static constexpr std::size_t LONGEST_SET = 4096;

 private:
  void tell_pose(const Tick& tick, const Pose& pose);
  /// The set for this tick's force.
  const LmdSet& set_in_use(const Tick& tick, const Pose& pose);
  const LmdSet& found_here(const Tick& tick, const Pose& pose);
  void record_lists(std::int64_t frame, const LmdSet& lmds);

  const ForceProfile profile_;
  const DriverInput& input_;
  const std::int64_t start_;
  ServoExchange& exchange_;
  RecordQueues& queues_;
  ServoDevice& device_;
  SceneFrames& frames_;
  Method* every_frame_;
  ContactFinder contacts_;
  const std::vector<char>& kept_;
  DirectionMemory memory_;
  LmdSet found_;
  TickRecord record_;
  Pose last_pose_;
  std::int64_t last_at_ = 0;
  std::int64_t sequence_ = 0, lost_ = 0;
  ThreadUse first_use_, last_use_;
};

}  // namespace lmdbench
