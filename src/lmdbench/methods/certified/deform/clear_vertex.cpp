// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/vertex_fan.h>
#include <lmdbench/methods/certified/build/polar_extremes.h>
#include <lmdbench/methods/certified/deform/clear_vertex.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lmdbench {

namespace {

/// Determinants of three unit wings, see is_clear_saddle.
constexpr double LEAST_DETERMINANT = 1e-3;
/// Of more neighbours only the first are tried.
constexpr std::size_t MOST_NEIGHBOURS = 10;
/// A triangle is clear from this sine of its angle at the vertex on, a neighbour from this height
/// below its plane over its distance. Such planes, relaxed by the slack, cross at most 2 /
/// LEAST_SINE slacks, 2e-5, away: so the slack does not decide which planes bound the cone.
constexpr double LEAST_SINE = 0.2, LEAST_DEPTH = 1e-4;

const Vec3& position(const Surface& surface, std::int32_t vertex) {
  return surface.mesh.vertices[static_cast<std::size_t>(vertex)];
}

/// The least of the determinants of three of four unit vectors, squared; 0 where their signs differ
/// (those that agree where the four hold the origin between them).
double least_squared_determinant(const std::array<Vec3, 4>& w) {
  const Vec3 ab = w[0].cross(w[1]), cd = w[2].cross(w[3]);
  const std::array<double, 4> of{cd.dot(w[1]), -cd.dot(w[0]), ab.dot(w[3]), -ab.dot(w[2])};
  const bool same = (of[0] > 0.0 && of[1] > 0.0 && of[2] > 0.0 && of[3] > 0.0) ||
                    (of[0] < 0.0 && of[1] < 0.0 && of[2] < 0.0 && of[3] < 0.0);
  if (!same) return 0.0;
  const std::array<double, 4> squared{w[0].squaredNorm(), w[1].squaredNorm(), w[2].squaredNorm(),
                                      w[3].squaredNorm()};
  const double all = squared[0] * squared[1] * squared[2] * squared[3];
  double least = 1.0;
  for (std::size_t k = 0; k < 4; ++k) least = std::min(least, of[k] * of[k] * squared[k] / all);
  return least;
}

}  // namespace

bool is_clear_saddle(const Surface& surface, std::int32_t vertex, const SaddleWitness& witness,
                     double least_wing) {
  const Vec3& p = position(surface, vertex);
  std::array<Vec3, 4> wings;
  for (std::size_t k = 0; k < 4; ++k) {
    wings[k] = position(surface, witness[k]) - p;
    if (wings[k].squaredNorm() <= least_wing * least_wing) return false;
  }
  return least_squared_determinant(wings) >= LEAST_DETERMINANT * LEAST_DETERMINANT;
}

SaddleWitness find_saddle_witness(const Surface& surface, std::int32_t vertex) {
  std::array<std::int32_t, MOST_NEIGHBOURS> neighbours;
  std::size_t count = 0;
  for_each_neighbour(surface, vertex, [&](std::int32_t neighbour) {
    neighbours[count++] = neighbour;
    return count < MOST_NEIGHBOURS;
  });
  const Vec3& p = position(surface, vertex);
  SaddleWitness best = NO_WITNESS;
  double most = LEAST_DETERMINANT * LEAST_DETERMINANT;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      for (std::size_t c = b + 1; c < count; ++c)
        for (std::size_t d = c + 1; d < count; ++d) {
          const SaddleWitness four{neighbours[a], neighbours[b], neighbours[c], neighbours[d]};
          std::array<Vec3, 4> wings;
          for (std::size_t k = 0; k < 4; ++k) wings[k] = position(surface, four[k]) - p;
          const double least = least_squared_determinant(wings);
          if (!(least > most)) continue;
          most = least;
          best = four;
        }
  return best;
}

std::optional<PolarCap> clear_peak_cap(const Surface& surface, std::int32_t vertex, double least_wing) {
  const auto v = static_cast<std::size_t>(vertex);
  if (surface.vertex_is_boundary[v] || surface.vertex_has_non_manifold_edge[v]) return std::nullopt;
  const auto triangles = surface.adjacency.vertex_triangles[vertex];
  if (triangles.size() < 3 || triangles.size() > MOST_NEIGHBOURS) return std::nullopt;
  const Vec3& p = position(surface, vertex);
  struct Corner {
    std::int32_t next, previous;
    Vec3 wing;  ///< To `next`.
    double squared_length;
  };
  std::array<Corner, MOST_NEIGHBOURS> corners;
  const std::size_t count = triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& own = surface.mesh.triangles[static_cast<std::size_t>(triangles[i])];
    const std::size_t k = own[0] == vertex ? 0 : own[1] == vertex ? 1 : 2;
    Corner& corner = corners[i];
    corner.next = own[(k + 1) % 3];
    corner.previous = own[(k + 2) % 3];
    corner.wing = position(surface, corner.next) - p;
    corner.squared_length = corner.wing.squaredNorm();
    if (corner.squared_length <= least_wing * least_wing) return std::nullopt;
  }
  polar::Scratch& work = polar::scratch();
  double least_half = 1.0;  // Of (1 + cosine) / 2 over the angles at the vertex.
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& normal = surface.face_normals[static_cast<std::size_t>(triangles[i])];
    const Vec3 other = position(surface, corners[i].previous) - p;
    const double squared_product = corners[i].squared_length * other.squaredNorm();
    const double cosine_part = corners[i].wing.dot(other);
    // Written so that a length of zero is not clear.
    if (!(squared_product - cosine_part * cosine_part > LEAST_SINE * LEAST_SINE * squared_product))
      return std::nullopt;
    least_half = std::min(least_half, 0.5 * (1.0 + cosine_part / std::sqrt(squared_product)));
    for (std::size_t j = 0; j < count; ++j) {
      if (corners[j].next == corners[i].next || corners[j].next == corners[i].previous) continue;
      const double height = normal.dot(corners[j].wing);
      if (!(height < 0.0 && height * height > LEAST_DEPTH * LEAST_DEPTH * corners[j].squared_length))
        return std::nullopt;
    }
    work.extremes.directions.push_back(normal);
  }
  // As the search: relaxed planes cross at most this far from the exact ones.
  work.extremes.slack = POLAR_SLACK + POLAR_SLACK / std::sqrt(least_half);
  return polar::cap_around(work.extremes);
}

}  // namespace lmdbench
