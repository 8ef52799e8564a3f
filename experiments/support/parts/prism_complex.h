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

/// A solid made of upright prisms: convex cells of a plane, each filled in some of the layers between levels of height.
/// Its boundary is closed and free of T-junctions whatever is filled, as long as cells meet in whole sides; it is a
/// manifold where no two filled prisms meet in an edge or corner alone.
class PrismComplex {
 public:
  /// @param levels heights, ascending: one more than there are layers
  explicit PrismComplex(std::vector<double> levels) : levels_(std::move(levels)) {}

  std::size_t layer_count() const { return levels_.size() - 1; }

  /// A convex cell, corners counter-clockwise. Cells that share a side name its ends with the same bits.
  void add_cell(Outline corners, Layers layers = ALL_LAYERS);
  /// Quads between two outlines of as many points each.
  void add_ring(const Outline& inner, const Outline& outer,
                const std::function<Layers(std::size_t)>& layers = nullptr);
  /// Rectangles between the lines; not filled where `layers` gives NO_LAYER.
  void add_grid(std::span<const double> xs, std::span<const double> ys,
                const std::function<Layers(std::size_t, std::size_t)>& layers = nullptr);

  /// The boundary, triangles counter-clockwise seen from outside.
  /// @param place where a point of the complex goes, keeping orientation; stays where it is when none is given
  TriangleMesh mesh(const std::function<Vec3(const Vec3&)>& place = nullptr) const;

 private:
  struct Cell {
    Outline corners;
    Layers layers;
  };
  std::vector<double> levels_;
  std::vector<Cell> cells_;
};

/// From a profile in the plane of x and height to its extrusion along y.
inline Vec3 laid_down(const Vec3& p) {
  return {p.x(), -p.z(), p.y()};
}
/// Extrusion along y of what is between two lines of as many points, from left to right.
TriangleMesh between(const Outline& low, const Outline& high, double length = 1.0);

}  // namespace lmdbench::parts
