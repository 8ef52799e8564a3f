// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/planar_faces.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lmdbench {

namespace {

/// A triangle whose least altitude is under this many tolerances starts no face.
constexpr double LEAST_SEED_ALTITUDE = 16.0;
/// A triangle whose least altitude is under this many tolerances may face any way: its normal is noise.
constexpr double LEAST_ORIENTED_ALTITUDE = 4.0;
/// Points that three corners give before the plane is fitted again.
constexpr std::size_t FIRST_FIT = 6;

struct TriangleSize {
  double area = 0.0;
  double altitude = 0.0;  ///< The least of the three [m].
};

TriangleSize size_of(const Triangle& t) {
  const double double_area = (t[1] - t[0]).cross(t[2] - t[0]).norm();
  const double longest = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
  return {0.5 * double_area, longest > 0.0 ? double_area / longest : 0.0};
}

class Grower {
 public:
  Grower(const Surface& surface, double tolerance)
      : surface_(surface),
        tolerance_(tolerance),
        face_of_(surface.mesh.triangles.size(), -1),
        triangle_marks_(surface.mesh.triangles.size(), 0),
        vertex_marks_(surface.mesh.vertices.size(), 0) {
    for (std::size_t t = 0; t < face_of_.size(); ++t)
      sizes_.push_back(size_of(surface.mesh.triangle(static_cast<std::int32_t>(t))));
  }

  std::vector<PlanarFace> run() {
    std::vector<std::int32_t> seeds(face_of_.size());
    std::iota(seeds.begin(), seeds.end(), 0);
    std::stable_sort(seeds.begin(), seeds.end(), [&](std::int32_t a, std::int32_t b) {
      return sizes_[static_cast<std::size_t>(a)].area > sizes_[static_cast<std::size_t>(b)].area;
    });
    for (const std::int32_t seed : seeds) {
      if (face_of_[static_cast<std::size_t>(seed)] >= 0 || normal(seed).isZero(0.0)) continue;
      grow(seed);
    }
    return std::move(faces_);
  }

 private:
  const Vec3& normal(std::int32_t triangle) const {
    return surface_.face_normals[static_cast<std::size_t>(triangle)];
  }
  const Vec3& vertex(std::int32_t index) const {
    return surface_.mesh.vertices[static_cast<std::size_t>(index)];
  }

  void grow(std::int32_t seed) {
    FittedPlane plane{{vertex(corners(seed)[0]), normal(seed)}, 0.0};
    // Standard deviation of a triangle's corners along its altitude.
    plane.breadth = std::sqrt(2.0) / 3.0 * sizes_[static_cast<std::size_t>(seed)].altitude;
    if (sizes_[static_cast<std::size_t>(seed)].altitude > LEAST_SEED_ALTITUDE * tolerance_) {
      reach(seed, plane, true);
      if (points_.size() > 3) {
        const FittedPlane all = fit_plane(points_, normal(seed));
        reach(seed, FittedPlane{all.plane, 0.0}, false);
        plane = all;
      }
    } else {
      start(seed);
    }
    if (reached_.size() < 2) {  // The second growth may refuse the seed itself.
      start(seed);
      plane.plane = {vertex(corners(seed)[0]), normal(seed)};
    }
    PlanarFace face{plane.plane, reached_, vertices_};
    std::sort(face.triangles.begin(), face.triangles.end());
    std::sort(face.vertices.begin(), face.vertices.end());
    for (const std::int32_t triangle : face.triangles)
      face_of_[static_cast<std::size_t>(triangle)] = static_cast<std::int32_t>(faces_.size());
    faces_.push_back(std::move(face));
  }

  /// Collects in reached_, vertices_ and points_ what can be reached from the seed.
  /// @param adapt the plane follows the points, with the tolerance widened by how little they fix it
  void reach(std::int32_t seed, FittedPlane plane, bool adapt) {
    start(seed);
    const auto is_near = [&](std::int32_t index) {
      const Vec3& x = vertex(index);
      const double doubt = adapt ? 1.0 + (x - plane.plane.point).norm() / plane.breadth : 0.0;
      return std::abs(plane.plane.height(x)) <= tolerance_ * (1.0 + doubt);
    };
    for (const std::int32_t corner : corners(seed)) {
      if (is_near(corner)) continue;
      reached_.clear();
      return;
    }
    std::size_t next_fit = FIRST_FIT;
    for (std::size_t next = 0; next < reached_.size(); ++next) {
      for (const std::int32_t edge :
           surface_.adjacency.triangle_edges[static_cast<std::size_t>(reached_[next])]) {
        if (surface_.edge_is_boundary[static_cast<std::size_t>(edge)] ||
            surface_.edge_is_non_manifold[static_cast<std::size_t>(edge)])
          continue;
        for (const std::int32_t triangle : surface_.adjacency.edge_triangles[edge]) {
          const auto t = static_cast<std::size_t>(triangle);
          if (face_of_[t] >= 0 || triangle_marks_[t] == mark_ || normal(triangle).isZero(0.0)) continue;
          if (sizes_[t].altitude > LEAST_ORIENTED_ALTITUDE * tolerance_ &&
              !(normal(triangle).dot(plane.plane.normal) > 0.0))
            continue;
          if (!std::all_of(corners(triangle).begin(), corners(triangle).end(), is_near)) continue;
          add(triangle);
        }
      }
      if (adapt && points_.size() >= next_fit) {
        plane = fit_plane(points_, normal(seed));
        next_fit = 2 * points_.size();
      }
    }
  }

  const std::array<std::int32_t, 3>& corners(std::int32_t triangle) const {
    return surface_.mesh.triangles[static_cast<std::size_t>(triangle)];
  }

  void start(std::int32_t seed) {
    ++mark_;
    reached_.clear();
    vertices_.clear();
    points_.clear();
    add(seed);
  }

  void add(std::int32_t triangle) {
    triangle_marks_[static_cast<std::size_t>(triangle)] = mark_;
    reached_.push_back(triangle);
    for (const std::int32_t corner : corners(triangle)) {
      std::uint32_t& mark = vertex_marks_[static_cast<std::size_t>(corner)];
      if (mark == mark_) continue;
      mark = mark_;
      vertices_.push_back(corner);
      points_.push_back(vertex(corner));
    }
  }

  const Surface& surface_;
  double tolerance_;
  std::vector<TriangleSize> sizes_;
  std::vector<std::int32_t> face_of_;
  std::vector<PlanarFace> faces_;
  std::vector<std::uint32_t> triangle_marks_, vertex_marks_;
  std::uint32_t mark_ = 0;  ///< Two a seed, and fewer than 2^30 triangles.
  std::vector<std::int32_t> reached_, vertices_;
  std::vector<Vec3> points_;
};

}  // namespace

std::vector<PlanarFace> planar_faces(const Surface& surface, double tolerance) {
  return Grower(surface, tolerance).run();
}

}  // namespace lmdbench
