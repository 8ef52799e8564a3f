// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <study/completeness/metamorphic.h>
#include <support/parts/recut.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace lmdbench::completeness {
namespace {

using experiments::Random;

template <typename Place>
void move_vertices(TriangleMesh& mesh, const Place& place) {
  for (Vec3& p : mesh.vertices) p = place(p);
}

ScenePair swapped(const ScenePair& pair, Random& /*random*/, double& /*scale*/) {
  return {pair.fixed, pair.moving, pair.X_WM.inverse(), pair.cutoff, pair.open, pair.is_level};
}

ScenePair moved(const ScenePair& pair, Random& random, double& /*scale*/) {
  ScenePair result = pair;
  const double size = bounding_box_diagonal(pair.fixed);
  Pose X{size * random.uniform() * random.direction(), random.rotation()};
  move_vertices(result.fixed, [X = RigidTransform(X)](const Vec3& p) { return X.point(p); });
  result.X_WM = X * pair.X_WM;
  return result;
}

/// Both frames turned by a signed permutation. That is exact, but later sums of three products are
/// taken in another order.
ScenePair quarter_turned(const ScenePair& pair, Random& random, double& /*scale*/) {
  Mat3 turn = Mat3::Zero();
  const auto shift = static_cast<Eigen::Index>(random.index(3));
  const bool mirrored = random.index(2) == 0;
  for (Eigen::Index i = 0; i < 3; ++i)
    turn(i, mirrored ? (3 + shift - i) % 3 : (i + shift) % 3) = random.index(2) == 0 ? 1.0 : -1.0;
  if (turn.determinant() < 0.0) turn.row(0) *= -1.0;
  ScenePair result = pair;
  for (TriangleMesh* mesh : {&result.moving, &result.fixed})
    move_vertices(*mesh, [&](const Vec3& p) { return Vec3(turn * p); });
  result.X_WM.translation = turn * pair.X_WM.translation;
  result.X_WM.rotation.vec() = turn * pair.X_WM.rotation.vec();
  return result;
}

ScenePair scaled(const ScenePair& pair, Random& random, double& scale) {
  scale = std::ldexp(1.0, static_cast<int>(random.index(21)) - 10);
  return scaled_by(scale, pair);
}

template <TriangleMesh (*CHANGE)(TriangleMesh, Random&)>
ScenePair both(const ScenePair& pair, Random& random, double& /*scale*/) {
  ScenePair result = pair;
  for (TriangleMesh* mesh : {&result.moving, &result.fixed}) *mesh = CHANGE(std::move(*mesh), random);
  return result;
}

/// Adds a vertex between two or three of a triangle's. The same vertices always get the same one.
class NewVertices {
 public:
  explicit NewVertices(TriangleMesh& mesh) : mesh_(mesh) {}
  std::int32_t middle(std::int32_t a, std::int32_t b) {
    const auto [found, is_new] = of_edge_.try_emplace(std::minmax(a, b), 0);
    if (is_new) found->second = add(0.5 * (at(a) + at(b)));
    return found->second;
  }
  std::int32_t centroid(const std::array<std::int32_t, 3>& t) {
    return add((at(t[0]) + at(t[1]) + at(t[2])) / 3.0);
  }

 private:
  Vec3 at(std::int32_t v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }
  std::int32_t add(const Vec3& p) {
    mesh_.vertices.push_back(p);
    return static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
  }
  TriangleMesh& mesh_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> of_edge_;
};

TriangleMesh cut_in_four(TriangleMesh mesh, Random& /*random*/) {
  const auto triangles = std::exchange(mesh.triangles, {});
  NewVertices vertices(mesh);
  for (const auto& [a, b, c] : triangles) {
    const std::int32_t ab = vertices.middle(a, b), bc = vertices.middle(b, c), ca = vertices.middle(c, a);
    mesh.triangles.insert(mesh.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return mesh;
}

TriangleMesh cut_at_centroids(TriangleMesh mesh, Random& random) {
  const auto triangles = std::exchange(mesh.triangles, {});
  NewVertices vertices(mesh);
  for (const auto& t : triangles) {
    if (random.index(2) == 0) {
      mesh.triangles.push_back(t);
      continue;
    }
    const std::int32_t m = vertices.centroid(t);
    mesh.triangles.insert(mesh.triangles.end(), {{t[0], t[1], m}, {t[1], t[2], m}, {t[2], t[0], m}});
  }
  return mesh;
}

Eigen::AlignedBox3d world_box(const TriangleMesh& mesh, const Pose& X) {
  Eigen::AlignedBox3d box;
  const RigidTransform place(X);
  for (const Vec3& p : mesh.vertices) box.extend(place.point(p));
  return box;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Adds a box to each mesh, far from both, on opposite sides.
ScenePair with_far_parts(const ScenePair& pair, Random& random, double& /*scale*/) {
  ScenePair result = pair;
  const Eigen::AlignedBox3d all = world_box(pair.moving, pair.X_WM).merged(world_box(pair.fixed, {}));
  const double size = all.diagonal().norm();
  const Vec3 way = (2.0 * pair.cutoff + size) * random.direction();
  for (const bool moving : {true, false}) {
    TriangleMesh box = make_box(Vec3::Constant(0.2 * size), 2);
    const RigidTransform X(moving ? pair.X_WM.inverse() : Pose());
    move_vertices(box,
                  [&](const Vec3& p) { return X.point(p + all.center() + (moving ? way : Vec3(-way))); });
    append(moving ? result.moving : result.fixed, box);
  }
  return result;
}

/// Without the triangles that are far from the other mesh; vertices stay.
ScenePair without_far_triangles(const ScenePair& pair, Random& /*random*/, double& /*scale*/) {
  ScenePair result = pair;
  for (const bool moving : {true, false}) {
    const RigidTransform X(moving ? pair.X_WM : Pose());
    const Eigen::AlignedBox3d other = moving ? world_box(pair.fixed, {}) : world_box(pair.moving, pair.X_WM);
    TriangleMesh& mesh = moving ? result.moving : result.fixed;
    std::erase_if(mesh.triangles, [&](const auto& t) {
      Eigen::AlignedBox3d box;
      for (const std::int32_t v : t) box.extend(X.point(mesh.vertices[static_cast<std::size_t>(v)]));
      return box.exteriorDistance(other) > 2.0 * pair.cutoff;
    });
  }
  return result;
}

constexpr Change CHANGES[] = {
    {"swapped", false, swapped},
    {"moved as one", false, moved},
    {"turned by quarters", false, quarter_turned},
    {"scaled by a power of two", true, scaled},
    {"in another order", false, both<parts::reordered>},
    {"other diagonals", false, both<parts::other_diagonals>},
    {"cut in four", false, both<cut_in_four>},
    {"cut at centroids", false, both<cut_at_centroids>},
    {"far parts more", false, with_far_parts},
    {"far triangles less", false, without_far_triangles},
};

double largest_coordinate(const ScenePair& pair) {
  double largest = 0.0;
  for (const Vec3& p : pair.fixed.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  const RigidTransform X(pair.X_WM);
  for (const Vec3& p : pair.moving.vertices)
    largest = std::max({largest, p.cwiseAbs().maxCoeff(), X.point(p).cwiseAbs().maxCoeff()});
  return largest;
}

/// The definition's lengths (DEFINITION.md, "In floating-point numbers"), the larger of each.
constexpr double ROUNDING = 128.0 * std::numeric_limits<double>::epsilon(), KNOWN = 1e-9;
/// Factors of the tolerances that are tried where answers differ.
constexpr double WIDER[] = {1.0, 1.5, 4.0};
/// Distances up to so many roundings may belong to intersecting triangles.
constexpr double TOUCHING = 2.0;

/// Adds an unused vertex to each mesh, so that its largest coordinate, over `scale`, is `factor`
/// times that of the mesh in `like`: the definition's lengths are shares of it.
ScenePair grown_like(const ScenePair& pair, const ScenePair& like, double scale, double factor) {
  ScenePair result = pair;
  const auto grow = [&](TriangleMesh& mesh, const TriangleMesh& other) {
    double largest = 0.0;
    for (const Vec3& p : other.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    mesh.vertices.emplace_back(factor * largest / scale, 0.0, 0.0);
    mesh.planar_tolerance *= factor;
  };
  grow(result.moving, like.moving);
  grow(result.fixed, like.fixed);
  return result;
}

std::string text_of(const LmdSet& lmds) {
  std::string text;
  for (const Lmd& lmd : lmds)
    text +=
        fmt::format("    {}{}-{} {:.17g} at {:.9g} {:.9g} {:.9g}\n", lmd.intersecting ? "intersecting " : "",
                    to_string(lmd.feature_moving.kind), to_string(lmd.feature_fixed.kind), lmd.distance,
                    lmd.point_fixed.x(), lmd.point_fixed.y(), lmd.point_fixed.z());
  return text;
}

}  // namespace

std::span<const Change> metamorphic_changes() {
  return CHANGES;
}

MetamorphicCounts& MetamorphicCounts::operator+=(const MetamorphicCounts& other) {
  for (auto member :
       {&MetamorphicCounts::pairs, &MetamorphicCounts::different, &MetamorphicCounts::bits_different,
        &MetamorphicCounts::ties, &MetamorphicCounts::incomplete})
    this->*member += other.*member;
  return *this;
}

Scene scene_of(const ScenePair& pair) {
  return {std::make_shared<const Body>("moving", build_surface(pair.moving)),
          {std::make_shared<const Body>("fixed", build_surface(pair.fixed))},
          pair.cutoff};
}

ScenePair pair_of(const Scene& scene, const Pose& X_WM) {
  return {scene.moving->surface().mesh, scene.fixed[0]->surface().mesh, X_WM, scene.cutoff, {}, false};
}

ScenePair pair_of(const parts::RestScene& scene) {
  ScenePair pair = pair_of(scene.scene, scene.X_WM);
  pair.is_level = !scene.single_precision;
  for (const parts::RestPlace& place : scene.places)
    if (!place.demanded) pair.open.push_back(place.gap);
  return pair;
}

ScenePair scaled_by(double factor, ScenePair pair) {
  for (TriangleMesh* mesh : {&pair.moving, &pair.fixed}) {
    move_vertices(*mesh, [&](const Vec3& p) { return Vec3(factor * p); });
    mesh->planar_tolerance *= factor;
  }
  pair.X_WM.translation *= factor;
  pair.cutoff *= factor;
  return pair;
}

LmdSet set_of(const char* method, const ScenePair& pair) {
  return lmds_at(*make_method(method, scene_of(pair)), pair.X_WM);
}

Difference compare(const ScenePair& pair, const LmdSet& a, const LmdSet& b, double scale,
                   const Widths& widths) {
  Difference result;
  std::array<std::vector<double>, 2> distances;
  std::array<std::ptrdiff_t, 2> touching{};
  bool intersecting = false, extended = false;
  for (const std::size_t s : {0U, 1U})
    for (const Lmd& lmd : s == 0 ? a : b) {
      const double distance = lmd.distance / (s == 0 ? 1.0 : scale);
      intersecting = intersecting || lmd.intersecting;
      extended = extended || (lmd.feature_moving.kind != FeatureKind::VERTEX &&
                              lmd.feature_fixed.kind != FeatureKind::VERTEX);
      if (lmd.intersecting || distance <= TOUCHING * widths.rounding)
        ++touching[s];
      else
        distances[s].push_back(distance);
    }
  const double width = widths.rounding + (extended ? widths.known : 0.0);
  const auto is_open = [&](double distance) {
    return distance >= pair.cutoff - width || std::ranges::any_of(pair.open, [&](double open) {
             return std::abs(open - distance) <= 2.0 * width;
           });
  };
  // Both lists ascend.
  for (auto x = distances[0].begin(), y = distances[1].begin();
       x != distances[0].end() || y != distances[1].end();) {
    const bool first_alone = y == distances[1].end() || (x != distances[0].end() && *x < *y - width);
    const bool second_alone = x == distances[0].end() || (y != distances[1].end() && *y < *x - width);
    if (first_alone || second_alone) {
      const double alone = first_alone ? *x : *y;
      if (alone <= 2.0 * TOUCHING * widths.rounding)
        ++touching[first_alone ? 0 : 1];
      else
        (is_open(alone) ? result.tie : result.differs) = true;
    }
    x += first_alone || !second_alone;
    y += second_alone || !first_alone;
  }
  // Without intersections, contacts at distance 0 are like any others.
  const auto open_ones = std::ranges::count_if(
      pair.open, [&](double distance) { return distance <= 2.0 * TOUCHING * widths.rounding; });
  const bool differ_by_open = std::abs(touching[0] - touching[1]) <= open_ones;
  if (touching[0] != touching[1])
    ((intersecting ? touching[0] > 0 && touching[1] > 0 : differ_by_open) ? result.tie : result.differs) =
        true;
  result.bits_differ =
      !std::ranges::equal(a, b, [&](const Lmd& x, const Lmd& y) { return x.distance * scale == y.distance; });
  return result;
}

MetamorphicCounts judge_change(const ScenePair& pair, const LmdSet& truth, const Change& change,
                               Random& random, std::string& objection) {
  double scale = 1.0;
  const ScenePair changed = change.make(pair, random, scale);
  const LmdSet answer = set_of("exhaustive", changed), certified = set_of("certified", changed);
  const double largest = std::max(largest_coordinate(pair), largest_coordinate(changed) / scale);
  const double known =
      2.0 * std::max({KNOWN * largest, pair.moving.planar_tolerance, pair.fixed.planar_tolerance});
  const Widths widths{ROUNDING * largest, pair.is_level ? 0.0 : known};
  Difference difference = compare(pair, truth, answer, scale, widths);
  // It is a tie of a tolerance if both sets are the same once both have the wider tolerance.
  for (const double factor : WIDER) {
    if (!difference.differs) break;
    const LmdSet before = set_of("exhaustive", grown_like(pair, changed, scale, factor));
    const LmdSet after =
        factor == 1.0 ? answer : set_of("exhaustive", grown_like(changed, changed, 1.0, factor));
    difference.differs = compare(pair, before, after, scale, widths).differs;
    difference.tie = true;
  }
  const Difference methods =
      compare(changed, answer, certified, 1.0, {scale * widths.rounding, scale * widths.known});
  const bool is_incomplete = methods.differs || methods.tie;
  if (difference.differs || (change.keeps_bits && difference.bits_differ))
    objection += fmt::format("  {}:\n{}  was:\n{}", change.name, text_of(answer), text_of(truth));
  if (is_incomplete)
    objection += fmt::format("  {}, certified:\n{}  exhaustive:\n{}", change.name, text_of(certified),
                             text_of(answer));
  return {1, difference.differs, difference.bits_differ, difference.tie && !difference.differs,
          is_incomplete};
}

}  // namespace lmdbench::completeness
