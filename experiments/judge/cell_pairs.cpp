// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Simple_cartesian.h>
#include <judge/cell_pairs.h>
#include <judge/exact_root.h>
#include <judge/feature_boxes.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lmdbench::exact {
namespace {

using testing::feature_boxes;
using testing::for_each_near;

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpz>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Integer = CGAL::Gmpz;

/// Exponent of the lowest set bit in any of the coordinates.
int last_exponent(const std::vector<Vec3>& points, int lowest) {
  for (const Vec3& p : points) {
    for (const double x : p) {
      if (x == 0.0) continue;
      int exponent = 0;
      auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
      exponent -= 53;
      for (; mantissa % 2 == 0; mantissa /= 2) ++exponent;
      lowest = std::min(lowest, exponent);
    }
  }
  return lowest;
}

/// Vertices in units of 2^exponent: integers.
std::vector<Point> integers(const std::vector<Vec3>& points, int exponent) {
  const auto integer = [&](double x) {
    Integer result;
    mpz_set_d(result.mpz(), std::ldexp(x, -exponent));
    return result;
  };
  std::vector<Point> result;
  for (const Vec3& p : points) result.emplace_back(integer(p[0]), integer(p[1]), integer(p[2]));
  return result;
}

/// A critical pair in the insides of two cells.
struct Critical {
  CGAL::Gmpq squared;         ///< In units of 4^exponent.
  double on_a = 0, on_b = 0;  ///< Position on an edge, from its first end.
};

double ratio(const Integer& over, const Integer& under) {
  return CGAL::to_double(CGAL::Gmpq(over, under));
}

/// How far outside a foot's double-precision coordinates must be to prove that it is outside.
constexpr double SURELY = 1e-6;

/// The exact tests for the cells of two meshes.
class CriticalPairs {
 public:
  CriticalPairs(const Cells& a, const Cells& b)
      : cells_{&a, &b}, exponent_(last_exponent(b.vertices_W(), last_exponent(a.vertices_W(), 0))) {
    points_ = {integers(a.vertices_W(), exponent_), integers(b.vertices_W(), exponent_)};
  }

  void fill(CellPair& pair) const {
    const int da = cells_[0]->dimension(pair.a), db = cells_[1]->dimension(pair.b);
    std::optional<Critical> found;
    if (da == 1 && db == 1) {
      found = edge_edge(pair.a, pair.b);
    } else if (da == 0 || db == 0) {
      const bool swapped = da != 0;
      found = vertex_and(swapped ? 1 : 0, swapped ? pair.b : pair.a, swapped ? pair.a : pair.b);
      if (found && swapped) std::swap(found->on_a, found->on_b);
    } else if (da + db == 3) {
      if (pierces(da == 1 ? 0 : 1, da == 1 ? pair.a : pair.b, da == 1 ? pair.b : pair.a)) pair.distance = 0.0;
    }
    if (!found) return;
    const double distance = std::ldexp(rounded_root(found->squared), exponent_);
    if (distance > pair.distance) return;
    pair.distance = distance;
    pair.critical = true;
    pair.p = foot(0, pair.a, found->on_a);
    pair.q = foot(1, pair.b, found->on_b);
    if (da == 2) pair.p = foot_in_plane(pair.q, cells_[0]->triangle(pair.a));
    if (db == 2) pair.q = foot_in_plane(pair.p, cells_[1]->triangle(pair.b));
  }

 private:
  const Point& point(std::size_t mesh, std::int32_t cell, std::size_t corner) const {
    return points_[mesh][static_cast<std::size_t>(cells_[mesh]->corners(cell)[corner])];
  }
  const Vec3& rough(std::size_t mesh, std::int32_t cell, std::size_t corner) const {
    return cells_[mesh]->vertex(cells_[mesh]->corners(cell)[corner]);
  }

  Vec3 foot(std::size_t mesh, std::int32_t cell, double along) const {
    const Vec3& first = rough(mesh, cell, 0);
    return cells_[mesh]->dimension(cell) == 1 ? Vec3(first + along * (rough(mesh, cell, 1) - first)) : first;
  }
  static Vec3 foot_in_plane(const Vec3& p, const Triangle& t) {
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    return p - n.dot(p - t[0]) * n;
  }

  /// A vertex of `mesh` against a cell of the other one.
  std::optional<Critical> vertex_and(std::size_t mesh, std::int32_t vertex, std::int32_t cell) const {
    const std::size_t other = 1 - mesh;
    const Point& v = point(mesh, vertex, 0);
    const Vec3& rough_v = rough(mesh, vertex, 0);
    switch (cells_[other]->dimension(cell)) {
      case 0: {
        return Critical{CGAL::Gmpq(Integer((v - point(other, cell, 0)).squared_length()))};
      }
      case 1: {
        const Vec3 way = rough(other, cell, 1) - rough(other, cell, 0);
        const double part = way.dot(rough_v - rough(other, cell, 0)) / way.squaredNorm();
        if (part < -SURELY || part > 1.0 + SURELY) return std::nullopt;
        const Vector u = point(other, cell, 1) - point(other, cell, 0), w = v - point(other, cell, 0);
        const Integer along = w * u, whole = u * u;
        if (!(along > 0 && along < whole)) return std::nullopt;
        return Critical{CGAL::Gmpq(Integer(w.squared_length() * whole - along * along), whole), 0.0,
                        ratio(along, whole)};
      }
      default:
        return vertex_triangle(v, rough_v, other, cell);
    }
  }

  std::optional<Critical> vertex_triangle(const Point& v, const Vec3& rough_v, std::size_t other,
                                          std::int32_t cell) const {
    const Triangle t = cells_[other]->triangle(cell);
    const Vec3 normal = cells_[other]->normal(cell);
    for (std::size_t i = 0; i < 3; ++i)
      if (normal.dot((t[(i + 1) % 3] - t[i]).cross(rough_v - t[i])) < -SURELY * normal.squaredNorm())
        return std::nullopt;
    const std::array corner = {point(other, cell, 0), point(other, cell, 1), point(other, cell, 2)};
    const Vector n = CGAL::cross_product(corner[1] - corner[0], corner[2] - corner[0]);
    for (std::size_t i = 0; i < 3; ++i)
      if (!(n * CGAL::cross_product(corner[(i + 1) % 3] - corner[i], v - corner[i]) > 0)) return std::nullopt;
    const Integer height = (v - corner[0]) * n;
    return Critical{CGAL::Gmpq(Integer(height * height), Integer(n.squared_length()))};
  }

  std::optional<Critical> edge_edge(std::int32_t a, std::int32_t b) const {
    const Vec3 rough_u = rough(0, a, 1) - rough(0, a, 0), rough_v = rough(1, b, 1) - rough(1, b, 0);
    const Vec3 rough_w = rough(1, b, 0) - rough(0, a, 0), rough_n = rough_u.cross(rough_v);
    if (rough_n.squaredNorm() > SURELY * rough_u.squaredNorm() * rough_v.squaredNorm()) {
      const double s = rough_w.cross(rough_v).dot(rough_n) / rough_n.squaredNorm();
      const double t = rough_w.cross(rough_u).dot(rough_n) / rough_n.squaredNorm();
      if (std::max(std::abs(s - 0.5), std::abs(t - 0.5)) > 0.5 + SURELY) return std::nullopt;
    }
    const Vector u = point(0, a, 1) - point(0, a, 0), v = point(1, b, 1) - point(1, b, 0);
    const Vector w = point(1, b, 0) - point(0, a, 0), n = CGAL::cross_product(u, v);
    const Integer whole = n.squared_length();
    if (whole == 0) return std::nullopt;
    const Integer s = CGAL::cross_product(w, v) * n;
    if (!(s > 0 && s < whole)) return std::nullopt;
    const Integer t = CGAL::cross_product(w, u) * n;
    if (!(t > 0 && t < whole)) return std::nullopt;
    const Integer height = w * n;
    return Critical{CGAL::Gmpq(Integer(height * height), whole), ratio(s, whole), ratio(t, whole)};
  }

  /// Whether an edge of `mesh` passes through the inside of a triangle of the other one.
  bool pierces(std::size_t mesh, std::int32_t edge, std::int32_t triangle) const {
    const std::size_t other = 1 - mesh;
    const Triangle t = cells_[other]->triangle(triangle);
    const Vec3 normal = cells_[other]->normal(triangle);
    const double from = normal.dot(rough(mesh, edge, 0) - t[0]), to = normal.dot(rough(mesh, edge, 1) - t[0]);
    const double sure = SURELY * normal.norm() * 1e-3;
    if ((from > sure && to > sure) || (from < -sure && to < -sure)) return false;
    const Point &p = point(mesh, edge, 0), &q = point(mesh, edge, 1);
    const std::array corner = {point(other, triangle, 0), point(other, triangle, 1),
                               point(other, triangle, 2)};
    const Vector n = CGAL::cross_product(corner[1] - corner[0], corner[2] - corner[0]);
    if (CGAL::sign(n * (p - corner[0])) * CGAL::sign(n * (q - corner[0])) != CGAL::NEGATIVE) return false;
    const auto turn = [&](std::size_t i) {
      return CGAL::sign((q - p) * CGAL::cross_product(corner[i] - p, corner[(i + 1) % 3] - p));
    };
    return turn(0) != CGAL::ZERO && turn(0) == turn(1) && turn(1) == turn(2);
  }

  std::array<const Cells*, 2> cells_;
  int exponent_;
  std::array<std::vector<Point>, 2> points_;
};

}  // namespace

Cells::Cells(const Surface& surface, const RigidTransform& X_WS) : surface_(surface) {
  for (const Vec3& p : surface.mesh.vertices) vertices_W_.push_back(X_WS.point(p));
  const auto vertices = static_cast<std::int32_t>(vertices_W_.size());
  for (std::int32_t v = 0; v < vertices; ++v) corners_.push_back({v, -1, -1});
  for (const auto& ends : surface.adjacency.edges) corners_.push_back({ends[0], ends[1], -1});
  for (const auto& corners : surface.mesh.triangles) corners_.push_back(corners);
  facets_.resize(corners_.size());
  for (std::size_t e = 0; e < surface.adjacency.edges.size(); ++e)
    facets_[vertices_W_.size() + e] = {surface.adjacency.edges[e][0], surface.adjacency.edges[e][1]};
  const std::size_t first_triangle = vertices_W_.size() + surface.adjacency.edges.size();
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
    for (const std::int32_t edge : surface.adjacency.triangle_edges[t])
      facets_[first_triangle + t].push_back(vertices + edge);
  cofaces_.resize(corners_.size());
  for (std::size_t cell = 0; cell < facets_.size(); ++cell)
    for (const std::int32_t facet : facets_[cell])
      cofaces_[static_cast<std::size_t>(facet)].push_back(static_cast<std::int32_t>(cell));
}

FeatureId Cells::id(std::int32_t cell) const {
  const auto vertices = static_cast<std::int32_t>(vertices_W_.size()),
             edges = surface_.adjacency.edge_count();
  if (cell < vertices) return {FeatureKind::VERTEX, cell};
  if (cell < vertices + edges) return {FeatureKind::EDGE, cell - vertices};
  return {FeatureKind::FACE, cell - vertices - edges};
}

std::int32_t Cells::number(const FeatureId& id) const {
  if (id.kind == FeatureKind::VERTEX) return id.index;
  const auto vertices = static_cast<std::int32_t>(vertices_W_.size());
  return id.index + vertices + (id.kind == FeatureKind::FACE ? surface_.adjacency.edge_count() : 0);
}

std::span<const std::int32_t> Cells::corners(std::int32_t cell) const {
  return {corners_[static_cast<std::size_t>(cell)].data(), static_cast<std::size_t>(dimension(cell)) + 1};
}

Triangle Cells::triangle(std::int32_t cell) const {
  const auto& [a, b, c] = corners_[static_cast<std::size_t>(cell)];
  return {vertex(a), vertex(b), vertex(c)};
}

Vec3 Cells::normal(std::int32_t cell) const {
  const Triangle t = triangle(cell);
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

double Cells::side(std::int32_t cell, const Vec3& direction_W) const {
  Vec3 sum = Vec3::Zero();
  switch (dimension(cell)) {
    case 2:
      sum = normal(cell);
      break;
    case 1:
      for (const std::int32_t triangle : cofaces(cell)) sum += normal(triangle).normalized();
      break;
    default:
      for (const std::int32_t triangle : surface_.adjacency.vertex_triangles[cell]) {
        const std::int32_t face = number({FeatureKind::FACE, triangle});
        auto order = corners_[static_cast<std::size_t>(face)];
        while (order[0] != cell) std::rotate(order.begin(), order.begin() + 1, order.end());
        const Vec3 u = vertex(order[1]) - vertex(cell), v = vertex(order[2]) - vertex(cell);
        sum += std::atan2(u.cross(v).norm(), u.dot(v)) * normal(face).normalized();
      }
  }
  return sum.normalized().dot(direction_W.normalized());
}

CellPairs::CellPairs(const Cells& a, const Cells& b, double reach) : a_(a), b_(b) {
  const CriticalPairs exactly(a, b);
  constexpr std::array KINDS = {FeatureKind::VERTEX, FeatureKind::EDGE, FeatureKind::FACE};
  for (int dimension = 0; dimension <= 4; ++dimension) {
    for (const FeatureKind kind_a : KINDS) {
      const int rest = dimension - static_cast<int>(kind_a);
      if (rest < 0 || rest > 2) continue;
      const FeatureKind kind_b = KINDS[static_cast<std::size_t>(rest)];
      for_each_near(feature_boxes(a.surface(), a.vertices_W(), kind_a),
                    feature_boxes(b.surface(), b.vertices_W(), kind_b), reach,
                    [&](std::int32_t i, std::int32_t j) {
                      CellPair pair;
                      pair.a = a.number({kind_a, i});
                      pair.b = b.number({kind_b, j});
                      const auto least = [&](std::optional<std::size_t> smaller) {
                        if (smaller) pair.distance = std::min(pair.distance, pairs_[*smaller].distance);
                      };
                      for (const std::int32_t facet : a.facets(pair.a)) least(find(facet, pair.b));
                      for (const std::int32_t facet : b.facets(pair.b)) least(find(pair.a, facet));
                      exactly.fill(pair);
                      if (!(pair.distance <= reach)) return;
                      index_.emplace(key(pair.a, pair.b), pairs_.size());
                      pairs_.push_back(pair);
                    });
    }
  }
}

std::uint64_t CellPairs::key(std::int32_t a, std::int32_t b) const {
  return static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b_.count()) +
         static_cast<std::uint64_t>(b);
}

std::optional<std::size_t> CellPairs::find(std::int32_t a, std::int32_t b) const {
  const auto found = index_.find(key(a, b));
  if (found == index_.end()) return std::nullopt;
  return found->second;
}

}  // namespace lmdbench::exact
