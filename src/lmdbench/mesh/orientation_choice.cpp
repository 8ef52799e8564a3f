// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/mesh/adjacency.h>
#include <lmdbench/mesh/orientation_choice.h>
#include <lmdbench/mesh/triangle_normal.h>
#include <lmdbench/mesh/winding_number.h>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using Corners = std::array<std::int32_t, 3>;

/// Triangles that are connected over edges of two triangles.
struct Piece {
  std::vector<std::int32_t> triangles;
  bool closed = true;
  Eigen::AlignedBox3d box;
  double volume = 0.0, area = 0.0;
  /// Over the 3/2 power of the area.
  double relative_volume() const { return area > 0.0 ? volume / std::pow(area, 1.5) : 0.0; }
};

bool runs_along(const Corners& corners, std::int32_t from, std::int32_t to) {
  for (std::size_t k = 0; k < 3; ++k)
    if (corners[k] == from && corners[(k + 1) % 3] == to) return true;
  return false;
}

void turn(Corners& corners) {
  std::swap(corners[1], corners[2]);
}

/// Whether two triangles run along their common edge in opposite directions.
bool agree(const TriangleMesh& mesh, const std::array<std::int32_t, 2>& edge, std::int32_t a,
           std::int32_t b) {
  const bool first = runs_along(mesh.triangles[static_cast<std::size_t>(a)], edge[0], edge[1]);
  const bool second = runs_along(mesh.triangles[static_cast<std::size_t>(b)], edge[0], edge[1]);
  return first != second;
}

/// A piece with a border has an edge at which an odd number of its own triangles meet; those of
/// another piece that touches it there do not count.
void find_borders(std::vector<Piece>& pieces, const Adjacency& adjacency) {
  std::vector<std::size_t> piece_of(adjacency.triangle_edges.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const std::int32_t t : pieces[i].triangles) piece_of[static_cast<std::size_t>(t)] = i;
  std::vector<std::size_t> around;
  for (std::int32_t e = 0; e < adjacency.edge_count(); ++e) {
    around.clear();
    for (const std::int32_t t : adjacency.edge_triangles[e])
      around.push_back(piece_of[static_cast<std::size_t>(t)]);
    for (const std::size_t i : around)
      if (std::ranges::count(around, i) % 2 != 0) pieces[i].closed = false;
  }
}

Vec3 centroid(const TriangleMesh& mesh, const Piece& piece) {
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (const std::int32_t t : piece.triangles) {
    const Triangle c = mesh.triangle(t);
    const double size = (c[1] - c[0]).cross(c[2] - c[0]).norm();
    sum += size * (c[0] + c[1] + c[2]) / 3.0;
    area += size;
  }
  return area > 0.0 ? Vec3(sum / area) : Vec3(Vec3::Zero());
}

/// Signed volume of the cone over the piece from its centroid, and its area.
void measure_piece(const TriangleMesh& mesh, Piece& piece) {
  const Vec3 centre = centroid(mesh, piece);
  for (const std::int32_t t : piece.triangles) {
    const Triangle c = mesh.triangle(t);
    piece.volume += (c[0] - centre).dot((c[1] - centre).cross(c[2] - centre)) / 6.0;
    piece.area += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
  }
}

/// Makes the triangles of every piece agree, as far as possible.
std::vector<Piece> agreeing_pieces(TriangleMesh& mesh, const Adjacency& adjacency) {
  std::vector<Piece> pieces;
  std::vector<bool> seen(mesh.triangles.size(), false);
  for (std::size_t first = 0; first < mesh.triangles.size(); ++first) {
    if (seen[first]) continue;
    Piece piece;
    piece.triangles.push_back(static_cast<std::int32_t>(first));
    seen[first] = true;
    std::vector<std::int32_t> turned;
    for (std::size_t next = 0; next < piece.triangles.size(); ++next) {
      const std::int32_t t = piece.triangles[next];
      for (const std::int32_t e : adjacency.triangle_edges[static_cast<std::size_t>(t)]) {
        const auto around = adjacency.edge_triangles[e];
        if (around.size() != 2) continue;
        const std::int32_t other = around[0] == t ? around[1] : around[0];
        if (other == t || seen[static_cast<std::size_t>(other)]) continue;
        seen[static_cast<std::size_t>(other)] = true;
        piece.triangles.push_back(other);
        if (agree(mesh, adjacency.edges[static_cast<std::size_t>(e)], t, other)) continue;
        turn(mesh.triangles[static_cast<std::size_t>(other)]);
        turned.push_back(other);
      }
    }
    if (2 * turned.size() > piece.triangles.size())  // the first triangle was of the minority
      for (const std::int32_t t : piece.triangles) turn(mesh.triangles[static_cast<std::size_t>(t)]);
    for (const std::int32_t t : piece.triangles)
      for (const Vec3& corner : mesh.triangle(t)) piece.box.extend(corner);
    pieces.push_back(std::move(piece));
  }
  find_borders(pieces, adjacency);
  for (Piece& piece : pieces) measure_piece(mesh, piece);
  return pieces;
}

/// Points inside a closed piece, whichever way it is turned, near some of its triangles. A corner
/// may lie on another piece that it touches; these do not.
std::vector<Vec3> points_inside(const TriangleMesh& mesh, const Piece& piece) {
  constexpr double DEPTH = 1e-6;         // in diagonals
  constexpr std::size_t LOOKED_AT = 64;  // triangles
  const NearWinding own(mesh, piece.triangles);
  const std::size_t step = (piece.triangles.size() + LOOKED_AT - 1) / LOOKED_AT;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < piece.triangles.size(); i += step) {
    const Triangle c = mesh.triangle(piece.triangles[i]);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 point =
          (c[0] + c[1] + c[2]) / 3.0 + side * DEPTH * piece.box.diagonal().norm() * triangle_normal(c);
      if (std::abs(own.at(point)) <= 0.5) continue;
      points.push_back(point);
      break;
    }
  }
  return points;
}

/// Tells cavities. Pieces may touch; one that sticks out of another is not enclosed by it, nor is a
/// copy.
class Enclosures {
 public:
  Enclosures(const TriangleMesh& mesh, const std::vector<Piece>& pieces) : mesh_(mesh) {
    for (const Piece& piece : pieces)
      if (piece.closed) shells_.push_back({&piece, piece.box, {}});
    std::ranges::stable_sort(shells_, std::greater(),
                             [](const Shell& s) { return std::abs(s.piece->volume); });
  }

  /// Whether an odd number of other closed pieces enclose this one.
  bool is_cavity(const Piece& piece) {
    constexpr double LARGER = 1.0 + 1e-9;
    std::vector<Vec3> points;
    bool odd = false;
    for (Shell& shell : shells_) {
      if (!(std::abs(shell.piece->volume) > LARGER * std::abs(piece.volume))) break;
      if (!shell.box.contains(piece.box)) continue;
      if (points.empty()) points = points_inside(mesh_, piece);
      if (points.empty()) return false;
      if (!shell.winding) shell.winding.emplace(mesh_, shell.piece->triangles);
      if (std::ranges::all_of(points, [&](const Vec3& p) { return std::abs(shell.winding->at(p)) > 0.5; }))
        odd = !odd;
    }
    return odd;
  }

 private:
  struct Shell {
    const Piece* piece;
    Eigen::AlignedBox3d box;
    std::optional<NearWinding> winding;
  };
  const TriangleMesh& mesh_;
  std::vector<Shell> shells_;  ///< Closed pieces, the largest first.
};

}  // namespace

std::string_view to_string(OrientationChoice choice) {
  return choice == OrientationChoice::OUTWARD ? "outward" : "keep";
}

OrientationChoice parse_orientation(const std::string& text, const std::string& file,
                                    const std::string& place) {
  for (const OrientationChoice choice : {OrientationChoice::KEEP, OrientationChoice::OUTWARD})
    if (text == to_string(choice)) return choice;
  throw UsageError(file, place, fmt::format("'{}' is no orientation", text), "give keep or outward");
}

OrientationReport orient_outward(TriangleMesh& mesh) {
  return orient_outward(mesh, build_adjacency(mesh));
}

OrientationReport orient_outward(TriangleMesh& mesh, const Adjacency& adjacency) {
  const std::vector<Corners> before = mesh.triangles;
  const std::vector<Piece> pieces = agreeing_pieces(mesh, adjacency);
  OrientationReport report;
  report.choice = OrientationChoice::OUTWARD;
  report.pieces = static_cast<std::int64_t>(pieces.size());
  std::vector<bool> wrong(pieces.size(), false);
  Enclosures enclosures(mesh, pieces);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double volume = pieces[i].relative_volume();
    if (pieces[i].closed)
      wrong[i] = std::abs(volume) > ZERO_VOLUME && (volume < 0.0) != enclosures.is_cavity(pieces[i]);
    else if (std::abs(volume) < OPEN_VOLUME)
      ++report.pieces_undecided;
    else
      wrong[i] = volume < 0.0;
  }
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (wrong[i])
      for (const std::int32_t t : pieces[i].triangles) turn(mesh.triangles[static_cast<std::size_t>(t)]);
  for (std::size_t t = 0; t < before.size(); ++t)
    if (mesh.triangles[t] != before[t]) ++report.turned_triangles;
  for (std::int32_t e = 0; e < adjacency.edge_count(); ++e) {
    const auto around = adjacency.edge_triangles[e];
    if (around.size() == 2 && around[0] != around[1] &&
        !agree(mesh, adjacency.edges[static_cast<std::size_t>(e)], around[0], around[1]))
      ++report.disagreements;
  }
  return report;
}

std::string to_text(const OrientationReport& report) {
  if (report.choice == OrientationChoice::KEEP) return "as in the file";
  std::string text = report.turned_triangles == 0
                         ? "outward already, nothing turned"
                         : fmt::format("{} triangles turned outward", report.turned_triangles);
  if (report.pieces_undecided > 0)
    text += fmt::format("; {} of {} pieces are open sheets without an outer side", report.pieces_undecided,
                        report.pieces);
  if (report.disagreements > 0)
    text += fmt::format("; {} edges have no common side (as on a Moebius strip)", report.disagreements);
  return text;
}

}  // namespace lmdbench
