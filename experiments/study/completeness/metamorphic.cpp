// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <study/completeness/metamorphic.h>
#include <support/parts/recut.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
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

ScenePair swapped(const ScenePair& pair, Random& /*random*/, Undo& undo) {
  undo.X = RigidTransform(pair.X_WM);
  undo.swapped = undo.orders_anew = true;
  return {pair.fixed, pair.moving, pair.X_WM.inverse(), pair.cutoff, pair.open, pair.is_level};
}

ScenePair moved(const ScenePair& pair, Random& random, Undo& undo) {
  ScenePair result = pair;
  const double size = bounding_box_diagonal(pair.fixed);
  Pose X{size * random.uniform() * random.direction(), random.rotation()};
  move_vertices(result.fixed, [X = RigidTransform(X)](const Vec3& p) { return X.point(p); });
  result.X_WM = X * pair.X_WM;
  undo.X = RigidTransform(X.inverse());
  return result;
}

/// Both frames turned by a signed permutation. That is exact, but later sums of three products are
/// taken in another order.
ScenePair quarter_turned(const ScenePair& pair, Random& random, Undo& undo) {
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
  undo.X.rotation = turn.transpose();
  undo.orders_anew = true;
  return result;
}

ScenePair scaled(const ScenePair& pair, Random& random, Undo& undo) {
  undo.scale = std::ldexp(1.0, static_cast<int>(random.index(21)) - 10);
  return scaled_by(undo.scale, pair);
}

template <TriangleMesh (*CHANGE)(TriangleMesh, Random&)>
ScenePair both(const ScenePair& pair, Random& random, Undo& /*undo*/) {
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
ScenePair with_far_parts(const ScenePair& pair, Random& random, Undo& /*undo*/) {
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
ScenePair without_far_triangles(const ScenePair& pair, Random& /*random*/, Undo& /*undo*/) {
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

/// Rounding of a place and, over the distance, of a direction between two points, in roundings.
constexpr double PLACE_ROUNDINGS = 8.0;
/// Directions of contacts with a face differ by no more [rad].
constexpr double FACE_DIRECTION = 1e-12;

/// Whether an LMD of the changed pair is one before. Of an edge on a face and a face on an edge at
/// one place either may give the name, and its normal the direction. The middle of an overlap as
/// narrow as the tolerance is known to the tolerance, along edges that are all but parallel a
/// crossing.
/// @param width of distances [m]
bool is_same(const Lmd& a, const Lmd& b, double width, const Widths& widths) {
  const auto has = [&](FeatureKind kind) {
    return a.feature_moving.kind == kind || a.feature_fixed.kind == kind;
  };
  const bool same_kinds =
      a.feature_moving.kind == b.feature_moving.kind && a.feature_fixed.kind == b.feature_fixed.kind;
  const bool kinds_exchanged =
      a.feature_moving.kind == b.feature_fixed.kind && a.feature_fixed.kind == b.feature_moving.kind;
  const double known = has(FeatureKind::VERTEX) ? 0.0 : 2.0 * LEAST_TOLERANCE * widths.coordinates;
  const double place = PLACE_ROUNDINGS * width + known;
  const double tilt =
      TILT_PER_TOLERANCE * (widths.known / widths.coordinates + (same_kinds ? 0.0 : 2.0 * LEAST_TOLERANCE));
  const double turn =
      FACE_DIRECTION + tilt +
      (has(FeatureKind::FACE) ? 0.0
                              : PLACE_ROUNDINGS * widths.rounding / std::max(a.distance, widths.rounding));
  return (same_kinds || kinds_exchanged) && std::abs(a.distance - b.distance) <= width &&
         (a.direction - b.direction).norm() <= turn && (a.point_moving - b.point_moving).norm() <= place &&
         (a.point_fixed - b.point_fixed).norm() <= place;
}

/// Whether two LMDs may be equally near points of one contact without a face on a face.
bool is_another_point(const Lmd& a, const Lmd& b, double width) {
  const auto is_middle = [](const Lmd& lmd) {
    return lmd.feature_moving.kind == FeatureKind::FACE && lmd.feature_fixed.kind == FeatureKind::FACE;
  };
  const Vec3 way = a.point_moving - b.point_moving;
  return !is_middle(a) && !is_middle(b) && std::abs(a.distance - b.distance) <= width &&
         (a.direction - b.direction).norm() <= TILT_PER_TOLERANCE * LEAST_TOLERANCE &&
         (way - (a.point_fixed - b.point_fixed)).norm() <= PLACE_ROUNDINGS * width &&
         std::abs(way.dot(a.direction)) <=
             TILT_PER_TOLERANCE * LEAST_TOLERANCE * way.norm() + PLACE_ROUNDINGS * width;
}

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
  const auto text_of_vector = [](const Vec3& v) {
    return fmt::format("{:.9g} {:.9g} {:.9g}", v.x(), v.y(), v.z());
  };
  std::string text;
  for (const Lmd& lmd : lmds)
    text += fmt::format("    {}{}-{} {:.17g} at {} to {}, direction {}\n",
                        lmd.intersecting ? "intersecting " : "", to_string(lmd.feature_moving.kind),
                        to_string(lmd.feature_fixed.kind), lmd.distance, text_of_vector(lmd.point_moving),
                        text_of_vector(lmd.point_fixed), text_of_vector(lmd.direction));
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

LmdSet undone(const LmdSet& changed, const Undo& undo) {
  LmdSet result;
  for (const Lmd& lmd : changed) {
    Lmd& back = result.emplace_back(undo.swapped ? turned_round(lmd) : lmd);
    back.distance /= undo.scale;
    for (Vec3* point : {&back.point_moving, &back.point_fixed}) *point = undo.X.point(*point / undo.scale);
    back.direction = undo.X.direction(back.direction);
  }
  return result;
}

Difference compare(const ScenePair& pair, const LmdSet& a, const LmdSet& b, const Widths& widths,
                   bool orders_anew) {
  const auto of_both = [&](const auto& is_true) {
    return std::ranges::any_of(a, is_true) || std::ranges::any_of(b, is_true);
  };
  const bool intersecting = of_both([](const Lmd& lmd) { return lmd.intersecting; });
  const bool extended = of_both([](const Lmd& lmd) {
    return lmd.feature_moving.kind != FeatureKind::VERTEX && lmd.feature_fixed.kind != FeatureKind::VERTEX;
  });
  const double width = widths.rounding + (extended ? widths.known : 0.0);
  // Without intersections, contacts at distance 0 are like any others.
  const auto touches = [&](const Lmd& lmd) {
    return lmd.intersecting || (intersecting && lmd.distance <= TOUCHING * widths.rounding);
  };
  const auto is_open = [&](double distance) {
    return distance >= pair.cutoff - width || std::ranges::any_of(pair.open, [&](double open) {
             return std::abs(open - distance) <= 2.0 * width;
           });
  };
  Difference result;
  std::array<LmdSet, 2> alone;
  std::array<std::ptrdiff_t, 2> touching{std::ranges::count_if(a, touches),
                                         std::ranges::count_if(b, touches)};
  std::ranges::copy_if(b, std::back_inserter(alone[1]), std::not_fn(touches));
  for (const Lmd& lmd : a) {
    if (touches(lmd)) continue;
    const auto partner =
        std::ranges::find_if(alone[1], [&](const Lmd& other) { return is_same(lmd, other, width, widths); });
    if (partner != alone[1].end())
      alone[1].erase(partner);
    else
      alone[0].push_back(lmd);
  }
  if (orders_anew)
    std::erase_if(alone[0], [&](const Lmd& lmd) {
      const auto other = std::ranges::find_if(
          alone[1], [&](const Lmd& moved) { return is_another_point(lmd, moved, width); });
      if (other == alone[1].end()) return false;
      alone[1].erase(other);
      return result.tie = true;
    });
  for (const std::size_t s : {0U, 1U})
    for (const Lmd& lmd : alone[s]) {
      if (lmd.distance <= 2.0 * TOUCHING * widths.rounding)
        ++touching[s];
      else
        (is_open(lmd.distance) ? result.tie : result.differs) = true;
    }
  if (intersecting && touching[0] != touching[1])
    (std::ranges::min(touching) > 0 ? result.tie : result.differs) = true;
  if (!intersecting && std::ranges::max(touching) > 0)
    (std::ranges::max(touching) <=
             std::ranges::count_if(
                 pair.open, [&](double distance) { return distance <= 2.0 * TOUCHING * widths.rounding; })
         ? result.tie
         : result.differs) = true;
  result.bits_differ =
      !std::ranges::equal(a, b, [](const Lmd& x, const Lmd& y) { return x.distance == y.distance; });
  return result;
}

MetamorphicCounts judge_change(const ScenePair& pair, const LmdSet& truth, const Change& change,
                               Random& random, std::string& objection) {
  Undo undo;
  const ScenePair changed = change.make(pair, random, undo);
  const double scale = undo.scale;
  const LmdSet found = set_of("exhaustive", changed), certified = set_of("certified", changed);
  const LmdSet answer = undone(found, undo);
  const double largest = std::max(largest_coordinate(pair), largest_coordinate(changed) / scale);
  const double known =
      2.0 * std::max({KNOWN * largest, pair.moving.planar_tolerance, pair.fixed.planar_tolerance});
  const Widths widths{ROUNDING * largest, pair.is_level ? 0.0 : known, largest};
  Difference difference = compare(pair, truth, answer, widths, undo.orders_anew);
  // It is a tie of a tolerance if both sets are the same once both have the wider tolerance.
  for (const double factor : WIDER) {
    if (!difference.differs) break;
    const LmdSet before = set_of("exhaustive", grown_like(pair, changed, scale, factor));
    const LmdSet after = factor == 1.0
                             ? answer
                             : undone(set_of("exhaustive", grown_like(changed, changed, 1.0, factor)), undo);
    difference.differs = compare(pair, before, after, widths, undo.orders_anew).differs;
    difference.tie = true;
  }
  const Difference methods =
      compare(changed, found, certified, {scale * widths.rounding, scale * widths.known, scale * largest});
  const bool is_incomplete = methods.differs || methods.tie;
  if (difference.differs || (change.keeps_bits && difference.bits_differ))
    objection += fmt::format("  {}:\n{}  was:\n{}", change.name, text_of(answer), text_of(truth));
  if (is_incomplete)
    objection +=
        fmt::format("  {}, certified:\n{}  exhaustive:\n{}", change.name, text_of(certified), text_of(found));
  return {1, difference.differs, difference.bits_differ, difference.tie && !difference.differs,
          is_incomplete};
}

}  // namespace lmdbench::completeness
