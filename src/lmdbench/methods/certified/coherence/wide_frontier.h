// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/methods/certified/coherence/forecast_timers.h>
#include <lmdbench/methods/certified/coherence/motion_forecast.h>
#include <lmdbench/methods/certified/coherence/pair_standing.h>
#include <lmdbench/methods/certified/coherence/wide_lifetime.h>
#include <lmdbench/methods/certified/hierarchy/wide_hierarchy.h>
#include <lmdbench/methods/certified/hierarchy/wide_traversal.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace lmdbench {

/// A traversal that is kept from frame to frame: the tests that were made, each with the frames that it
/// stands, and the feature pairs that they let through. Completeness is that of find_wide_pairs: a lane that
/// no kept test has opened is rejected by one that stands still.
class WideFrontier {
 public:
  /// Forgets everything.
  void clear();
  bool empty() const { return records_.empty(); }

  /// Finds the pairs anew, as find_wide_pairs does, and what they stand.
  void start(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
             const MotionForecast& motion, const RigidTransform& X_BA, double cutoff, WideCounters& counters);

  /// Brings the pairs to the frame that the forecast was brought to.
  void advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
               const MotionForecast& motion, const RigidTransform& X_BA, double cutoff,
               WideCounters& counters);

  /// Calls decide(pair, touches, lever) for every pair that is due; `touches` tells pairs of faces that may
  /// touch from pairs that may be LMDs. It returns the PairStanding of its decision.
  template <class Decide>
  void for_each_due(const WideHierarchy& a, const MotionForecast& motion, double cutoff, Decide&& decide) {
    leaf_timers_.collect(motion, due_);
    for (const std::uint32_t i : due_) {
      const Leaf& leaf = leaves_[i];
      plan_leaf(a, motion, i, decide(leaf.pair, leaf.touches, lever_of(a, leaf, cutoff)));
    }
  }

  std::size_t test_count() const { return record_timers_.count(); }
  std::size_t pair_count() const { return leaf_timers_.count(); }

 private:
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
  void make_requested_tests(const Work& work);
  void apply(const Work& work, const WideKeptTest& test);

  static double lever_of(const WideHierarchy& a, const Leaf& leaf, double cutoff);
  void plan_leaf(const WideHierarchy& a, const MotionForecast& motion, std::uint32_t index,
                 const PairStanding& standing);

  std::vector<WideKeptPair> pairs_;
  std::vector<Record> records_;  ///< What the test of each pair let through.
  ForecastTimers record_timers_;
  std::vector<Leaf> leaves_;
  ForecastTimers leaf_timers_;
  std::vector<std::uint32_t> requested_, dropping_, due_;
  std::vector<WideKeptTest> tests_;
};

}  // namespace lmdbench
