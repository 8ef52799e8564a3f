// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/plugin/judged_contacts.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

namespace lmdbench {
namespace {

constexpr int PARTS = 7;

/// One mesh of a pair, which locates points given in B's frame.
struct Side {
  const Surface& surface;
  double tolerance;  ///< [m]
  const RigidTransform& X_BS;

  struct Place {
    TriangleFeature part;
    bool as_named;
  };
  /// @return nothing where the point is not on the triangle
  std::optional<Place> place_of(const Vec3& p_B, std::int32_t triangle, std::int32_t named) const {
    if (triangle < 0 || static_cast<std::size_t>(triangle) >= surface.mesh.triangles.size())
      return std::nullopt;
    const Triangle corners = X_BS.triangle(surface.mesh.triangle(triangle));
    const PointTriangleDistance nearest = point_triangle_distance(p_B, corners);
    if (!(nearest.squared_distance <= tolerance * tolerance)) return std::nullopt;
    if (named >= 0 && named < PARTS && is_on(p_B, corners, static_cast<TriangleFeature>(named)))
      return Place{static_cast<TriangleFeature>(named), true};
    const bool knew_no_better = named == LMDBENCH_PART_UNKNOWN;
    // The lowest part within the tolerance: rounding may move an edge's point into a face.
    for (int part = 0; part < PARTS; ++part)
      if (is_on(p_B, corners, static_cast<TriangleFeature>(part)))
        return Place{static_cast<TriangleFeature>(part), knew_no_better};
    return Place{nearest.feature, knew_no_better};
  }

 private:
  bool is_on(const Vec3& p, const Triangle& corners, TriangleFeature part) const {
    const auto corner = [&](int i) -> const Vec3& { return corners[static_cast<std::size_t>(i % 3)]; };
    const int k = local_index(part);
    if (is_face(part)) return true;
    if (is_vertex(part)) return (p - corner(k)).norm() <= tolerance;
    const Vec3 along = corner(k + 1) - corner(k);
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - corner(k)).dot(along) / length, 0.0, 1.0) : 0.0;
    return (p - corner(k) - t * along).norm() <= tolerance;
  }
};

}  // namespace

std::vector<CounterDescription> plugin_marks() {
  using Mark = PluginMark;
  static_assert(static_cast<std::size_t>(Mark::FIRST_OF_ITS_OWN) == MethodDescription::MARKS);
  constexpr auto PART = CountedBy::SEARCH;
  return {{Mark::LOST, "frames_lost",
           "answers that did not come: the plugin crashed, took too long or failed", PART},
          {Mark::NOT_FINITE, "contacts_not_finite", "contacts left out: a coordinate is no number", PART},
          {Mark::OFF_MESH, "contacts_off_mesh",
           "contacts left out: a point is not on the triangle that is named", PART},
          {Mark::OTHER_PART, "parts_wrong", "points that are not on the named part of their triangle", PART},
          {Mark::DUPLICATES, "contacts_twice", "contacts left out: their pair of features has a nearer one",
           PART},
          {Mark::UNSORTED, "answers_unsorted", "answers whose contacts were not nearest first", PART},
          {Mark::TOO_MANY, "answers_too_large", "answers left out: more contacts than 1048576", PART},
          {Mark::FLOAT_MODE, "float_mode_changed",
           "calls that left another rounding mode or flush-to-zero; put back", PART},
          {Mark::FORCE_WRONG, "forces_wrong", "forces of its own left out: not finite, or none came", PART}};
}

ContactJudge::ContactJudge(std::shared_ptr<const Body> a, std::shared_ptr<const Body> b)
    : a_(std::move(a)),
      b_(std::move(b)),
      tolerance_a_(POINT_TOLERANCE * bounding_box_diagonal(a_->surface().mesh)),
      tolerance_b_(POINT_TOLERANCE * bounding_box_diagonal(b_->surface().mesh)) {}

void ContactJudge::judge(std::span<const lmdbench_contact> contacts, const RigidTransform& X_BA, LmdSet& lmds,
                         WorkCounters& counters) const {
  lmds.clear();
  const RigidTransform identity;
  const Side side_a{a_->surface(), tolerance_a_, X_BA}, side_b{b_->surface(), tolerance_b_, identity};
  double last = 0.0;
  bool sorted = true;
  for (const lmdbench_contact& contact : contacts) {
    Lmd lmd;
    lmd.point_moving = Vec3(contact.point_a[0], contact.point_a[1], contact.point_a[2]);
    lmd.point_fixed = Vec3(contact.point_b[0], contact.point_b[1], contact.point_b[2]);
    if (!lmd.point_moving.allFinite() || !lmd.point_fixed.allFinite()) {
      ++counters[PluginMark::NOT_FINITE];
      continue;
    }
    const auto on_a = side_a.place_of(lmd.point_moving, contact.triangle_a, contact.part_a);
    const auto on_b = side_b.place_of(lmd.point_fixed, contact.triangle_b, contact.part_b);
    if (!on_a || !on_b) {
      ++counters[PluginMark::OFF_MESH];
      continue;
    }
    counters[PluginMark::OTHER_PART] += (on_a->as_named ? 0U : 1U) + (on_b->as_named ? 0U : 1U);
    lmd.triangle_moving = contact.triangle_a;
    lmd.triangle_fixed = contact.triangle_b;
    lmd.feature_moving = side_a.surface.feature_of(contact.triangle_a, on_a->part);
    lmd.feature_fixed = side_b.surface.feature_of(contact.triangle_b, on_b->part);
    lmd.distance = (lmd.point_fixed - lmd.point_moving).norm();
    lmd.intersecting = lmd.distance == 0.0;
    if (lmd.distance > 0.0) lmd.direction = (lmd.point_fixed - lmd.point_moving) / lmd.distance;
    // Contacts equally near within the points' tolerance may come in any order.
    sorted = sorted && lmd.distance >= last - side_a.tolerance - side_b.tolerance;
    last = std::max(last, lmd.distance);
    lmds.push_back(lmd);
  }
  if (!sorted) ++counters[PluginMark::UNSORTED];
  const auto key = [](const Lmd& lmd) {
    return std::tuple(lmd.feature_moving, lmd.feature_fixed, lmd.distance, lmd.triangle_moving,
                      lmd.triangle_fixed);
  };
  std::sort(lmds.begin(), lmds.end(), [&](const Lmd& x, const Lmd& y) { return key(x) < key(y); });
  const auto end = std::unique(lmds.begin(), lmds.end(), same_feature_pair);
  counters[PluginMark::DUPLICATES] += static_cast<std::uint64_t>(std::distance(end, lmds.end()));
  lmds.erase(end, lmds.end());
  std::sort(lmds.begin(), lmds.end(), lmd_less);
}

}  // namespace lmdbench
