// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/build/wide_bounds.h>
#include <lmdbench/methods/certified/build/wide_items.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>
#include <lmdbench/shape/shape_complex.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace lmdbench {

/// Bounds of single lanes where a hierarchy follows a mesh (wide_refit.h), all rounded outwards.

/// Cost of a lane, up to a factor: its size and its gain by opening (wide_traversal.h).
inline double lane_cost(const WideNode& node, std::uint32_t lane) {
  if (node.cosine[lane] == NO_LMD_COSINE) return 0.0;
  return static_cast<double>(node.radius[lane] * opening_gain(node.radius[lane], node.sine[lane]));
}

/// Bounds a lane that holds a feature of one vertex, edge or triangle.
void bound_feature(WideNode& node, std::uint32_t lane, const WideHierarchy& hierarchy, const Surface& surface,
                   const WideItem& item);

/// Bounds lanes that hold nodes, those of one node side by side (wide_bounds.h). One a thread: it
/// is scratch memory. A lane is bounded round the lanes of the nodes two levels below it, where
/// there are any: from one level below, bounds are so large that a search makes a fifth more node
/// tests.
class InnerBounds {
 public:
  /// @param lanes bits of lanes that hold nodes, whose own lanes are bounded
  void bound(WideNode& node, std::uint32_t lanes, const WideHierarchy& hierarchy, const Surface& surface,
             const ShapeComplex& shape);

 private:
  static constexpr std::size_t MOST_PARTS = WIDE_WIDTH * WIDE_WIDTH;
  /// A lane of some node.
  struct Part {
    const WideNode* node = nullptr;
    std::uint32_t lane = 0;
    bool carries_lmd() const { return node->cosine[lane] != NO_LMD_COSINE; }
  };
  /// What a lane is bounded round.
  struct Lane {
    bool carries_lmd = false, has_axis = false;
    std::size_t part_count = 0;
    std::array<Part, MOST_PARTS> parts;
    /// All parts are single vertices, edges or triangles; `points`: their vertices, else centres.
    bool all_plain = true;
    std::size_t point_count = 0;
    std::array<Vec3, MOST_PARTS> points;  ///< From the hierarchy's origin [m].
  };
  static void collect(Lane& lane, const WideNode& below, const WideHierarchy& hierarchy,
                      const Surface& surface, const ShapeComplex& shape);
  void put_caps(std::uint32_t lane, Lane& content, std::size_t count);
  static PolarCap cap_about(const Lane& lane, const Vec3& chosen_axis);

  std::array<Lane, WIDE_WIDTH> lanes_;
  LaneCaps caps_;
  LaneSets points_;
};

}  // namespace lmdbench
