// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/methods/certified/keep/certificate.h>
#include <lmdbench/methods/certified/keep/certificate_queue.h>
#include <lmdbench/methods/certified/keep/motion_forecast.h>
#include <lmdbench/methods/certified/keep/steady_array.h>
#include <lmdbench/methods/certified/keep/wide_lifetime.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace lmdbench {

/// A traversal that is kept from frame to frame: the tests that were made, each with the frames that it
/// stands, and the feature pairs that they let through. Completeness is that of find_wide_pairs: a lane that
/// no kept test has opened is rejected by one that stands still.
class TraversalFront {
 public:
  /// Forgets everything.
  void clear();
  bool empty() const { return test_queue_.size() == 0; }

  /// Finds the pairs anew, as find_wide_pairs does, and what they stand.
  void start(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
             const MotionForecast& motion, const RigidTransform& X_BA, double search_distance,
             WideCounters& counters);

  /// What was kept of children that have changed since (WideChanges), in either hierarchy, is made again in the frame that the forecast was
  /// brought to. Comes before `advance`.
  /// @param seen_a, seen_b  deformations of each that the pairs know; the frames of neither changed since
  void follow(const WideHierarchy& a, std::uint32_t seen_a, const WideHierarchy& b, std::uint32_t seen_b,
              const MotionForecast& motion);

  /// Brings the pairs to the frame that the forecast was brought to.
  void advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
               const MotionForecast& motion, const RigidTransform& X_BA, double search_distance,
               WideCounters& counters);

  /// Finds the pairs that are due, once a frame.
  void collect_due(const MotionForecast& motion) { leaf_queue_.collect(motion, due_); }
  /// Calls decide(pair, touches, lever_arm) for every pair that is due and chosen(pair, touches); `touches` tells
  /// pairs of faces that may touch from pairs that may be LMDs. It returns the Certificate of its decision.
  /// Every pair must be chosen in one call a frame.
  template <class Decide, class Chosen>
  void for_each_due(const WideHierarchy& a, const MotionForecast& motion, double search_distance,
                    Decide&& decide, Chosen&& chosen) {
    for (const std::uint32_t i : due_) {
      const Leaf& leaf = leaves_[i];
      if (!chosen(leaf.pair, leaf.touches)) continue;
      plan_leaf(a, motion, i, decide(leaf.pair, leaf.touches, lever_arm_of(a, i, search_distance)));
    }
  }

  /// Calls visit(leaf, pair) for every pair of faces that may touch and is due, instead of `decide`: each must be
  /// given its plan by plan_leaf in this frame.
  template <class Visit>
  void for_each_due_touching(Visit&& visit) const {
    for (const std::uint32_t i : due_)
      if (leaves_[i].touches) visit(i, leaves_[i].pair);
  }
  /// Keeps a decision about a pair that was due.
  void plan_leaf(const WideHierarchy& a, const MotionForecast& motion, std::uint32_t leaf,
                 const Certificate& certificate);
  /// Of a pair's moving feature, for certificates [m].
  double lever_arm_of(const WideHierarchy& a, std::uint32_t leaf, double search_distance) const {
    const std::uint32_t slot = leaves_[leaf].slot_a;
    return static_cast<double>(a.nodes[slot / WIDE_WIDTH].radius[slot % WIDE_WIDTH]) + 2.0 * search_distance;
  }

  std::size_t test_count() const { return test_queue_.count(); }
  std::size_t pair_count() const { return leaf_queue_.count(); }

 private:
  /// What a test let through.
  struct Record {
    bool in_use = false;
    bool is_requested = false;       ///< Its test is to be made in this frame.
    std::uint32_t opened_lanes = 0;  ///< Lanes that have a record in `below`.
    std::uint32_t lmd_lanes = 0;     ///< Lanes that have a leaf in `below`.
    std::uint32_t touch_lanes = 0;   ///< Lanes that have a leaf in `touching`.
    std::array<std::uint32_t, WIDE_WIDTH> below{};
    std::array<std::uint32_t, WIDE_WIDTH> touching{};
  };
  struct Leaf {
    WidePair pair;
    std::uint32_t slot_a;
    bool touches;
  };
  /// What a call works on.
  struct Work {
    const WideHierarchy& a;
    const WideHierarchy& b;
    const WideQuery& query;
    const MotionForecast& motion;
    const WideForecast forecast;
    WideCounters& counters;
  };

  std::uint32_t add_record(const Work& work, std::uint32_t slot_a, std::uint32_t slot_b);
  std::uint32_t add_leaf(const Work& work, std::uint32_t slot_a, const WidePair& pair, bool touches);
  void drop_record(std::uint32_t record);
  /// Drops the pairs that a test let through, and puts its records on `dropping_`.
  void drop_below(const Record& record);
  /// Drops the records on `dropping_` and all below them.
  void finish_dropping();
  void make_requested_tests(const Work& work);
  void apply(const Work& work, const WideKeptTest& test);

  // By the indices of the queues; what is beyond those is left over.
  SteadyArray<WideKeptPair> pairs_;
  SteadyArray<Record> records_;  ///< What the test of each pair let through.
  CertificateQueue test_queue_;
  SteadyArray<Leaf> leaves_;
  CertificateQueue leaf_queue_;
  std::vector<std::uint32_t> requested_, dropping_, due_;
  std::vector<WideKeptTest> tests_;
};

}  // namespace lmdbench
