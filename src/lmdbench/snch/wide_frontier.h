// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/snch/wide_hierarchy.h>
#include <lmdbench/snch/wide_slack.h>
#include <lmdbench/snch/wide_traversal.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace lmdbench {

/// Sums of what the moving mesh has moved by, and how fast it does. The size of a motion depends on the point
/// c that it is measured at (wide_slack.h): near the contact it may be much less than at the mesh's centre.
/// So clocks run at a grid of points that move with the mesh, and everything is timed by the one nearest to
/// it.
class MotionClocks {
 public:
  static constexpr int GRID = 4;
  static constexpr std::size_t COUNT = GRID * GRID * GRID;

  /// @param moving the grid spans its bounding sphere's cube
  void reset(const WideHierarchy& moving, const RigidTransform& X_WM, const Pose& pose);
  /// Brings the clocks to a new pose. False where the pose jumps: the clocks are then reset.
  bool advance(const WideHierarchy& moving, const RigidTransform& X_WM, const Pose& pose, double rounding);

  std::size_t nearest(const Vec3& p_H) const;
  const Vec3& point(std::size_t clock) const { return points_[clock]; }

  double shift(std::size_t clock) const { return shifts_[clock]; }  ///< Sum of |dc| [m].
  double angle() const { return angle_; }                           ///< Sum of theta [rad].
  double shift_pace(std::size_t clock) const { return shift_paces_[clock]; }
  double angle_pace() const { return angle_pace_; }
  double largest_shift_pace() const { return largest_shift_pace_; }
  const std::array<double, COUNT>& shifts() const { return shifts_; }

 private:
  void place(const RigidTransform& X_WM, const Vec3& origin, std::array<Vec3, COUNT>& places) const;

  double step_ = 0.0;               ///< Distance of the grid's points [m].
  std::array<Vec3, COUNT> points_;  ///< In the moving hierarchy's frame.
  std::array<Vec3, COUNT> places_;  ///< In the world, at the last pose.
  std::array<double, COUNT> shifts_{}, shift_paces_{};
  double angle_ = 0.0, angle_pace_ = 0.0, largest_shift_pace_ = 0.0;
  Pose pose_;
};

/// When something must be done again: once shift(clock) + lever * angle() passes `size` or angle() passes
/// `angle`.
struct Expiry {
  std::uint32_t clock = 0;
  double lever = 0.0;
  double size = -std::numeric_limits<double>::infinity();
  double angle = std::numeric_limits<double>::infinity();

  bool is_due(const std::array<double, MotionClocks::COUNT>& shifts, double angle_sum) const {
    return static_cast<bool>(static_cast<int>(shifts[clock] + lever * angle_sum > size) |
                             static_cast<int>(angle_sum > angle));
  }
};

/// A traversal that is kept from frame to frame: the tests that were made, each with its expiry, and the
/// feature pairs that they let through. Completeness is that of find_wide_pairs: a lane that no kept test has
/// opened is rejected by one that has not expired.
class WideFrontier {
 public:
  /// Forgets everything.
  void clear();
  bool empty() const { return records_.empty(); }

  /// Finds the pairs anew, as find_wide_pairs does, and what they stand.
  void start(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
             const MotionClocks& clocks, double cutoff, WideCounters& counters);

  /// Brings the pairs to the pose that the clocks were brought to.
  void advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
               const MotionClocks& clocks, double cutoff, WideCounters& counters);

  /// Calls decide(pair, touches, lever) for every pair that is due; `touches` tells pairs of faces that may
  /// touch from pairs that may be LMDs. It returns the size, with that lever, of the motion before which the
  /// pair needs no decision; negative for the next frame whatever the motion.
  template <class Decide>
  void for_each_due(const MotionClocks& clocks, Decide&& decide) {
    list_due(leaf_expiries_, clocks);
    for (const std::uint32_t i : due_) {
      Expiry& expiry = leaf_expiries_[i];
      const double slack = decide(leaves_[i].pair, leaves_[i].touches, expiry.lever);
      expiry.size = slack < 0.0 ? -std::numeric_limits<double>::infinity()
                                : clocks.shift(expiry.clock) + expiry.lever * clocks.angle() + slack;
    }
  }

  std::size_t test_count() const { return records_.size() - free_records_.size(); }
  std::size_t pair_count() const { return leaves_.size() - free_leaves_.size(); }

 private:
  /// The children of a test, one of which is opened. Apart from the rest, which most repeated tests do not
  /// need.
  struct Slots {
    std::uint32_t a = 0, b = 0;
    bool operator==(const Slots&) const = default;
  };
  /// What a test let through.
  struct Record {
    bool in_use = false;
    std::uint32_t opened_lanes = 0;  ///< Lanes that have a record in `below`.
    std::uint32_t lmd_lanes = 0;     ///< Lanes that have a leaf in `below`.
    std::uint32_t touch_lanes = 0;   ///< Lanes that have a leaf in `touching`.
    std::array<std::uint32_t, WIDE_WIDTH> below{};
    std::array<std::uint32_t, WIDE_WIDTH> touching{};
  };
  struct Leaf {
    WidePair pair;
    bool touches;
  };
  /// What a call works on.
  struct Work {
    const WideHierarchy& a;
    const WideHierarchy& b;
    const WideQuery& query;
    const MotionClocks& clocks;
    double cutoff;
    float frames_per_radian;
    WideCounters& counters;
  };

  void add_record(const Work& work, std::uint32_t slot_a, std::uint32_t slot_b, std::uint32_t& index);
  std::uint32_t add_leaf(const Work& work, std::uint32_t slot_a, const WidePair& pair, bool touches);
  void drop_record(std::uint32_t record);
  void drop_leaf(std::uint32_t leaf);
  void request(const Work& work, std::uint32_t record);
  void make_requested_tests(const Work& work);
  void apply(const Work& work, const WideKeptTest& test);

  void list_due(const std::vector<Expiry>& expiries, const MotionClocks& clocks);

  std::vector<Slots> slots_;
  std::vector<Record> records_;
  std::vector<Expiry> record_expiries_;  ///< Free records never expire.
  std::vector<Leaf> leaves_;
  std::vector<Expiry> leaf_expiries_;
  std::vector<std::uint32_t> free_records_, free_leaves_, dropping_, due_;
  std::vector<WideKeptTest> requested_, batch_;
};

}  // namespace lmdbench
