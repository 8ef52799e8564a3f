// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/methods/certified/decide/certificate.h>
#include <lmdbench/methods/certified/keep/certificate_queue.h>
#include <lmdbench/methods/certified/keep/motion_forecast.h>
#include <lmdbench/methods/certified/keep/steady_array.h>
#include <lmdbench/methods/certified/keep/wide_lifetime.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace lmdbench {

/// A traversal that is kept from frame to frame: its tests and the feature pairs ("leaves") that
/// they let through, each valid for a plan (certificate_queue.h).
/// 1. `start` asks for the test of the roots, `collect_due_tests` for those that are due.
/// 2. `advance` makes tests, with lifetimes (wide_lifetime.h). A lane that survives is opened,
///    which asks for another test, or becomes a leaf; one that no longer does is dropped with all
///    below it.
/// 3. Once no test is left to be made the front is complete. Leaves that are due are decided; a
///    decision has a certificate (PROOF.md, lemma 18).
/// A complete front misses none, as in find_wide_pairs: a valid test rejects every lane that is not
/// opened.
class TraversalFront {
 public:
  /// Memory of a frame's search: what it holds means nothing to the next one, and fronts lend it to
  /// each other.
  struct Scratch {
    CertificateQueue::Scratch queue;
    std::vector<std::uint32_t> due;  ///< Pairs: from `collect_due` on.
    std::vector<std::uint32_t> batch;
    std::vector<WideKeptTest> tests;
  };

  void clear();
  bool empty() const { return test_queue_.size() == 0; }
  bool is_complete() const { return !empty() && requested_.empty(); }

  /// Begins anew.
  void start(const WideHierarchy& a, const WideHierarchy& b);

  /// Repeats what was kept of children that have changed (WideChanges). Comes before `advance`.
  /// @param seen_a, seen_b  deformations that the pairs know; neither frame has changed since
  void follow(const WideHierarchy& a, std::uint32_t seen_a, const WideHierarchy& b, std::uint32_t seen_b,
              const MotionForecast& motion);

  /// Asks for the tests that are due, once a frame. @return how many there are
  std::size_t collect_due_tests(const MotionForecast& motion, Scratch& scratch);
  /// Makes the tests that are asked for; those of this frame's collect_due_tests come first.
  /// @param most  tests that are made
  void advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
               const MotionForecast& motion, const RigidTransform& X_BA, double search_distance,
               std::size_t most, WideCounters& counters, Scratch& scratch);

  /// Finds the pairs that are due, once a frame.
  void collect_due(const MotionForecast& motion, Scratch& scratch) {
    leaf_queue_.collect(motion, scratch.due, scratch.queue);
  }
  /// In place of deciding them.
  void postpone_due(const MotionForecast& motion, const Scratch& scratch) {
    for (const std::uint32_t i : scratch.due) leaf_queue_.plan_next(i, motion);
  }
  /// Calls decide(pair, touches, lever_arm), which returns its Certificate, for every pair that is
  /// due and chosen(pair, touches), in one call a frame. `touches`: faces that may touch.
  template <class Decide, class Chosen>
  void for_each_due(const WideHierarchy& a, const MotionForecast& motion, double search_distance,
                    const Scratch& scratch, Decide&& decide, Chosen&& chosen) {
    for (const std::uint32_t i : scratch.due) {
      const Leaf& leaf = leaves_[i];
      if (!chosen(leaf.pair, leaf.touches)) continue;
      plan_leaf(a, motion, i, decide(leaf.pair, leaf.touches, lever_arm_of(a, i, search_distance)));
    }
  }

  /// Calls visit(leaf, pair) for every pair of faces that may touch and is due. Each must be given
  /// to plan_leaf in this frame.
  template <class Visit>
  void for_each_due_touching(const Scratch& scratch, Visit&& visit) const {
    for (const std::uint32_t i : scratch.due)
      if (leaves_[i].touches) visit(i, leaves_[i].pair);
  }
  /// Keeps the decision about a pair that was due.
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
  static constexpr std::uint32_t NONE = std::numeric_limits<std::uint32_t>::max();
  enum class State : std::uint8_t { UNUSED, REQUESTED, TESTED };
  /// What the test of a pair let through, in lists: a pile keeps thousands. They have the order of
  /// the lanes, so that what is dropped or added is always done in the same order.
  struct Record {
    std::uint32_t first_below = NONE;  ///< Record of the last opened lane.
    std::uint32_t next = NONE;         ///< Of the list that it is in.
    std::uint32_t first_leaf = NONE;   ///< Of the first bit of `leaf_lanes`.
    std::uint16_t leaf_lanes = 0;      ///< Lanes that have a leaf; << WIDE_WIDTH: that touches.
    std::uint8_t opened_lanes = 0;     ///< Lanes that have a record.
    State state = State::REQUESTED;
  };
  struct Leaf {
    WidePair pair;
    std::uint32_t slot_a;
    std::uint32_t next;
    bool touches;
  };
  struct Work {
    const WideHierarchy& a;
    const WideHierarchy& b;
    const WideQuery& query;
    const MotionForecast& motion;
    const WideForecast forecast;
    WideCounters& counters;
  };

  std::uint32_t add_record(const WideHierarchy& a, const WideHierarchy& b, std::uint32_t slot_a,
                           std::uint32_t slot_b);
  std::uint32_t add_leaf(const Work& work, std::uint32_t slot_a, const WidePair& pair, bool touches);
  /// Drops the pairs that a record's test let through.
  void drop_leaves(const Record& record);
  /// Drops a list of records and all below them.
  void drop_records(std::uint32_t first);
  void apply(const Work& work, const WideKeptTest& test);

  // By the indices of the queues; later entries are unused.
  SteadyArray<WideKeptPair> pairs_;
  SteadyArray<Record> records_;
  CertificateQueue test_queue_;
  SteadyArray<Leaf> leaves_;
  CertificateQueue leaf_queue_;
  std::vector<std::uint32_t> requested_;  ///< Tests that are to be made.
};

}  // namespace lmdbench
