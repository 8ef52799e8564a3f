// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lmdbench::parts {

using Point = Eigen::Vector2d;
using Outline = std::vector<Point>;

/// Which layers of a column are solid: bit k is the layer between levels k and k + 1.
using Layers = std::uint64_t;
inline constexpr Layers NO_LAYER = 0, ALL_LAYERS = ~Layers{0};

/// A solid of upright prisms: convex cells of a plane, each filled in some of the layers between
/// levels of height. If cells meet in whole sides, its boundary is closed and free of T-junctions.
/// It is a manifold where no two filled prisms meet only in an edge or corner.
class PrismComplex {
 public:
  /// @param levels ascending heights, one more than there are layers
  explicit PrismComplex(std::vector<double> levels) : levels_(std::move(levels)) {}

  std::size_t layer_count() const { return levels_.size() - 1; }

  /// A convex cell, counter-clockwise. The ends of a common side have the same bits in both cells.
  void add_cell(Outline corners, Layers layers = ALL_LAYERS);
  /// Quads between two outlines with equal numbers of points.
  void add_ring(const Outline& inner, const Outline& outer,
                const std::function<Layers(std::size_t)>& layers = nullptr);
  /// Rectangles between the lines; not filled where `layers` gives NO_LAYER.
  void add_grid(std::span<const double> xs, std::span<const double> ys,
                const std::function<Layers(std::size_t, std::size_t)>& layers = nullptr);

  /// The boundary, triangles counter-clockwise seen from outside.
  /// @param place maps points of the complex and keeps orientation; none: identity
  TriangleMesh mesh(const std::function<Vec3(const Vec3&)>& place = nullptr) const;

 private:
  struct Cell {
    Outline corners;
    Layers layers;
  };
  std::vector<double> levels_;
  std::vector<Cell> cells_;
};

/// Maps a profile in the plane of x and height to its extrusion along y.
inline Vec3 laid_down(const Vec3& p) {
  return {p.x(), -p.z(), p.y()};
}
/// Extrusion along y of the region between two lines of equally many points, from left to right.
TriangleMesh between(const Outline& low, const Outline& high, double length = 1.0);

}  // namespace lmdbench::parts
