// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/realtime/latest_value.h>
#include <lmdbench/realtime/servo_clock.h>

// Boost's own atomics are assembler, which the thread sanitizer cannot see.
#define BOOST_LOCKFREE_FORCE_STD_ATOMIC
#include <boost/lockfree/spsc_queue.hpp>

#include <cstddef>
#include <cstdint>

/// Values that the roles of driver.h exchange.
namespace lmdbench {

/// The mesh at a tick. [ns]
struct PoseNote {
  Pose pose, before;        ///< X_WM at this tick and at the one before.
  std::int64_t at = 0;      ///< When it was sensed.
  std::int64_t since = 0;   ///< Time since the one before; 0: there is none.
  std::int64_t period = 0;  ///< Its servo period.
};

/// Result of a search.
struct SearchedSet {
  LmdSet lmds;
  std::int64_t candidates = 0, kept_after_reduction = 0;
  std::int64_t at = 0;  ///< When its pose was sensed.
};

/// A set as the servo loop takes it: in the cutoff, sorted, with the directions in use (E12).
struct TrackedSet {
  LmdSet lmds;
  std::int64_t at = 0;           ///< Sensing time of the pose tracked to.
  std::int64_t searched_at = 0;  ///< Sensing time of the pose searched at.
  std::int64_t candidates = 0, kept_after_reduction = 0;
  std::int64_t tracked_count = 0;
  std::int64_t contact_without_direction = 0;
  double update_s = UNSET, following_s = 0.0;
  WorkCounters counters;
};

/// A tick on its way to the recorder.
struct TickRecord {
  std::int64_t sequence = 0;  ///< Number of the tick: a gap shows losses.
  Tick tick;
  std::int64_t done = 0;  ///< When the device had the force.
  std::int64_t set_age = 0, search_age = 0;
  double update_s = UNSET;   ///< Of the set's update; without tracking, of its search.
  double following_s = 0.0;  ///< Part in which deforming meshes followed.
  FrameRecord frame;
  Pose pose;
  LoopFrame loop;
  std::int64_t list = NOT_ASKED;  ///< LMDs of this tick in the list queue, or why none.

  static constexpr std::int64_t NOT_ASKED = -1, NO_ROOM = -2;
};

/// A turn of another role.
struct RoleTurn {
  Tick tick;
  std::int64_t done = 0;
  std::int64_t age = 0;  ///< Of its pose, at the end of the turn.
};

/// A turn of the search.
struct SearchTurn {
  RoleTurn turn;
  SearchRecord search;
  double search_s = UNSET, reduction_s = UNSET, second_s = UNSET;
};

/// A lock-free queue of fixed length, one writer, one reader; all memory is touched beforehand.
template <typename Value>
class RecordQueue : public boost::lockfree::spsc_queue<Value> {
 public:
  explicit RecordQueue(std::size_t length) : boost::lockfree::spsc_queue<Value>(length) {
    for (std::size_t i = 0; i < length; ++i) this->push(Value());
    Value out;
    while (this->pop(out)) {
    }
  }
};

}  // namespace lmdbench
