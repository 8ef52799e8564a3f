// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact_places.h>
#include <lmdbench/decision/intersections.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lmdbench {

/// Two regions, one of them nowhere more than 2 roundings below the other's plane: their triangles
/// touch at most.
struct RestingRegions {
  std::int32_t moving, fixed;
  FeatureId on_moving, on_fixed;  ///< What touches: the region, or the only chain of it that does.
  Eigen::AlignedBox3d shared_W;   ///< Holds all that they share; world.
};

/// Regions at rest on each other whose triangles were not compared: there may be a million pairs,
/// and a contact of the regions stands for all of them.
struct AtRest {
  std::span<const RestingRegions> regions;
  /// Appends what intersects of their triangles.
  std::function<void(const RestingRegions&, std::vector<Intersection>&)> compare;
};

/// Whether a triangle is nowhere more than 2 roundings below a plane.
bool is_above(const ShapeSide& side, std::int32_t triangle, const Plane& plane, double rounding);

/// Contacts no farther than rounding, by the features of triangles that intersect.
class TouchingContacts {
 public:
  /// @param contacts  must outlive this
  TouchingContacts(const ShapePair& pair, const ContactPlaces& places, std::span<const Contact> contacts);

  /// Calls visit(contact) for contacts where triangles of their features intersect, until false.
  /// @return whether visit never returned false
  bool for_each_at(const Intersection& crossing, const std::function<bool(const Contact&)>& visit);
  bool are_at(const Intersection& crossing) {
    return !for_each_at(crossing, [](const Contact&) { return false; });
  }

  /// Whether a contact of what touches, or of a region beside it, is at all that both share.
  bool hold(const RestingRegions& resting) const;

  bool empty() const { return entries_.empty(); }

 private:
  using FeaturePair = std::pair<FeatureId, FeatureId>;  ///< Of the moving, the fixed mesh.
  struct Entry {
    FeaturePair features;
    Eigen::AlignedBox3d box_W;
    const Contact* contact;
  };
  /// Of entries that are in order of a side's features, those with one of them.
  static std::span<const Entry> entries_of(std::span<const Entry> entries, FeatureId FeaturePair::*side,
                                           const FeatureId& feature);
  using Features = std::vector<FeatureId>;
  /// The features that have a corner at a vertex, faces first; filled as vertices are asked for.
  using FeaturesAt = std::unordered_map<std::int32_t, Features>;
  /// At each corner of a triangle.
  static std::array<const Features*, 3> star_of(const ShapeSide& side, std::int32_t triangle,
                                                FeaturesAt& known);

  const ShapePair& pair_;
  std::vector<Entry> entries_;  ///< By features.
  FeaturesAt at_moving_, at_fixed_;
};

/// Takes out pairs of triangles at a contact that share no more than rounding makes of two that
/// touch: a part at rest keeps its contacts of faces and their directions.
/// @param intersections  of all fixed bodies
/// @return the pairs taken out, all of one fixed body
std::vector<Intersection> take_touching(const ShapePair& pair, std::int32_t fixed_body,
                                        TouchingContacts& near, std::vector<Intersection>& intersections);

/// Drops contacts nearer than rounding whose triangles intersect (reported by intersections.h).
/// @param intersections  of all fixed bodies
void drop_intersecting(const ShapePair& pair, std::int32_t fixed_body, const ContactPlaces& places,
                       std::span<const Intersection> intersections, std::vector<Contact>& contacts);

}  // namespace lmdbench
