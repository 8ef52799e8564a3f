// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

/// Distances between the vertices, edges and triangles of two meshes in exact arithmetic: the
/// function whose local minima are the LMDs, cell by cell.
namespace lmdbench::exact {

/// Vertices, edges and triangles of a mesh in one numbering, as closed cells. Its vertices are in
/// the world as RigidTransform rounds them; from here on they are exact.
class Cells {
 public:
  Cells(const Surface& surface, const RigidTransform& X_WS);

  std::int32_t count() const { return static_cast<std::int32_t>(corners_.size()); }
  FeatureId id(std::int32_t cell) const;
  std::int32_t number(const FeatureId& id) const;
  /// Dimension of the cell: 0, 1 or 2.
  int dimension(std::int32_t cell) const { return static_cast<int>(id(cell).kind); }
  std::span<const std::int32_t> corners(std::int32_t cell) const;
  /// Cells one dimension lower on its boundary, and one higher around it.
  std::span<const std::int32_t> facets(std::int32_t cell) const {
    return facets_[static_cast<std::size_t>(cell)];
  }
  std::span<const std::int32_t> cofaces(std::int32_t cell) const {
    return cofaces_[static_cast<std::size_t>(cell)];
  }

  const Surface& surface() const { return surface_; }
  const std::vector<Vec3>& vertices_W() const { return vertices_W_; }
  const Vec3& vertex(std::int32_t index) const { return vertices_W_[static_cast<std::size_t>(index)]; }
  /// @pre the cell is a triangle
  Triangle triangle(std::int32_t cell) const;
  /// Outward, not normalised. @pre the cell is a triangle
  Vec3 normal(std::int32_t cell) const;
  /// On which side of the surface a direction leaves the inside of a cell: the sine with the
  /// angle-weighted sum of the normals around it, positive outwards.
  double side(std::int32_t cell, const Vec3& direction_W) const;

 private:
  const Surface& surface_;
  std::vector<Vec3> vertices_W_;
  std::vector<std::array<std::int32_t, 3>> corners_;  ///< -1 where there are fewer.
  std::vector<std::vector<std::int32_t>> facets_, cofaces_;
};

/// The least distance of two closed cells.
struct CellPair {
  std::int32_t a = -1, b = -1;
  double distance = std::numeric_limits<double>::infinity();  ///< Exact value, rounded once [m].
  /// Whether exactly one pair of points in both insides is critical (vertex-vertex, vertex-edge,
  /// vertex-triangle or edge-edge): p and q. Else a pair of smaller cells has the distance.
  bool critical = false;
  Vec3 p = Vec3::Zero(), q = Vec3::Zero();  ///< Rounded [m].
};

/// All pairs of cells within `reach` of each other, smaller cells first.
class CellPairs {
 public:
  CellPairs(const Cells& a, const Cells& b, double reach);

  const Cells& a() const { return a_; }
  const Cells& b() const { return b_; }
  std::size_t size() const { return pairs_.size(); }
  const CellPair& operator[](std::size_t i) const { return pairs_[i]; }
  int dimension(std::size_t i) const { return a_.dimension(pairs_[i].a) + b_.dimension(pairs_[i].b); }
  std::optional<std::size_t> find(std::int32_t a, std::int32_t b) const;

  /// Calls visit(index) for the pairs that differ from one by one dimension on one side.
  template <typename Visit>
  void for_neighbours(std::size_t i, Visit visit) const {
    const CellPair& pair = pairs_[i];
    const auto see = [&](std::int32_t a, std::int32_t b) {
      if (const std::optional<std::size_t> other = find(a, b)) visit(*other);
    };
    for (const auto cells : {a_.facets(pair.a), a_.cofaces(pair.a)})
      for (const std::int32_t a : cells) see(a, pair.b);
    for (const auto cells : {b_.facets(pair.b), b_.cofaces(pair.b)})
      for (const std::int32_t b : cells) see(pair.a, b);
  }

 private:
  std::uint64_t key(std::int32_t a, std::int32_t b) const;

  const Cells& a_;
  const Cells& b_;
  std::vector<CellPair> pairs_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
};

}  // namespace lmdbench::exact
