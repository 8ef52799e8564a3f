// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_sides.h>
#include <lmdbench/mesh/flat_triangles.h>
#include <lmdbench/mesh/short_edges.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/flat_regions.h>
#include <lmdbench/shape/flatten.h>
#include <lmdbench/shape/planar_faces.h>

#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

namespace lmdbench {

namespace {

/// Roundings of a double at the largest coordinate within which a plane is flat already.
constexpr double FLAT_ULPS = 16.0;
/// Neighbours within this many tolerances of one plane tell how many are within one by chance.
constexpr double BAND = 10.0;
/// Faces of a size count where there are more than this many times as many as by chance.
constexpr double EVIDENCE = 4.0;
/// Places round a face of four where chance may add a fifth vertex.
constexpr double PLACES = 8.0;
/// The plane of a triangle lower than this many tolerances is noise.
constexpr double LEAST_ALTITUDE = 16.0;
/// Planes at a smaller angle (a sine) are one if their points agree.
constexpr double SAME_PLANE_SINE = 1e-3;

/// Edges that are no longer, of the mesh's diagonal, are rounding: bringing their ends together
/// leaves flat what is flat to FLATNESS.
constexpr double SHORT_EDGE = FLATNESS / 16.0;

/// A plane for vertices.
struct Constraint {
  Plane plane;
  std::vector<std::int32_t> vertices;
  bool stands = true;
  bool was_joined = false;  ///< Of several faces.
};

Plane fitted(const TriangleMesh& mesh, const std::vector<std::int32_t>& vertices, const Vec3& towards) {
  std::vector<Vec3> points;
  for (const std::int32_t v : vertices) points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  return fit_plane(points, towards).plane;
}

/// Whether vertices are within the tolerance of a plane.
bool all_near(const TriangleMesh& mesh, const std::vector<std::int32_t>& vertices, const Plane& plane,
              double tolerance) {
  return std::ranges::all_of(vertices, [&](std::int32_t v) {
    return std::abs(plane.height(mesh.vertices[static_cast<std::size_t>(v)])) <= tolerance;
  });
}

/// Pairs of neighbouring triangles, in all and between 1 and BAND tolerances from one plane.
struct Coplanarity {
  std::size_t pairs = 0, in_band = 0;
  /// Chance of a pair to be within one tolerance, if heights near 0 are evenly distributed.
  double chance() const {
    return pairs == 0 ? 0.0 : static_cast<double>(in_band) / (BAND - 1.0) / static_cast<double>(pairs);
  }
};

Coplanarity coplanarity(const Surface& surface, double tolerance) {
  Coplanarity result;
  for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e) {
    const auto edge = static_cast<std::size_t>(e);
    if (surface.edge_is_boundary[edge] || surface.edge_is_non_manifold[edge]) continue;
    const auto triangles = surface.adjacency.edge_triangles[e];
    const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(surface.adjacency.edges[edge][0])];
    const Vec3& q = surface.mesh.vertices[static_cast<std::size_t>(surface.adjacency.edges[edge][1])];
    // The far corners of both triangles, against the plane of the other.
    double least = std::numeric_limits<double>::infinity(), height = 0.0;
    std::array<Vec3, 2> apex{p, p};
    for (const std::size_t k : {0u, 1u})
      for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangles[k])])
        if (corner != surface.adjacency.edges[edge][0] && corner != surface.adjacency.edges[edge][1])
          apex[k] = surface.mesh.vertices[static_cast<std::size_t>(corner)];
    const Vec3 along = (q - p).stableNormalized();
    std::array<double, 2> altitude{};
    for (const std::size_t k : {0u, 1u}) {
      altitude[k] = ((apex[k] - p) - along.dot(apex[k] - p) * along).norm();
      least = std::min(least, altitude[k]);
    }
    if (!(least > LEAST_ALTITUDE * tolerance)) continue;
    for (const std::size_t k : {0u, 1u}) {
      const Vec3& normal = surface.face_normals[static_cast<std::size_t>(triangles[1 - k])];
      // A rounded plane is off by more at a farther corner.
      const double widened = 1.0 + altitude[k] / altitude[1 - k];
      height = std::max(height, std::abs(normal.dot(apex[k] - p)) / widened);
    }
    ++result.pairs;
    if (height > tolerance && height <= BAND * tolerance) ++result.in_band;
  }
  return result;
}

/// Whether two faces are the sides of a plate so thin that its walls may face any way.
bool are_sides_of_plate(const TriangleMesh& mesh, const PlanarFace& a, const PlanarFace& b,
                        double tolerance) {
  return a.plane.normal.dot(b.plane.normal) < 0.0 &&
         a.plane.normal.cross(b.plane.normal).norm() <= SAME_PLANE_SINE &&
         all_near(mesh, a.vertices, b.plane, LEAST_ORIENTED_ALTITUDE * tolerance);
}

/// Takes the walls of such plates out of their sides, which would be put into one plane with them.
void take_out_walls(const Surface& surface, double tolerance, std::vector<PlanarFace>& faces) {
  const TriangleMesh& mesh = surface.mesh;
  const auto is_noise = [&](std::int32_t t) {
    return least_altitude(mesh.triangle(t)) <= LEAST_ORIENTED_ALTITUDE * tolerance;
  };
  std::vector<std::size_t> face_of(mesh.triangles.size(), faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const std::int32_t t : faces[f].triangles) face_of[static_cast<std::size_t>(t)] = f;
  for (PlanarFace& face : faces) {
    if (face.vertices.size() <= 3 || std::ranges::none_of(face.triangles, is_noise)) continue;
    const bool is_side = std::ranges::any_of(face.vertices, [&](std::int32_t v) {
      return std::ranges::any_of(surface.adjacency.vertex_triangles[v], [&](std::int32_t t) {
        const std::size_t other = face_of[static_cast<std::size_t>(t)];
        return other < faces.size() && !is_noise(t) &&
               are_sides_of_plate(mesh, face, faces[other], tolerance);
      });
    });
    if (!is_side) continue;
    face.vertices.clear();
    for (const std::int32_t t : face.triangles)
      if (!is_noise(t))
        face.vertices.insert(face.vertices.end(), mesh.triangles[static_cast<std::size_t>(t)].begin(),
                             mesh.triangles[static_cast<std::size_t>(t)].end());
    std::ranges::sort(face.vertices);
    face.vertices.erase(std::unique(face.vertices.begin(), face.vertices.end()), face.vertices.end());
    if (face.vertices.size() > 3) face.plane = fitted(mesh, face.vertices, face.plane.normal);
  }
}

/// Faces of four and more vertices that chance does not explain.
/// @param of_chance  the number of others
std::vector<Constraint> find_constraints(const Surface& surface, double tolerance, std::int64_t& of_chance) {
  std::vector<PlanarFace> faces = planar_faces(surface, tolerance);
  take_out_walls(surface, tolerance, faces);
  std::map<std::size_t, std::size_t> count_of_spare;  // faces by vertices more than three
  for (const PlanarFace& face : faces)
    if (face.vertices.size() > 3) ++count_of_spare[face.vertices.size() - 3];
  const Coplanarity pairs = coplanarity(surface, tolerance);
  const double one_spare = pairs.chance() * static_cast<double>(pairs.pairs);
  const auto by_chance = [&](std::size_t spare) {
    return one_spare * std::pow(std::min(1.0, PLACES * pairs.chance()), static_cast<double>(spare - 1));
  };
  std::vector<Constraint> constraints;
  for (PlanarFace& face : faces) {
    if (face.vertices.size() <= 3) continue;
    const std::size_t spare = face.vertices.size() - 3;
    if (!(static_cast<double>(count_of_spare[spare]) > EVIDENCE * by_chance(spare))) {
      ++of_chance;
      continue;
    }
    constraints.push_back({face.plane, std::move(face.vertices), true});
  }
  return constraints;
}

/// Planes through each vertex, ascending.
std::vector<std::vector<std::size_t>> planes_of_vertices(const TriangleMesh& mesh,
                                                         const std::vector<Constraint>& constraints) {
  std::vector<std::vector<std::size_t>> planes(mesh.vertices.size());
  for (std::size_t c = 0; c < constraints.size(); ++c)
    if (constraints[c].stands)
      for (const std::int32_t v : constraints[c].vertices) planes[static_cast<std::size_t>(v)].push_back(c);
  return planes;
}

/// Joins faces that meet in a vertex and are in one plane: two planes a rounding apart share no
/// sensible line.
class CoplanarJoining {
 public:
  CoplanarJoining(const TriangleMesh& mesh, std::vector<Constraint>& constraints, double tolerance)
      : mesh_(mesh), constraints_(constraints), tolerance_(tolerance), into_(constraints.size()) {
    std::iota(into_.begin(), into_.end(), std::size_t{0});
  }

  void run() {
    for (const auto& at_vertex : planes_of_vertices(mesh_, constraints_))
      for (std::size_t i = 0; i < at_vertex.size(); ++i)
        for (std::size_t j = i + 1; j < at_vertex.size(); ++j)
          try_to_join(root(at_vertex[i]), root(at_vertex[j]));
    for (Constraint& constraint : constraints_) {
      if (constraint.was_joined)
        constraint.plane = fitted(mesh_, constraint.vertices, constraint.plane.normal);
      std::sort(constraint.vertices.begin(), constraint.vertices.end());
      constraint.vertices.erase(std::unique(constraint.vertices.begin(), constraint.vertices.end()),
                                constraint.vertices.end());
    }
  }

 private:
  /// A face with fewer than this part of the other's vertices must fit into the other's plane:
  /// fitting both anew for each of a plate's thousands of faces takes the square of their number.
  static constexpr std::size_t SMALL_PART = 8;

  std::size_t root(std::size_t c) {
    while (into_[c] != c) c = into_[c] = into_[into_[c]];
    return c;
  }

  void try_to_join(std::size_t a, std::size_t b) {
    if (a == b) return;
    Constraint& first = constraints_[std::min(a, b)];
    Constraint& second = constraints_[std::max(a, b)];
    if (first.plane.normal.cross(second.plane.normal).norm() > SAME_PLANE_SINE ||
        !(first.plane.normal.dot(second.plane.normal) > 0.0))
      return;
    const bool first_is_large = first.vertices.size() >= second.vertices.size();
    const Constraint &large = first_is_large ? first : second, &small = first_is_large ? second : first;
    Plane plane = large.plane;
    if (SMALL_PART * small.vertices.size() > large.vertices.size()) {
      std::vector<std::int32_t> both = large.vertices;
      both.insert(both.end(), small.vertices.begin(), small.vertices.end());
      plane = fitted(mesh_, both, first.plane.normal);
      if (!all_near(mesh_, both, plane, tolerance_)) return;
    } else if (!all_near(mesh_, small.vertices, plane, tolerance_)) {
      return;
    }
    if (!first_is_large) first.vertices.swap(second.vertices);
    first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
    first.plane = plane;
    first.was_joined = true;
    second = Constraint{second.plane, {}, false};
    into_[std::max(a, b)] = std::min(a, b);
  }

  const TriangleMesh& mesh_;
  std::vector<Constraint>& constraints_;
  double tolerance_;
  std::vector<std::size_t> into_;
};

/// The nearest point that lies in all planes; nothing where they share none.
std::optional<Vec3> put_into(const Vec3& p, const std::vector<std::size_t>& planes,
                             const std::vector<Constraint>& constraints, double flat) {
  Vec3 moved = p;
  if (planes.size() == 1) {
    const Plane& plane = constraints[planes[0]].plane;
    for (int step = 0; step < 2; ++step) moved -= plane.height(moved) * plane.normal;
    return moved;
  }
  Eigen::MatrixXd normals(planes.size(), 3);
  for (std::size_t i = 0; i < planes.size(); ++i)
    normals.row(static_cast<Eigen::Index>(i)) = constraints[planes[i]].plane.normal.transpose();
  // Thin: a full U would be square in the planes, and the hub of a fan may have thousands.
  Eigen::JacobiSVD<Eigen::MatrixXd> solver(normals, Eigen::ComputeThinU | Eigen::ComputeThinV);
  solver.setThreshold(1e-6);
  Eigen::VectorXd heights(planes.size());
  // The second step removes the rounding of the first.
  for (int step = 0; step < 3; ++step) {
    for (std::size_t i = 0; i < planes.size(); ++i)
      heights[static_cast<Eigen::Index>(i)] = constraints[planes[i]].plane.height(moved);
    if (step == 2) break;
    moved -= solver.solve(heights);
  }
  if (!(heights.cwiseAbs().maxCoeff() <= flat)) return std::nullopt;
  return moved;
}

/// A mesh numbered in an order that its coordinates alone decide.
struct OrderedMesh {
  TriangleMesh mesh;
  std::vector<std::int32_t> vertices;  ///< Of the original mesh, in this order.
};

OrderedMesh in_order_of_coordinates(const TriangleMesh& mesh) {
  OrderedMesh ordered;
  ordered.vertices.resize(mesh.vertices.size());
  std::iota(ordered.vertices.begin(), ordered.vertices.end(), 0);
  const auto point = [&](std::int32_t v) {
    const Vec3& p = mesh.vertices[static_cast<std::size_t>(v)];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::ranges::stable_sort(ordered.vertices, {}, point);
  std::vector<std::int32_t> place(mesh.vertices.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto v = static_cast<std::size_t>(ordered.vertices[i]);
    place[v] = static_cast<std::int32_t>(i);
    ordered.mesh.vertices.push_back(mesh.vertices[v]);
  }
  for (auto triangle : mesh.triangles) {
    for (std::int32_t& corner : triangle) corner = place[static_cast<std::size_t>(corner)];
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    ordered.mesh.triangles.push_back(triangle);
  }
  std::ranges::sort(ordered.mesh.triangles);
  return ordered;
}

/// Puts vertices into their planes. Gives up planes that pull one too far, and starts again.
std::vector<Vec3> put_back(const TriangleMesh& mesh, std::vector<Constraint>& constraints, double tolerance,
                           double flat) {
  std::vector<Vec3> moved;
  for (bool settled = false; !settled;) {
    settled = true;
    moved = mesh.vertices;
    const auto planes = planes_of_vertices(mesh, constraints);
    for (std::size_t v = 0; v < moved.size(); ++v) {
      const Vec3& p = mesh.vertices[v];
      // Another vertex may have just given up one of the planes: left to the next round.
      if (planes[v].empty() || std::any_of(planes[v].begin(), planes[v].end(),
                                           [&](std::size_t c) { return !constraints[c].stands; }))
        continue;
      const std::optional<Vec3> target = put_into(p, planes[v], constraints, flat);
      if (target && (*target - p).norm() <= LARGEST_MOVE * tolerance) {
        moved[v] = *target;
        continue;
      }
      const std::size_t weakest =
          *std::min_element(planes[v].begin(), planes[v].end(), [&](std::size_t a, std::size_t b) {
            return constraints[a].vertices.size() < constraints[b].vertices.size();
          });
      constraints[weakest].stands = false;
      settled = false;
    }
  }
  return moved;
}

}  // namespace

FlatteningReport flatten(TriangleMesh& mesh, const PlanarTolerance& choice, bool flips) {
  FlatteningReport report;
  report.tolerance = choice.length(mesh);
  if (flips) {
    // Of single precision: the sides of a thinner plate may have changed places.
    const double of_floats = choice.kind == PlanarTolerance::Kind::AUTO ? 0.5 * report.tolerance : 0.0;
    report.collapsed_triangles =
        collapse_short_edges(mesh, std::max(of_floats, SHORT_EDGE * bounding_box_diagonal(mesh)));
    report.flipped_triangles =
        flip_flat_triangles(mesh, std::max(report.tolerance, FLATNESS * largest_coordinate(mesh.vertices)));
  }
  if (!(report.tolerance > 0.0)) return report;
  const double flat = FLAT_ULPS * std::numeric_limits<double>::epsilon() * largest_coordinate(mesh.vertices);
  if (report.tolerance <= flat) return report;
  // Faces grow, join and are given up in the order of coordinates, not of the file.
  const OrderedMesh ordered = in_order_of_coordinates(mesh);
  std::int64_t of_chance = 0;
  std::vector<Constraint> constraints =
      find_constraints(build_surface(ordered.mesh), report.tolerance, of_chance);
  if (choice.kind != PlanarTolerance::Kind::AUTO) {
    report.faces_of_chance = of_chance;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (least_altitude(mesh.triangle(static_cast<std::int32_t>(t))) <= LEAST_ALTITUDE * report.tolerance)
        ++report.triangles_of_noise;
  }
  CoplanarJoining(ordered.mesh, constraints, report.tolerance).run();
  const std::vector<Vec3> moved = put_back(ordered.mesh, constraints, report.tolerance, flat);
  for (std::size_t i = 0; i < moved.size(); ++i)
    report.largest_move = std::max(report.largest_move, (moved[i] - ordered.mesh.vertices[i]).norm());
  if (report.largest_move <= flat) {
    report.largest_move = 0.0;
    return report;
  }
  report.planes = std::count_if(constraints.begin(), constraints.end(),
                                [](const Constraint& constraint) { return constraint.stands; });
  for (std::size_t i = 0; i < moved.size(); ++i) {
    Vec3& vertex = mesh.vertices[static_cast<std::size_t>(ordered.vertices[i])];
    if (moved[i] != vertex) ++report.moved_vertices;
    vertex = moved[i];
  }
  mesh.planar_tolerance = report.tolerance;
  return report;
}

std::string repairs_text(const FlatteningReport& report) {
  std::string text;
  if (report.collapsed_triangles > 0)
    text = fmt::format("{} triangle{} with a side as short as rounding collapsed", report.collapsed_triangles,
                       report.collapsed_triangles == 1 ? "" : "s");
  if (report.flipped_triangles > 0)
    text += fmt::format("{}{} flat triangle{}, which close{} T junctions, flipped with the faces beside",
                        text.empty() ? "" : "; ", report.flipped_triangles,
                        report.flipped_triangles == 1 ? "" : "s", report.flipped_triangles == 1 ? "s" : "");
  return text;
}

std::string to_text(const FlatteningReport& report) {
  if (!(report.tolerance > 0.0)) return "taken as they are (planar tolerance 0)";
  std::string left;
  if (report.faces_of_chance > 0)
    left = fmt::format("; {} face{} within it of a plane {} left, as chance explains as many",
                       report.faces_of_chance, report.faces_of_chance == 1 ? "" : "s",
                       report.faces_of_chance == 1 ? "is" : "are");
  if (report.triangles_of_noise > 0 && report.moved_vertices == 0)
    left += fmt::format("; {} triangles are lower than {:g} tolerances, so that their planes are noise",
                        report.triangles_of_noise, LEAST_ALTITUDE);
  if (!left.empty())
    left +=
        fmt::format(" (remedy: {} planar tolerance)", report.moved_vertices > 0 ? "another" : "a smaller");
  if (report.moved_vertices == 0)
    return fmt::format("no vertex {} put back into a plane (tolerance {:.3g}){}",
                       left.empty() ? "had to be" : "was", report.tolerance, left);
  // A vertex on several planes moves farther than its distance from each.
  return fmt::format(
      "{} vertices put back into {} planes that they were within {:.3g} of; the farthest moved by {:.3g} "
      "(allowed: {:.3g}){}",
      report.moved_vertices, report.planes, report.tolerance, report.largest_move,
      LARGEST_MOVE * report.tolerance, left);
}

}  // namespace lmdbench
