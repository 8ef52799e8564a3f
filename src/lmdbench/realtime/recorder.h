// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/drivers/records.h>
#include <lmdbench/realtime/exchange.h>
#include <lmdbench/realtime/record.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace lmdbench {

/// The queues that end at the recorder.
struct RecordQueues {
  RecordQueues(std::size_t length, std::size_t list_rows)
      : ticks(length), lists(list_rows), tracking(length), searches(length) {}

  RecordQueue<TickRecord> ticks;
  RecordQueue<Lmd> lists;  ///< Rows of the LMD lists, tick after tick.
  RecordQueue<RoleTurn> tracking;
  RecordQueue<SearchTurn> searches;
};

/// Builds the record of a run from the queues, during the run.
class RealtimeRecorder {
 public:
  /// @param frames  of the path
  /// @param start   X_WM before the first tick
  /// @param kept    by frame, whether to keep its LMD list
  RealtimeRecorder(RecordQueues& queues, const std::string& label, std::int64_t frames, bool closed_loop,
                   const Pose& start, const std::vector<char>& kept, RunKeeper* keeper, std::size_t method);

  /// Takes all that has arrived.
  void drain();
  /// Takes the rest and fills gaps.
  void finish();

  std::int64_t frames_done() const { return done_.load(std::memory_order_relaxed); }

  bool deforms = false;  ///< Whether meshes deform: records their following times.
  MethodRecord record;
  RealtimeRecord clock;  ///< Roles by RoleIndex.

 private:
  void take(const TickRecord& tick);
  void note_times(double update_s, double following_s);
  void take_list(const TickRecord& tick);
  void hold_until(std::int64_t frame, FrameSource source);
  void frame_complete();
  void note_search(const SearchTurn& search);

  RecordQueues& queues_;
  std::int64_t frames_;
  bool closed_loop_;
  const std::vector<char>& kept_;
  RunKeeper* keeper_;
  std::size_t method_;
  std::int64_t next_sequence_ = 0;
  std::deque<SearchTurn> waiting_;  ///< Not yet in the record: one a frame.
  TickRecord held_;                 ///< The last tick, with the age of what is held since.
  LmdSet last_list_;
  std::atomic<std::int64_t> done_{0};
};

}  // namespace lmdbench
