// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/shape_complex.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// What the index of a feature in a direction is made of (decision/DEFINITION.md, "Critical pairs"), for a mesh that bounds a solid.
///
/// The index i(f, u) is the multiplicity with which the feature f has the outward normal u: +1 for a region and its normal; for a
/// chain and a direction between the normals of its regions +1 where it is convex and -1 where it is reflex; for a corner the
/// winding number of the closed polygon of its regions' normals round u (Banchoff 1967; the normal cycle of Wintgen and Zaehle).
/// For a corner whose normals fit into a half space that number is, on the outer side, 1 less the chains that do not rise along u
/// plus the sectors between chains that do not: it depends on signs alone, which neighbouring features share.
///
/// Features on a border, with more than two triangles at an edge, where sheets meet or with triangles without area have none.
class SignedFeatures {
 public:
  /// One side of a chain: sense * normal x (second end - first end) points into the region.
  struct ChainSide {
    std::int32_t region = -1;
    double sense = 0.0;
  };
  struct Chain {
    std::array<ChainSide, 2> sides;
    bool has_index = false;
  };
  enum class CornerKind : std::uint8_t {
    NONE,    ///< No corner, or one without an index.
    SIMPLE,  ///< All normals have a component along `outward`.
    FOLDED   ///< They fit into no half space.
  };
  struct Corner {
    CornerKind kind = CornerKind::NONE;
    std::uint32_t first = 0, count = 0;  ///< Into `others`, `regions` and `inner`.
    Vec3 outward = Vec3::Zero();         ///< Unit, mesh frame; FOLDED: any direction.
    int away = 0;                        ///< FOLDED: the index in the direction opposite to `outward`.
  };

  std::vector<Chain> chains;    ///< #chains
  std::vector<Corner> corners;  ///< #V
  /// Chains of a corner, counter-clockwise seen from outside, by their other ends.
  std::vector<std::int32_t> others;
  std::vector<std::int32_t> regions;  ///< Region of the sector from each chain to the next.
  std::vector<Vec3> inner;  ///< For a sector of 180 degrees or more a direction that halves it, else zero.

  static SignedFeatures of(const Surface& surface, const ShapeComplex& shape);
  template <class Body>
  requires requires(const Body& body) { body.surface(); }
  static SignedFeatures of(const Body& body) {
    return of(body.surface(), body.template prepared<ShapeComplex>());
  }

  bool has_index(const FeatureId& shape_feature) const;
  std::span<const std::int32_t> others_of(const Corner& corner) const {
    return std::span(others).subspan(corner.first, corner.count);
  }
  std::size_t bytes() const;

 private:
  void add_chain(const Surface& surface, const ShapeComplex& shape, std::int32_t chain);
  void add_corner(const Surface& surface, const ShapeComplex& shape, std::int32_t vertex);
};

}  // namespace lmdbench
