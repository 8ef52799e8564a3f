// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/realtime/latest_value.h>
#include <lmdbench/realtime/servo_clock.h>

// Its own atomics are assembler, which the thread sanitizer cannot see.
#define BOOST_LOCKFREE_FORCE_STD_ATOMIC
#include <boost/lockfree/spsc_queue.hpp>

#include <cstddef>
#include <cstdint>

/// What the roles of driver.h hand to each other.
namespace lmdbench {

/// The mesh at a tick. [ns]
struct PoseNote {
  Pose pose, before;        ///< X_WM at this tick and at the one before.
  std::int64_t at = 0;      ///< When it was sensed.
  std::int64_t since = 0;   ///< How long after the one before; 0: there is none.
  std::int64_t period = 0;  ///< Servo period that it belongs to.
};

/// What a search found.
struct SearchedSet {
  LmdSet lmds;
  std::int64_t candidates = 0;
  std::int64_t at = 0;  ///< When its pose was sensed.
};

/// A set as the servo loop takes it: within the cutoff, sorted, every LMD with the direction that it has (E12).
struct TrackedSet {
  LmdSet lmds;
  std::int64_t at = 0;           ///< When the pose was sensed that it was tracked to.
  std::int64_t searched_at = 0;  ///< When the pose was sensed that it was searched at.
  std::int64_t candidates = 0;
  std::int64_t tracked_count = 0;
  std::int64_t contact_without_direction = 0;
  double update_s = UNSET, following_s = 0.0;
  WorkCounters counters;
};

/// A tick on its way to the recorder.
struct TickRecord {
  std::int64_t sequence = 0;  ///< Of the tick: a gap tells what was lost.
  Tick tick;
  std::int64_t done = 0;  ///< The device has the force.
  std::int64_t set_age = 0, search_age = 0;
  double update_s =
      UNSET;  ///< Of the update that the set comes from; of a method without tracking, of its search.
  double following_s = 0.0;  ///< The part of it in which meshes that deform followed.
  FrameRecord frame;
  Pose pose;
  LoopFrame loop;
  std::int64_t list =
      NOT_ASKED;  ///< LMDs of this tick that wait in the queue of lists, or why there are none.

  static constexpr std::int64_t NOT_ASKED = -1, NO_ROOM = -2;
};

/// A turn of another role.
struct RoleTurn {
  Tick tick;
  std::int64_t done = 0;
  std::int64_t age = 0;  ///< Of the pose that it worked on, when it was done.
};

/// A turn of the search.
struct SearchTurn {
  RoleTurn turn;
  SearchRecord search;
  double search_s = UNSET, reduction_s = UNSET, second_s = UNSET;
};

/// A queue of fixed length without locks, one writer, one reader. Every place of it was written once before the first tick.
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
