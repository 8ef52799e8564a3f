// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/wide_hierarchy.h>
#include <lmdbench/snch/wide_traversal.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace lmdbench {

/// A traversal that is kept from frame to frame: the tests that were made, each with the size of the motion
/// after which it must be made again, and the feature pairs that they let through.
///
/// A test rejects a lane by some inequality between lengths, or directions. The bounds behind it
/// (wide_node_test.h) speak of every p below the one child and every q below the other, with d = q - p:
///   |d| > cutoff,   u . d > cutoff,   u . d < 0,   angle(u, -u') > phi + phi',   d outside the cone round u.
/// Suppose that after a motion of size m (PairFilter::lever: |change of the moving mesh's centre| + lever *
/// angle) two such points are within the cutoff. Then d differs from what it was by less than m, in the frame
/// of either mesh, and the angle between u and u' by less than m / lever. So an inequality that held with the
/// slack s in its length holds while m < s, one in an angle a while m < lever * a. A lane's slack is the
/// largest of its inequalities' slacks (any one suffices); that of the touch test counts too where faces are
/// below. Sizes of motions add up (the triangle inequality), so a sum over frames, the clock, tells when a
/// test expires.
///
/// Lanes whose slack is under the horizon are kept as if they had survived: a test then lives for at least
/// that much motion. Completeness is that of find_wide_pairs: a lane that no test has opened is rejected by a
/// test that has not expired.
class WideFrontier {
 public:
  /// Forgets everything.
  void clear();
  bool empty() const { return records_.empty(); }

  /// Finds the pairs anew, as find_wide_pairs does, and the motions that they stand.
  void start(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, double lever,
             double horizon, WideCounters& counters);

  /// Brings the pairs to a new pose.
  /// @param motion size of the motion since the last call, rounded up
  void advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, double lever,
               double horizon, double motion, WideCounters& counters);

  /// Calls decide(pair, touches) for every pair that is due; `touches` tells pairs of faces that may touch
  /// from pairs that may be LMDs. It returns the motion before which the pair needs no decision, negative for
  /// the next frame whatever the motion.
  template <class Decide>
  void for_each_due(Decide&& decide) {
    for (std::size_t i = 0; i < leaf_expiry_.size(); ++i) {
      if (!(leaf_expiry_[i] < clock_)) continue;
      const double slack = decide(leaves_[i].pair, leaves_[i].touches);
      leaf_expiry_[i] = slack < 0.0 ? -std::numeric_limits<double>::infinity() : clock_ + slack;
    }
  }

  std::size_t test_count() const { return records_.size() - free_records_.size(); }
  std::size_t pair_count() const { return leaves_.size() - free_leaves_.size(); }

 private:
  static constexpr std::uint32_t NONE = 0xFFFFFFFFu;

  /// One test: a pair of children, one of which is opened.
  struct Record {
    std::uint32_t slot_a, slot_b;
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
    float lever, horizon;
    WideCounters& counters;
  };

  std::uint32_t add_record(std::uint32_t slot_a, std::uint32_t slot_b);
  std::uint32_t add_leaf(const WidePair& pair, bool touches);
  void drop_record(std::uint32_t record);
  void drop_leaf(std::uint32_t leaf);
  void test(const Work& work, std::uint32_t record);
  void test_new(const Work& work);

  double clock_ = 0.0;
  std::vector<Record> records_;
  std::vector<double>
      record_expiry_;  ///< Clock beyond which the test must be repeated; infinite for free records.
  std::vector<Leaf> leaves_;
  std::vector<double> leaf_expiry_;
  std::vector<std::uint32_t> free_records_, free_leaves_, untested_, dropping_;
};

/// The node test with slacks: lanes whose slack is at most the horizon survive.
struct WideSlackMasks {
  std::uint32_t used = 0;
  std::uint32_t lmd = 0;
  std::uint32_t touch = 0;
  float slack = 0.0F;  ///< Least slack of what did not survive.
};

/// @param touch_lanes lanes for which touching matters
WideSlackMasks test_lanes_slack(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                float lever, float horizon, std::uint32_t touch_lanes);

/// The same, lane by lane.
WideSlackMasks test_lanes_slack_scalar(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                       float lever, float horizon, std::uint32_t touch_lanes);

}  // namespace lmdbench
