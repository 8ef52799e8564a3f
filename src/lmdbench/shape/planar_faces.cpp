// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_sides.h>
#include <lmdbench/shape/planar_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace lmdbench {

namespace {

/// A triangle whose least altitude is under this many tolerances starts no face.
constexpr double LEAST_SEED_ALTITUDE = 16.0;
/// Points of a face at which its plane is fitted first; before, one triangle gives it.
constexpr std::size_t FIRST_FIT = 6;

struct TriangleSize {
  double area = 0.0;
  double altitude = 0.0;  ///< The least of the three [m].
};

TriangleSize size_of(const Triangle& t) {
  return {0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(), least_altitude(t)};
}

/// Standard deviation of a triangle's corners along its altitude.
double breadth_of(const TriangleSize& size) {
  return std::sqrt(2.0) / 3.0 * size.altitude;
}

class Grower {
 public:
  Grower(const Surface& surface, double tolerance, std::vector<bool>* looked_at)
      : surface_(surface),
        tolerance_(tolerance),
        looked_at_(looked_at),
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
    plane.breadth = breadth_of(sizes_[static_cast<std::size_t>(seed)]);
    if (sizes_[static_cast<std::size_t>(seed)].altitude > LEAST_SEED_ALTITUDE * tolerance_) {
      reach(seed, plane, true);
      note_looked_at();
      if (points_.size() > 3) {
        const FittedPlane all = fit_plane(points_, normal(seed));
        reach(seed, FittedPlane{all.plane, 0.0}, false);
        note_looked_at();
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

  /// Collects in reached_, vertices_ and points_ all that is reachable from the seed.
  /// @param adapt the plane follows the points, with the tolerance widened by its uncertainty
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

  /// Marks the triangles reached, if there are several, and all that were tested on the way.
  void note_looked_at() {
    if (looked_at_ == nullptr || reached_.size() < 2) return;
    for (const std::int32_t triangle : reached_) {
      (*looked_at_)[static_cast<std::size_t>(triangle)] = true;
      for (const std::int32_t edge : surface_.adjacency.triangle_edges[static_cast<std::size_t>(triangle)])
        for (const std::int32_t next : surface_.adjacency.edge_triangles[edge])
          (*looked_at_)[static_cast<std::size_t>(next)] = true;
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
  std::vector<bool>* looked_at_;
  std::vector<TriangleSize> sizes_;
  std::vector<std::int32_t> face_of_;
  std::vector<PlanarFace> faces_;
  std::vector<std::uint32_t> triangle_marks_, vertex_marks_;
  std::uint32_t mark_ = 0;  ///< Two a seed, and fewer than 2^30 triangles.
  std::vector<std::int32_t> reached_, vertices_;
  std::vector<Vec3> points_;
};

}  // namespace

std::vector<PlanarFace> planar_faces(const Surface& surface, double tolerance, std::vector<bool>* looked_at) {
  if (looked_at != nullptr) looked_at->assign(surface.mesh.triangles.size(), false);
  return Grower(surface, tolerance, looked_at).run();
}

namespace {

/// Start of a face, for a quick test of its neighbours.
struct FaceStart {
  Vec3 point, normal;
  double squared_altitude = 0.0;

  FaceStart(const Surface& surface, std::int32_t triangle)
      : normal(surface.face_normals[static_cast<std::size_t>(triangle)]) {
    const Triangle t = surface.mesh.triangle(triangle);
    point = t[0];
    const double squared_longest = squared_longest_side(t);
    if (squared_longest > 0.0)
      squared_altitude = (t[1] - t[0]).cross(t[2] - t[0]).squaredNorm() / squared_longest;
  }

  /// Whether the first growth of a face could take in a corner, or one a little farther away:
  /// |height| <= tolerance (2 + distance / breadth), squared with (a + b)^2 <= 2 a^2 + 2 b^2.
  bool may_reach(const Vec3& corner, double tolerance) const {
    const double squared_breadth = 2.0 / 9.0 * squared_altitude;
    const Vec3 from = corner - point;
    const double height = normal.dot(from);
    return height * height * squared_breadth <=
           2.0 * tolerance * tolerance * (4.0 * squared_breadth + from.squaredNorm());
  }
  bool is_low(double tolerance) const {
    return !(squared_altitude > LEAST_SEED_ALTITUDE * LEAST_SEED_ALTITUDE * tolerance * tolerance) ||
           normal.isZero(0.0);
  }
};

}  // namespace

bool may_join_neighbour(const Surface& surface, std::int32_t triangle, double tolerance,
                        const SurfaceChange* asked) {
  const FaceStart own(surface, triangle);
  if (own.is_low(tolerance)) return true;
  const auto opposite = [&](std::int32_t t, const std::array<std::int32_t, 2>& ends) -> const Vec3& {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(t)];
    const std::size_t k = corners[0] != ends[0] && corners[0] != ends[1]   ? 0
                          : corners[1] != ends[0] && corners[1] != ends[1] ? 1
                                                                           : 2;
    return surface.mesh.vertices[static_cast<std::size_t>(corners[k])];
  };
  for (const std::int32_t edge : surface.adjacency.triangle_edges[static_cast<std::size_t>(triangle)]) {
    const auto e = static_cast<std::size_t>(edge);
    if (surface.edge_is_boundary[e] || surface.edge_is_non_manifold[e]) continue;
    const auto& ends = surface.adjacency.edges[e];
    for (const std::int32_t next : surface.adjacency.edge_triangles[edge]) {
      if (next == triangle) continue;
      if (own.may_reach(opposite(next, ends), tolerance)) return true;
      if (asked != nullptr && asked->has_face(next)) continue;
      const FaceStart other(surface, next);
      if (!other.is_low(tolerance) && other.may_reach(opposite(triangle, ends), tolerance)) return true;
    }
  }
  return false;
}

}  // namespace lmdbench
