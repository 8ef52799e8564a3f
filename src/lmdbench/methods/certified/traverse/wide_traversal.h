// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_node_test.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lmdbench {

/// Form of the node test. Both give the same pairs and counters, bit for bit.
enum class WideKernel : std::uint8_t {
  VECTOR,  ///< The widest instruction set of this processor (Highway, run-time dispatch).
  SCALAR   ///< Plain C++, the reference.
};

/// A query: two hierarchies at a pose.
struct WideQuery {
  WideTransform a_in_b;  ///< Moves points from a's hierarchy frame to b's.
  WideTransform b_in_a;
  WideLimits limits{};
  /// False where the spheres round both meshes are farther apart than both reach and touch.
  bool possible = false;

  /// @param X_BA   pose of a's mesh frame in b's mesh frame
  /// @param reach  G1's limit; may be infinite [m]
  /// @param touch  distance up to which pairs of faces are reported whatever their direction [m]
  WideQuery(const WideHierarchy& a, const WideHierarchy& b, const RigidTransform& X_BA, double reach,
            double touch);
};

struct WidePair {
  WideRef a, b;
};

struct WideCounters {
  std::uint64_t node_pairs = 0;  ///< Lanes tested.
  std::uint64_t rejected_g1 = 0;
  std::uint64_t rejected_g2 = 0;
  std::uint64_t rejected_g3 = 0;
  std::uint64_t node_tests = 0;  ///< Tests of one child against eight.
};

/// Which of two children, each named by node * 8 + lane, a traversal opens.
struct WideOpening {
  bool open_a;
  std::uint32_t node;  ///< The opened child's node.
};

/// Weight of a child's size beside its cone's sine (scripts/tuned_constants.py --only CONE_GAIN).
inline constexpr float CONE_GAIN = 0.2F;

/// Gain of opening a child: its size, weighted by its cone's width.
constexpr float opening_gain(float radius, float sine) {
  return radius * (CONE_GAIN + sine);
}

/// The child with more to gain; a feature cannot be opened, and one of the two is a node.
inline WideOpening choose_opening(const WideHierarchy& a, const WideHierarchy& b, std::uint32_t slot_a,
                                  std::uint32_t slot_b) {
  const WideNode& home_a = a.nodes[slot_a / WIDE_WIDTH];
  const WideNode& home_b = b.nodes[slot_b / WIDE_WIDTH];
  const std::uint32_t lane_a = slot_a % WIDE_WIDTH, lane_b = slot_b % WIDE_WIDTH;
  const WideRef ref_a = WideRef::from_bits(home_a.child[lane_a]);
  const WideRef ref_b = WideRef::from_bits(home_b.child[lane_b]);
  // No short circuit: a branch here cannot be predicted.
  const bool open_a =
      static_cast<bool>(static_cast<int>(ref_b.is_feature()) |
                        (static_cast<int>(!ref_a.is_feature()) &
                         static_cast<int>(opening_gain(home_a.radius[lane_a], home_a.sine[lane_a]) >
                                          opening_gain(home_b.radius[lane_b], home_b.sine[lane_b]))));
  return {open_a, open_a ? ref_a.node_index() : ref_b.node_index()};
}

/// Children of a node of the first hierarchy, moved into the second one's frame once a query.
struct alignas(64) WideMovedNode {
  float centre[3][WIDE_WIDTH];
  float axis[3][WIDE_WIDTH];
  std::uint32_t moved_child[WIDE_WIDTH];  ///< In WideScratch::moved; 0: not moved yet.
  std::uint32_t node;
  alignas(32) float across[3][WIDE_WIDTH];  ///< Where there are long features.
};

/// Pairs of children to be tested, last in first out. The first child is named by 8 times its
/// node's place in WideScratch::moved + lane, the second by node * 8 + lane.
struct WideStack {
  static constexpr std::size_t START = 512;  ///< Entries of a stack that has never been used.
  std::vector<std::uint32_t> a, b;
  std::size_t size = 0;

  void reserve_more(std::size_t count) {
    if (size + count <= a.size()) return;
    a.resize(std::max(START, 2 * (size + count)));
    b.resize(a.size());
  }
};

/// Memory of traversals, kept between them so that none is allocated after the first few.
struct WideScratch {
  WideStack opening_a, opening_b;
  std::vector<WideMovedNode> moved;
  std::vector<WidePair> lmd_pairs;    ///< Pairs that may be LMDs.
  std::vector<WidePair> touch_pairs;  ///< Pairs of faces that may touch.
};

/// Descends both hierarchies together and finds every pair of features that bounds cannot reject.
/// 1. The pair of the roots is pushed, if the spheres round the meshes are near enough.
/// 2. Of a popped pair the child with more to gain is opened (choose_opening). Its eight children
///    are tested against the other child in one go (wide_node_test.h; paper, section 3.2.1).
/// 3. Of the pairs that survive, pairs of features that may be LMDs go to `lmd_pairs`, pairs of
///    faces that may touch to `touch_pairs`; the others are pushed.
/// None is missed (PROOF.md, lemma 7): a test is conservative for everything below its pair, so by
/// induction every pair that holds an LMD or touches is reached; once, as a feature has one lane
/// and a pair of nodes is opened on one side only.
void find_wide_pairs(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                     WideKernel kernel, WideScratch& scratch, WideCounters& counters);

/// The node test as the vector form computes it on this processor.
WideMasks test_lanes_vector(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                            const WideWidthTest* widths = nullptr);

/// Instruction set that WideKernel::VECTOR uses here, for provenance: "AVX2", "SSE4", ...
std::string_view wide_kernel_target();

}  // namespace lmdbench
