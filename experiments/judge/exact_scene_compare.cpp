// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <boost/pending/disjoint_sets.hpp>
#include <judge/exact_distance.h>
#include <judge/exact_scene.h>
#include <judge/exact_scene_body.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <unordered_set>

namespace lmdbench::exact {
namespace {

using Triangles = std::vector<std::int32_t>;

double rounding_at(const Vec3& p, const Vec3& q) {
  return ROUNDINGS * std::numeric_limits<double>::epsilon() *
         std::max(p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff());
}

/// Of Lmd and ExactLmd.
bool same_features(const auto& a, const auto& b) {
  return a.feature_moving == b.feature_moving && a.feature_fixed == b.feature_fixed;
}

Triangles triangles_at(const WorldBody& body, const FeatureId& feature) {
  const auto triangles = body.surface().incident_triangles(feature);
  return {triangles.begin(), triangles.end()};
}

/// A segment or an area, by its names.
bool is_extended(const Lmd& lmd) {
  return lmd.feature_moving.kind != FeatureKind::VERTEX && lmd.feature_fixed.kind != FeatureKind::VERTEX;
}

bool have_common(const Triangles& a, const Triangles& b) {
  return std::ranges::any_of(a, [&](std::int32_t t) { return std::ranges::find(b, t) != b.end(); });
}

/// Triangles that hold a pair of features on both meshes. Two pairs on the same two triangles are
/// of one contact, because distance is convex on these.
struct Cells {
  Triangles moving, fixed;
  bool meet(const Cells& other) const {
    return have_common(moving, other.moving) && have_common(fixed, other.fixed);
  }
};

std::vector<std::int32_t> corners_of(const WorldBody& body, const FeatureId& feature) {
  const FeatureCorners corners(body.surface(), feature);
  return {corners.view().begin(), corners.view().end()};
}

/// Vertices that hang together with a feature within `slack` of the plane of contact, which may be
/// tilted: the part of the mesh on which a plateau may lie.
std::unordered_set<std::int32_t> level_part(const WorldBody& body, const FeatureId& feature, const Vec3& p,
                                            const Vec3& normal, double slack, double tilt) {
  std::unordered_set<std::int32_t> part;
  std::vector<std::int32_t> open;
  const auto add = [&](std::int32_t vertex) {
    const Vec3 apart = body.vertex(vertex) - p;
    if (std::abs(apart.dot(normal)) <= slack + tilt * apart.norm() && part.insert(vertex).second)
      open.push_back(vertex);
  };
  for (const std::int32_t vertex : corners_of(body, feature)) add(vertex);
  while (!open.empty()) {
    const std::int32_t at = open.back();
    open.pop_back();
    for (const std::int32_t triangle : body.surface().adjacency.vertex_triangles[at])
      for (const std::int32_t vertex : body.corners(triangle)) add(vertex);
  }
  return part;
}

/// Those of both meshes at an exact LMD, for the last tilt; made when first asked for.
struct LevelParts {
  double tilt = 0.0;
  std::optional<std::unordered_set<std::int32_t>> moving, fixed;
};

/// What the definition grants to contacts of two meshes (DEFINITION.md, "In floating-point
/// numbers"; its numbers stand here again).
struct Tolerance {
  double known = 0.0;         ///< metres
  double largest_tilt = 0.0;  ///< The sine up to which features are parallel.
};

Tolerance tolerance_of(const Surface& moving, const Surface& fixed) {
  double known = 0.0, extents = 0.0;
  for (const Surface* surface : {&moving, &fixed}) {
    double extent = 0.0;
    for (const Vec3& v : surface->mesh.vertices) extent = std::max(extent, v.cwiseAbs().maxCoeff());
    known += std::max(surface->mesh.planar_tolerance, 1e-9 * extent);
    extents += extent;
  }
  return {known, std::min(5e-5, 50.0 * known / extents)};
}

/// The moving mesh and a fixed one.
class BodyPair {
 public:
  BodyPair(const Surface& moving, const Surface& fixed, const Pose& X_WM)
      : moving_(moving, RigidTransform(X_WM)),
        fixed_(fixed, RigidTransform()),
        tolerance_(tolerance_of(moving, fixed)) {}

  Cells cells_of(const FeatureId& on_moving, const FeatureId& on_fixed) const {
    return {triangles_at(moving_, on_moving), triangles_at(fixed_, on_fixed)};
  }

  /// Whether the LMD is where the exact one is, or both are of one plateau: their distances, and
  /// their distance vectors or how far they are across from each other, are equal up to the
  /// tolerance, and once more for each contact that is extended, and both meshes go on between them
  /// within that.
  /// @param meet  whether their cells do
  bool is_part_of(const ExactLmd& exact, const Lmd& found, bool meet, LevelParts& parts) const {
    const double rounding = rounding_at(exact.point_moving, exact.point_fixed);
    const Vec3 d = exact.point_fixed - exact.point_moving;
    const Vec3 difference = found.point_fixed - found.point_moving - d;
    const double allowed = 3.0 * tolerance_.known + tolerance_.largest_tilt * exact.distance + rounding;
    // Edges that cross beside a segment or area level to the tolerance may be nearer by that, with
    // another direction.
    const double longer = (difference + d).norm() - exact.distance;
    const bool level = is_extended(found) && std::abs(longer) <= allowed &&
                       difference.squaredNorm() <= 4.0 * allowed * exact.distance;
    if (meet && level) return true;
    const Vec3 apart = found.point_moving - exact.point_moving;
    const double turn = level ? difference.norm() / exact.distance : 0.0;
    const double tilt = turn + allowed / exact.distance;  // of the two planes of contact
    if (!((level || difference.norm() <= allowed) &&
          std::abs(apart.dot(d)) <= exact.distance * (allowed + tilt * apart.norm())))
      return false;
    if (meet && apart.norm() <= allowed) return true;
    if (are_copies(moving_, exact.feature_moving, found.feature_moving) ||
        are_copies(fixed_, exact.feature_fixed, found.feature_fixed))
      return false;
    if (parts.tilt != tilt) parts = {tilt, {}, {}};
    const auto goes_on = [&](auto& part, const WorldBody& body, const FeatureId& from, const FeatureId& to,
                             const Vec3& p) {
      if (!part) part = level_part(body, from, p, d / exact.distance, allowed, tilt);
      return std::ranges::any_of(corners_of(body, to),
                                 [&](std::int32_t vertex) { return part->contains(vertex); });
    };
    return goes_on(parts.moving, moving_, exact.feature_moving, found.feature_moving, exact.point_moving) &&
           goes_on(parts.fixed, fixed_, exact.feature_fixed, found.feature_fixed, exact.point_fixed);
  }

  /// Whether the points lie on the named features and are `distance` apart. Of faces the middle of
  /// a ring is only in their planes.
  bool is_on_features(const Lmd& lmd) const {
    const double rounding = rounding_at(lmd.point_moving, lmd.point_fixed);
    const bool of_faces =
        lmd.feature_moving.kind == FeatureKind::FACE && lmd.feature_fixed.kind == FeatureKind::FACE;
    const auto holds = [&](const WorldBody& body, const FeatureId& feature, const Vec3& p) {
      const auto corners = corners_of(body, feature);
      Triangle t;
      for (std::size_t i = 0; i < 3; ++i) t[i] = body.vertex(corners[std::min(i, corners.size() - 1)]);
      if (testing::exact_distance(p, t) <= tolerance_.known + rounding) return true;
      return of_faces && std::abs((t[1] - t[0]).cross(t[2] - t[0]).normalized().dot(p - t[0])) <=
                             tolerance_.known + rounding;
    };
    return std::abs((lmd.point_fixed - lmd.point_moving).norm() - lmd.distance) <= rounding &&
           holds(moving_, lmd.feature_moving, lmd.point_moving) &&
           holds(fixed_, lmd.feature_fixed, lmd.point_fixed);
  }

  /// Whether triangles of the named features share a point. The LMD's own may lie in a hole of what
  /// all triangles of its contact share.
  bool intersect_at(const Lmd& lmd) const {
    if (lmd.distance != 0.0 || lmd.point_moving != lmd.point_fixed) return false;
    const Cells cells = cells_of(lmd.feature_moving, lmd.feature_fixed);
    return std::ranges::any_of(cells.moving, [&](std::int32_t a) {
      return std::ranges::any_of(cells.fixed, [&](std::int32_t b) {
        return testing::exact_distance(moving_.triangle(a), fixed_.triangle(b)) == 0.0;
      });
    });
  }

  /// Whether two LMDs have one name, or one place and one distance vector on features that touch.
  bool are_one(const Lmd& a, const Lmd& b) const {
    const double allowed = rounding_at(a.point_moving, a.point_fixed);
    return same_features(a, b) ||
           ((a.point_moving - b.point_moving).norm() <= allowed &&
            (a.point_fixed - b.point_fixed).norm() <= allowed && a.distance > 2.0 * allowed &&
            touch(moving_, a.feature_moving, b.feature_moving) &&
            touch(fixed_, a.feature_fixed, b.feature_fixed));
  }

 private:
  /// Two faces with the same corners: sheets that coincide have an LMD each.
  static bool are_copies(const WorldBody& body, const FeatureId& a, const FeatureId& b) {
    return a.kind == FeatureKind::FACE && b.kind == FeatureKind::FACE && a.index != b.index &&
           std::ranges::is_permutation(body.corners(a.index), body.corners(b.index));
  }
  static bool touch(const WorldBody& body, const FeatureId& a, const FeatureId& b) {
    return have_common(corners_of(body, a), corners_of(body, b)) && !are_copies(body, a, b);
  }

  WorldBody moving_, fixed_;
  Tolerance tolerance_;
};

}  // namespace

ExactAgreement compare_with_exact(const Scene& scene, const Pose& X_WM, const LmdSet& found,
                                  const std::vector<ExactLmd>& exact) {
  std::vector<BodyPair> pairs;
  pairs.reserve(scene.fixed.size());
  for (const FixedBody& fixed : scene.fixed)
    pairs.emplace_back(scene.moving->surface(), fixed->surface(), X_WM);
  const auto pair_of = [&](std::int32_t body) -> const BodyPair& {
    return pairs[static_cast<std::size_t>(body)];
  };
  ExactAgreement agreement;
  LmdSet apart, intersecting;
  for (const Lmd& lmd : found) {
    if (!lmd.intersecting) {
      if (lmd.distance != 0.0) apart.push_back(lmd);
      continue;
    }
    const BodyPair& pair = pair_of(lmd.fixed_body);
    if (!pair.intersect_at(lmd)) agreement.misplaced.push_back(lmd);
    if (std::ranges::any_of(intersecting, [&](const Lmd& other) {
          return other.fixed_body == lmd.fixed_body && same_features(other, lmd);
        }))
      agreement.doubled.push_back(lmd);
    intersecting.push_back(lmd);
  }
  agreement.found = static_cast<int>(apart.size());

  // Exact LMDs on common triangles of both meshes are corners of one contact.
  std::vector<Cells> cells;
  for (const ExactLmd& truth : exact)
    cells.push_back(pair_of(truth.fixed_body).cells_of(truth.feature_moving, truth.feature_fixed));
  boost::disjoint_sets_with_storage<> contacts(exact.size());
  std::map<std::array<std::int32_t, 3>, std::size_t> on_triangles;
  for (std::size_t i = 0; i < exact.size(); ++i)
    for (const std::int32_t a : cells[i].moving)
      for (const std::int32_t b : cells[i].fixed)
        contacts.union_set(i, on_triangles.try_emplace({exact[i].fixed_body, a, b}, i).first->second);

  std::vector<Cells> own;
  for (const Lmd& lmd : apart)
    own.push_back(pair_of(lmd.fixed_body).cells_of(lmd.feature_moving, lmd.feature_fixed));
  std::vector<bool> matched(apart.size(), false), shares = matched, required = matched, doubled = matched;
  std::vector<std::size_t> matches(exact.size(), 0);
  std::vector<std::set<std::size_t>> of_contact(exact.size());  // LMDs certainly of each contact
  for (const bool surely : {true, false}) {
    for (std::size_t i = 0; i < exact.size(); ++i) {
      LevelParts parts;
      std::size_t last = 0;
      for (std::size_t k = 0; k < apart.size(); ++k) {
        if (exact[i].fixed_body != apart[k].fixed_body) continue;
        const bool meet = own[k].meet(cells[i]);
        if (surely && !meet) continue;
        auto& of = of_contact[contacts.find_set(i)];
        if (!of.contains(k) && !pair_of(exact[i].fixed_body).is_part_of(exact[i], apart[k], meet, parts))
          continue;
        if (surely) {
          of.insert(k);
          continue;
        }
        matched[k] = true;
        if (matches[i]++ > 0) shares[k] = true;
        last = k;
      }
      if (exact[i].certain && matches[i] == 1) required[last] = true;
    }
  }
  agreement.required = static_cast<int>(std::ranges::count(required, true));
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const ExactLmd& truth = exact[i];
    ++agreement.exact;
    agreement.certain += truth.certain;
    if (matches[i] > 0) {
      const bool named = std::ranges::any_of(apart, [&](const Lmd& lmd) {
        return lmd.fixed_body == truth.fixed_body && same_features(lmd, truth);
      });
      ++(named ? agreement.same_features : agreement.same_contact);
    } else if (!truth.certain) {
      ++agreement.uncertain;
    } else {
      agreement.missed.push_back(truth);
    }
  }
  for (const auto& of : of_contact)
    if (of.size() > 1)
      for (const std::size_t k : std::ranges::subrange(std::next(of.begin()), of.end())) doubled[k] = true;
  for (std::size_t k = 0; k < apart.size(); ++k) {
    const BodyPair& pair = pair_of(apart[k].fixed_body);
    for (std::size_t m = 0; m < k && !doubled[k]; ++m)
      doubled[k] = apart[m].fixed_body == apart[k].fixed_body && pair.are_one(apart[m], apart[k]);
    agreement.sharing += shares[k];
    if (doubled[k]) agreement.doubled.push_back(apart[k]);
    if (!pair.is_on_features(apart[k])) {
      agreement.misplaced.push_back(apart[k]);
    } else if (!matched[k]) {
      agreement.untrue.push_back(apart[k]);
    }
  }
  return agreement;
}

bool within_tolerance(const Scene& scene, const Pose& X_WM, const Lmd& lmd) {
  const Surface& fixed_surface = scene.fixed[static_cast<std::size_t>(lmd.fixed_body)]->surface();
  const double sine =
      is_extended(lmd) ? tolerance_of(scene.moving->surface(), fixed_surface).largest_tilt : 1e-9;
  const auto admits = [sine](const WorldBody& body, const FeatureId& feature, const Vec3& p_W,
                             const Vec3& d_W) {
    const double rounding =
        ROUNDINGS * std::numeric_limits<double>::epsilon() * (p_W.cwiseAbs().maxCoeff() + d_W.norm());
    for (const std::int32_t triangle : body.surface().incident_triangles(feature)) {
      for (const std::int32_t corner : body.corners(triangle)) {
        const Vec3 to_corner = body.vertex(corner) - p_W;
        if (!(d_W.dot(to_corner) <= (sine * d_W.norm() + rounding) * to_corner.norm())) return false;
      }
    }
    return true;
  };
  const WorldBody moving(scene.moving->surface(), RigidTransform(X_WM));
  const WorldBody fixed(fixed_surface, RigidTransform());
  const Vec3 d_W = lmd.point_fixed - lmd.point_moving;
  return admits(moving, lmd.feature_moving, lmd.point_moving, d_W) &&
         admits(fixed, lmd.feature_fixed, lmd.point_fixed, -d_W);
}

template <typename AnyLmd>
std::string describe(const AnyLmd& lmd) {
  std::ostringstream text;
  text.precision(17);
  text << to_string(lmd.feature_moving.kind) << " " << lmd.feature_moving.index << " of the moving mesh, "
       << to_string(lmd.feature_fixed.kind) << " " << lmd.feature_fixed.index << " of fixed mesh "
       << lmd.fixed_body << ", distance " << lmd.distance << ", at " << lmd.point_moving.transpose()
       << " and " << lmd.point_fixed.transpose();
  return text.str();
}
template std::string describe(const ExactLmd&);
template std::string describe(const Lmd&);

}  // namespace lmdbench::exact
