// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/join_contacts.h>
#include <lmdbench/shape/shape_complex.h>

#include <support/scenes.h>

#include <utility>
#include <vector>

namespace lmdbench::testing {

/// A turn about an axis of any length, then a translation.
inline Pose turned_by(double angle, const Vec3& axis, const Vec3& translation) {
  return {translation, Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()))};
}

/// Bar along x with its sharp edge down, along the x axis from -1 to 1.
inline TriangleMesh edge_down() {
  return {{{-1, 0, 0}, {1, 0, 0}, {-1, -0.5, 0.5}, {1, -0.5, 0.5}, {-1, 0.5, 0.5}, {1, 0.5, 0.5}},
          {{0, 3, 2}, {0, 1, 3}, {0, 5, 1}, {0, 4, 5}, {2, 5, 4}, {2, 3, 5}, {0, 2, 4}, {1, 5, 3}}};
}

/// Leads of all features of a shape.
inline std::vector<FeatureId> leads_of(const Surface& surface, const ShapeComplex& shape) {
  std::vector<FeatureId> leads;
  const auto add = [&](FeatureKind kind, std::size_t count) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i)
      if (shape.is_lead({kind, i}) && (kind != FeatureKind::FACE || shape.region_of(i) >= 0))
        leads.push_back({kind, i});
  };
  add(FeatureKind::VERTEX, surface.mesh.vertices.size());
  add(FeatureKind::EDGE, surface.adjacency.edges.size());
  add(FeatureKind::FACE, surface.mesh.triangles.size());
  return leads;
}

/// LMDs of the contacts of meshes that do not intersect.
inline LmdSet joined(const ShapePair& pair, ContactSet& contacts) {
  LmdSet lmds;
  std::vector<Intersection> none;
  join_contacts(pair, 0, contacts, none, lmds);
  return lmds;
}

/// Two meshes with their shapes, and the contacts of all pairs of their features at a pose.
class ShapeScene {
 public:
  ShapeScene(TriangleMesh moving, TriangleMesh fixed, double cutoff = 1.0)
      : moving_(build_surface(std::move(moving))),
        fixed_(build_surface(std::move(fixed))),
        shape_moving_(ShapeComplex::of(moving_)),
        shape_fixed_(ShapeComplex::of(fixed_)),
        cutoff_(cutoff) {}
  ShapeScene(const ShapeScene&) = delete;

  const Surface& moving() const { return moving_; }
  const Surface& fixed() const { return fixed_; }
  const ShapeComplex& shape_moving() const { return shape_moving_; }
  const ShapeComplex& shape_fixed() const { return shape_fixed_; }

  /// The pair is valid until the next call.
  ShapePair at(const Pose& X_WM) {
    X_WM_ = RigidTransform(X_WM);
    return {moving_, shape_moving_, fixed_, shape_fixed_, X_WM_, cutoff_};
  }
  ContactSet contacts(const ShapePair& pair) const {
    ContactSet found;
    for (const FeatureId& f : leads_of(moving_, shape_moving_))
      for (const FeatureId& g : leads_of(fixed_, shape_fixed_)) decide(pair, f, g, found);
    return found;
  }
  ContactSet contacts(const Pose& X_WM) { return contacts(at(X_WM)); }
  LmdSet lmds(const Pose& X_WM) {
    const ShapePair pair = at(X_WM);
    ContactSet found = contacts(pair);
    return joined(pair, found);
  }

 private:
  Surface moving_, fixed_;
  ShapeComplex shape_moving_, shape_fixed_;
  double cutoff_;
  RigidTransform X_WM_;
};

}  // namespace lmdbench::testing
