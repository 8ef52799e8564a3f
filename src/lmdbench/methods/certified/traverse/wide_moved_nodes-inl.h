// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Nodes moved into the other hierarchy's frame, compiled once for every instruction set: included
// after foreach_target.h, with an include guard that Highway toggles.
#if defined(LMDBENCH_WIDE_MOVED_NODES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_WIDE_MOVED_NODES_INL_H
#undef LMDBENCH_WIDE_MOVED_NODES_INL_H
#else
#define LMDBENCH_WIDE_MOVED_NODES_INL_H
#endif

#include <lmdbench/methods/certified/layout/wide_numbers-inl.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Moved nodes of a first query; they grow by doubling.
constexpr std::size_t MOVED_START = 64;

/// Moves rows of points, or of directions where the translation is zero.
HWY_INLINE void move_rows(const float (*from)[WIDE_WIDTH], const WideTransform& X, const float* translation,
                          float (*to)[WIDE_WIDTH]) {
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += VectorLanes::count()) {
    const VectorNumber x = VectorLanes::load(from[0] + first), y = VectorLanes::load(from[1] + first),
                       z = VectorLanes::load(from[2] + first);
    for (int i = 0; i < 3; ++i) {
      const VectorNumber turned =
          (VectorLanes::set(X.columns[0][i]) * x + VectorLanes::set(X.columns[1][i]) * y) +
          VectorLanes::set(X.columns[2][i]) * z;
      const VectorNumber moved = turned + VectorLanes::set(translation[i]);
      hn::Store(moved.raw, FloatTag(), to[i] + first);
    }
  }
}

/// The nodes of the first hierarchy that a query has met.
class MovedNodes {
 public:
  MovedNodes(const WideHierarchy& a, const WideTransform& X, std::vector<WideMovedNode>& moved)
      : a_(a), to_other_(X), moved_(moved) {
    if (moved_.size() < MOVED_START) moved_.resize(MOVED_START);
    append(0);
  }

  const WideMovedNode& operator[](std::uint32_t place) const { return moved_[place]; }
  const WideNode& node(std::uint32_t place) const { return a_.nodes[moved_[place].node]; }

  /// Place of the child in a slot. @pre it is a node
  HWY_INLINE std::uint32_t child(std::uint32_t slot) {
    const std::uint32_t known = moved_[slot / WIDE_WIDTH].moved_child[slot % WIDE_WIDTH];
    if (known != 0) return known;
    const std::uint32_t place =
        append(WideRef::from_bits(node(slot / WIDE_WIDTH).child[slot % WIDE_WIDTH]).node_index());
    moved_[slot / WIDE_WIDTH].moved_child[slot % WIDE_WIDTH] = place;
    return place;
  }

 private:
  std::uint32_t append(std::uint32_t node) {
    static constexpr float NO_TRANSLATION[3] = {};
    if (count_ == moved_.size()) moved_.resize(2 * moved_.size());
    WideMovedNode& moved = moved_[count_];
    const WideNode& own = a_.nodes[node];
    move_rows(own.centre, to_other_, to_other_.translation, moved.centre);
    move_rows(own.axis, to_other_, NO_TRANSLATION, moved.axis);
    if (!a_.widths.empty()) move_rows(a_.widths[node].across, to_other_, NO_TRANSLATION, moved.across);
    std::ranges::fill(moved.moved_child, 0u);
    moved.node = node;
    return static_cast<std::uint32_t>(count_++);
  }

  const WideHierarchy& a_;
  const WideTransform& to_other_;
  std::vector<WideMovedNode>& moved_;
  std::size_t count_ = 0;
};

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
