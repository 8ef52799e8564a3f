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

/// For a solid: the index i(f, u) (decision/DEFINITION.md, "Critical pairs") is the multiplicity
/// with which feature f has the outward normal u. A region: +1 for its normal. A chain: for a
/// direction between its regions' normals +1 if convex, -1 if reflex. A corner: the winding number
/// of the closed polygon of its regions' normals round u (Banchoff 1967; the normal cycle of
/// Wintgen and Zaehle). If its normals fit into a half space that is, on the outer side, 1 less the
/// chains not rising along u plus the sectors between such: signs alone, which neighbouring
/// features share.
///
/// No index: on a border, at edges of over two triangles, where sheets meet, without area.
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
    int away = 0;                        ///< FOLDED: the index in direction -`outward`.
  };

  std::vector<Chain> chains;    ///< #chains
  std::vector<Corner> corners;  ///< #V
  /// Chains of a corner, counter-clockwise seen from outside, by their other ends.
  std::vector<std::int32_t> others;
  std::vector<std::int32_t> regions;  ///< Region of the sector from each chain to the next.
  std::vector<Vec3> inner;            ///< Halves a sector of 180 degrees or more; else zero.

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
