// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/join_contacts.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/well_formed.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>

#include <algorithm>
#include <utility>

namespace lmdbench {

namespace {

Eigen::AlignedBox3d placed_box(const ShapeSide& side, const FeatureId& feature) {
  Eigen::AlignedBox3d box;
  const FeatureCorners corners(side.surface, feature);
  for (const std::int32_t v : corners.view()) box.extend(side.vertex(v));
  return box;
}

/// Lead of the shape's feature that holds a face, edge or vertex; index -1 if there is none.
FeatureId lead_of(const ShapeComplex& shape, const FeatureId& feature) {
  if (feature.kind == FeatureKind::VERTEX) return shape.is_corner(feature.index) ? feature : FeatureId{};
  if (feature.kind == FeatureKind::EDGE) {
    const std::int32_t chain = shape.chain_of(feature.index);
    return chain < 0 ? FeatureId{} : FeatureId{FeatureKind::EDGE, shape.lead_of_chain(chain)};
  }
  const std::int32_t region = shape.region_of(feature.index);
  return region < 0 ? FeatureId{} : FeatureId{FeatureKind::FACE, shape.lead_of_region(region)};
}

}  // namespace

Exhaustive::Exhaustive(Scene of_pair) : scene_(std::move(of_pair)), grid_(scene_.fixed_body().surface()) {
  const Surface& fixed = scene_.fixed_body().surface();
  asked_vertex_.assign(fixed.mesh.vertices.size(), 0);
  asked_edge_.assign(fixed.adjacency.edges.size(), 0);
  asked_face_.assign(fixed.mesh.triangles.size(), 0);
}

template <class Ask>
void Exhaustive::for_each_feature_pair(const ShapePair& pair, WorkCounters& counters, Ask&& ask_pair) {
  const ShapeSide &moving = pair.moving, &fixed = pair.fixed;
  // @param parts faces or edges that the feature consists of
  const auto ask = [&](const FeatureId& lead, std::span<const std::int32_t> parts) {
    ++asking_;
    for (const std::int32_t part : parts)
      grid_.for_each_near(
          placed_box(moving, {lead.kind, part}), pair.tolerance.reach, [&](const FeatureId& near) {
            const FeatureId other = lead_of(fixed.shape, near);
            if (other.index < 0) return;
            std::uint64_t& asked =
                (other.kind == FeatureKind::VERTEX ? asked_vertex_
                 : other.kind == FeatureKind::EDGE ? asked_edge_
                                                   : asked_face_)[static_cast<std::size_t>(other.index)];
            if (asked == asking_) return;
            asked = asking_;
            ++counters[Counter::FEATURE_PAIRS];
            ask_pair(lead, other);
          });
  };
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(moving.surface.mesh.vertices.size()); ++v)
    if (moving.shape.is_corner(v)) ask({FeatureKind::VERTEX, v}, {&v, 1});
  const FlatRegions& regions = moving.shape.regions;
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(regions.straight_edges.size()); ++c)
    ask({FeatureKind::EDGE, moving.shape.lead_of_chain(c)}, regions.edges_of_straight[c]);
  for (std::int32_t r = 0; r < regions.region_count(); ++r)
    ask({FeatureKind::FACE, moving.shape.lead_of_region(r)}, regions.region_triangles[r]);
}

void Exhaustive::find_intersections(const ShapePair& pair, WorkCounters& counters) {
  const Surface &moving = pair.moving.surface, &fixed = pair.fixed.surface;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(moving.mesh.triangles.size()); ++t) {
    const Triangle a = pair.moving.triangle(t);
    grid_.for_each_near(
        placed_box(pair.moving, {FeatureKind::FACE, t}), pair.tolerance.rounding, [&](const FeatureId& near) {
          if (near.kind != FeatureKind::FACE) return;
          ++counters[Counter::TRIANGLE_DISTANCES];
          const TrianglePairDistance distance = triangle_distance(a, fixed.mesh.triangle(near.index));
          if (distance.intersecting)
            intersections_.push_back(intersection_of(pair, t, near.index, 0, distance));
        });
  }
}

template <class With>
void Exhaustive::at_pose(const Pose& X_WM, WorkCounters& counters, With&& with) {
  const RigidTransform transform(X_WM);
  const Body &a = *scene_.moving, &b = scene_.fixed_body();
  const ShapePair pair(a.surface(), a.prepared<ShapeComplex>(), b.surface(), b.prepared<ShapeComplex>(),
                       transform, scene_.cutoff);
  intersections_.clear();
  contacts_.clear();
  find_intersections(pair, counters);
  with(pair);
}

void Exhaustive::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  lmds.clear();
  at_pose(X_WM, counters, [&](const ShapePair& pair) {
    for_each_feature_pair(pair, counters,
                          [&](const FeatureId& f, const FeatureId& g) { decide(pair, f, g, contacts_); });
    counters[Counter::CONTACTS] += contacts_.contacts.size();
    join_contacts(pair, 0, contacts_, intersections_, lmds);
  });
  append_contacts(scene_, intersections_, lmds);
  std::sort(lmds.begin(), lmds.end(), lmd_less);
  LMDBENCH_ENSURES(is_well_formed(lmds, scene_), "a contact whose point or name is of another place");
}

void Exhaustive::find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) {
  critical.clear();
  const auto& signs_moving = scene_.moving->prepared<SignedFeatures>();
  const auto& signs_fixed = scene_.fixed_body().prepared<SignedFeatures>();
  at_pose(X_WM, counters, [&](const ShapePair& pair) {
    const SignedPair signs(pair, signs_moving, signs_fixed);
    for_each_feature_pair(pair, counters, [&](const FeatureId& f, const FeatureId& g) {
      decide_critical(pair, signs, f, g, contacts_);
    });
    counters[Counter::CONTACTS] += contacts_.contacts.size();
    join_critical(pair, signs_moving, signs_fixed, 0, contacts_, intersections_, critical);
  });
  finish_critical(scene_, intersections_, critical);
}

}  // namespace lmdbench
