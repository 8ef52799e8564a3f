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

/// What a lane of a wide node refers to: nothing, another node, or a feature.
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
  static constexpr std::uint32_t INDEX_MASK = (1u << KIND_SHIFT) - 1u;  ///< Largest node or feature index.
  // Of a vector of references two signs tell, its own and that of its double (wide_criteria-inl.h).
  static constexpr std::uint32_t IS_FEATURE = 1u << 31, IS_FACE = 1u << 30;
  static_assert(static_cast<std::uint32_t>(FeatureKind::FACE) << KIND_SHIFT == IS_FACE);

 private:
  constexpr explicit WideRef(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;  ///< Node 0 is the root and nobody's child, so 0 can mean "empty".
};

/// Eight children as structure of arrays, in single precision, in the hierarchy's frame (the mesh's, moved to
/// WideHierarchy::origin). A child is bounded by a disc-like body and a cone of directions:
///   every point x of its features:            |x - centre| <= radius and |(x - centre) . axis| <= thickness
///   every direction n of an LMD that leaves it: n . axis >= cosine (|n| = 1)
/// The thickness along the cone's axis is what a sphere lacks: a flat patch of radius r has r as its extent
/// in every direction but its own normal, and that is the direction in which the other mesh lies. All bounds
/// are rounded outwards. Axis zero, cosine 0, sine 1 and a huge thickness mean all directions; cosine 2 means
/// that no LMD leaves the child (triangles without area, which still can intersect others).
struct alignas(32) WideNode {
  float centre[3][WIDE_WIDTH];
  float radius[WIDE_WIDTH];
  float axis[3][WIDE_WIDTH];
  float thickness[WIDE_WIDTH];
  float cosine[WIDE_WIDTH];
  float sine[WIDE_WIDTH];
  std::uint32_t child[WIDE_WIDTH];  ///< WideRef::bits()
};

/// A third extent of a node's children, where features are long: the wall of a peg is narrow, which a disc round it does not know.
/// Every point x of a child's features: |(x - centre) . across| <= half_width, rounded outwards. `across` is square to the axis;
/// zero, with half width 0, where it would say little.
struct alignas(32) WideWidths {
  float across[3][WIDE_WIDTH];
  float half_width[WIDE_WIDTH];
};

/// Thickness of children without an axis; larger than any mesh, and its square is finite in single precision.
inline constexpr float UNBOUNDED_THICKNESS = 1e18F;
/// Cosine of children that carry no LMD.
inline constexpr float NO_LMD_COSINE = 2.0F;
/// Widening of stored cosines and sines: a few roundings of single precision.
inline constexpr double CONE_ROUNDING = 5e-7;

class WideRefit;

/// When what of a hierarchy over a deforming mesh changed, in deformations: what was kept of it since an earlier one still holds
/// where nothing changed after that.
struct WideChanges {
  std::uint32_t now = 0;    ///< Deformations so far.
  std::uint32_t frame = 0;  ///< Origin, radius, or all there is.
  std::vector<std::uint32_t>
      bounds;  ///< #nodes: bounds of some lane, or wings of a feature in it; empty before the first.
  std::vector<std::uint32_t> lanes;  ///< #nodes: what some lane refers to.

  bool bounds_after(std::uint32_t node, std::uint32_t time) const {
    return !bounds.empty() && bounds[node] > time;
  }
  bool lanes_after(std::uint32_t node, std::uint32_t time) const {
    return !lanes.empty() && lanes[node] > time;
  }
};

/// Hierarchy over the features of a mesh that can carry an LMD (non-empty outward polar cone),
/// each owned by one lane of one node, and over every triangle without area. nodes[0] has one
/// child, the root; empty for an empty mesh.
struct WideHierarchy {
  std::vector<WideNode> nodes;
  std::vector<WideWidths>
      widths;                  ///< #nodes; empty where few features are long, and once the mesh has deformed.
  Vec3 origin = Vec3::Zero();  ///< Mesh-frame point that is the origin of the
                               ///< nodes' coordinates.
  double radius = 0.0;         ///< Every point of every feature is within this distance
                               ///< of `origin`.
  std::size_t feature_count = 0;
  WideChanges changes;

  std::size_t bytes() const { return nodes.size() * sizeof(WideNode) + widths.size() * sizeof(WideWidths); }

  /// What subtracting the origin from a coordinate may lose, and is added to each size [m].
  double rounding() const;

  /// Built with the default options over the features of the mesh's shape: what `certified` prepares for a mesh.
  static WideHierarchy of(const Body& body);
  /// Brings it to the mesh as it is after a deformation (wide_refit.h); built anew where the features are others, in the first step
  /// too, and where counters say that it pays.
  void follow(const Body& body, const SurfaceChange& change);
  std::uint32_t times_built_anew() const { return times_built_anew_; }

 private:
  std::shared_ptr<WideRefit> refit_;  ///< Once the mesh has deformed.
  std::uint32_t shape_times_ = 0;     ///< ShapeComplex::times_made_anew of the shape that it was built over.
  std::uint32_t times_built_anew_ = 0;
};

}  // namespace lmdbench
