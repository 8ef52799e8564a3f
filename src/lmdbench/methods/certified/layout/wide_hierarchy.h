// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/lmd/body.h>
#include <lmdbench/mesh/surface.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace lmdbench {

/// Children of a wide node.
inline constexpr int WIDE_WIDTH = 8;

/// Reference of a lane: nothing, another node, or a feature.
class WideRef {
 public:
  constexpr WideRef() = default;
  static constexpr WideRef node(std::uint32_t index) { return WideRef(index); }
  static constexpr WideRef feature(const FeatureId& id) {
    return WideRef(IS_FEATURE | static_cast<std::uint32_t>(id.kind) << KIND_SHIFT |
                   static_cast<std::uint32_t>(id.index));
  }
  static constexpr WideRef from_bits(std::uint32_t bits) { return WideRef(bits); }

  constexpr bool is_empty() const { return bits_ == 0; }
  constexpr bool is_feature() const { return (bits_ & IS_FEATURE) != 0; }
  constexpr bool is_face() const { return (bits_ & IS_FACE) != 0; }
  constexpr std::uint32_t node_index() const { return bits_; }
  constexpr FeatureId feature_id() const {
    return {static_cast<FeatureKind>((bits_ & ~IS_FEATURE) >> KIND_SHIFT),
            static_cast<std::int32_t>(bits_ & INDEX_MASK)};
  }
  constexpr std::uint32_t bits() const { return bits_; }
  constexpr bool operator==(const WideRef&) const = default;

  static constexpr int KIND_SHIFT = 29;
  /// Largest node or feature index.
  static constexpr std::uint32_t INDEX_MASK = (1u << KIND_SHIFT) - 1u;
  // So the signs of a reference and of its double tell its kind (kind_bits, wide_criteria-inl.h).
  static constexpr std::uint32_t IS_FEATURE = 1u << 31, IS_FACE = 1u << 30;
  static_assert(static_cast<std::uint32_t>(FeatureKind::FACE) << KIND_SHIFT == IS_FACE);

 private:
  constexpr explicit WideRef(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;  ///< Node 0 is nobody's child, so 0 means "empty".
};

/// Eight children (lanes), single precision, in the hierarchy's frame (the mesh's, moved to
/// WideHierarchy::origin). A child has a body and a cone of directions:
/// 1. Every point x of its features: |x - centre| <= radius and |(x - centre) . axis| <= thickness.
/// 2. Every direction n (|n| = 1) in which an LMD leaves it: n . axis >= cosine.
///
/// The paper has spheres and cones (section 3.1); the thickness is new: a flat patch extends by its
/// radius in all directions but its normal, in which the other mesh lies. All bounds are rounded
/// outwards. Axis 0, cosine 0, sine 1 and a huge thickness mean all directions. Cosine 2: no LMD
/// leaves the child (triangles without area, which still can intersect others).
struct alignas(32) WideNode {
  float centre[3][WIDE_WIDTH];
  float radius[WIDE_WIDTH];
  float axis[3][WIDE_WIDTH];
  float thickness[WIDE_WIDTH];
  float cosine[WIDE_WIDTH];
  float sine[WIDE_WIDTH];
  std::uint32_t child[WIDE_WIDTH];  ///< WideRef::bits()
};

/// A third extent of children, where features are long, as the walls of a peg: every point x of a
/// child has |(x - centre) . across| <= half_width, rounded outwards. `across` is square to the
/// axis; zero, with half width 0, where it would reject little.
struct alignas(32) WideWidths {
  float across[3][WIDE_WIDTH];
  float half_width[WIDE_WIDTH];
};

/// Thickness of children without an axis: larger than any mesh, with a finite square.
inline constexpr float UNBOUNDED_THICKNESS = 1e18F;
/// Cosine of children that carry no LMD.
inline constexpr float NO_LMD_COSINE = 2.0F;
/// Widening of stored cosines and sines: a few roundings of single precision.
inline constexpr double CONE_ROUNDING = 5e-7;

class WideRefit;

/// When each part of a hierarchy over a deforming mesh last changed, in deformations: what was kept
/// of a part is valid while the part has not changed since.
struct WideChanges {
  std::uint32_t now = 0;    ///< Deformations so far.
  std::uint32_t frame = 0;  ///< Of origin, radius, or everything.
  /// #nodes: of a lane's bounds, or wings of its feature; empty before the first deformation.
  std::vector<std::uint32_t> bounds;
  std::vector<std::uint32_t> lanes;  ///< #nodes: of some lane's reference.

  bool bounds_after(std::uint32_t node, std::uint32_t time) const {
    return !bounds.empty() && bounds[node] > time;
  }
  bool lanes_after(std::uint32_t node, std::uint32_t time) const {
    return !lanes.empty() && lanes[node] > time;
  }
};

/// Hierarchy over the features of a mesh that can carry an LMD, and over all triangles without
/// area, each in one lane of one node. nodes[0] has one child, the root; an empty mesh has no
/// nodes.
struct WideHierarchy {
  std::vector<WideNode> nodes;
  /// #nodes; empty where few features are long, and once the mesh has deformed.
  std::vector<WideWidths> widths;
  Vec3 origin = Vec3::Zero();  ///< Origin of the nodes' coordinates, in the mesh's frame.
  double radius = 0.0;         ///< Of all features about `origin` [m].
  std::size_t feature_count = 0;
  WideChanges changes;

  std::size_t bytes() const { return nodes.size() * sizeof(WideNode) + widths.size() * sizeof(WideWidths); }

  /// Bound of what subtracting the origin from a coordinate loses; added to each size [m].
  double rounding() const;

  /// Over the features of the mesh's shape: what `certified` prepares for a mesh.
  static WideHierarchy of(const Body& body);
  /// Follows a deformation (deform/wide_refit.h). It is built anew in the first step, where the
  /// shape was made anew, and where counters say that it pays.
  void follow(const Body& body, const SurfaceChange& change);
  std::uint32_t times_built_anew() const { return times_built_anew_; }

 private:
  std::shared_ptr<WideRefit> refit_;  ///< Once the mesh has deformed.
  std::uint32_t shape_times_ = 0;     ///< ShapeComplex::times_made_anew when it was built.
  std::uint32_t times_built_anew_ = 0;
};

}  // namespace lmdbench
