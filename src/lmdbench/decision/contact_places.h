// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>
#include <lmdbench/mesh/box_grid.h>

#include <Eigen/Geometry>

#include <memory_resource>
#include <optional>
#include <tuple>
#include <vector>

namespace lmdbench {

/// The two features of a contact.
inline auto name_of(const Contact& contact) {
  return std::tie(contact.moving, contact.fixed);
}

/// Where contacts of two meshes are and which meet (DEFINITION.md, "One place, one LMD").
class ContactPlaces {
 public:
  /// @param memory  for all that is kept between calls
  ContactPlaces(const ShapePair& pair, const ContactSet& set, std::pmr::memory_resource& memory)
      : tolerance_(pair.tolerance), set_(set), grids_(&memory) {}

  /// Box of a contact's place on the fixed mesh, wider by `within` [m]; world.
  Eigen::AlignedBox3d box_of(const Contact& contact, double within) const;

  /// The point of a contact's place that is nearest to a point q of the fixed mesh in the plane of
  /// contact; world. It lies on the contact's features, as a centroid need not. Parts of one
  /// overlap that lie on one pair of triangles are convex, so no two of them have one name.
  Vec3 nearest_place(const Contact& contact, const Vec3& q) const;

  /// How far the distances of two contacts of one LMD may differ [m].
  /// @param way  from one to the other, on both meshes together [m]; none where they meet
  double granted(const Contact& a, const Contact& b, double way = 0.0) const;

  /// Whether two contacts have one direction, to the tolerance's tilt and the error of each. (Floor
  /// and wall of a slot may be equally far from a nut and meet it at one place.)
  bool have_one_direction(const Contact& a, const Contact& b, double way = 0.0) const;

  /// Whether the places of two contacts come within the tolerance of each other, on both meshes.
  bool meet(const Contact& a, const Contact& b);

 private:
  /// How far the distance may fall on the way from the farther contact to the other one, where
  /// rounding may have made the farther one a minimum [m].
  double fall_of_farther(const Contact& a, const Contact& b, double way) const;

  template <class Fits>
  bool any_piece_near(const Contact& contact, const Box2& box, double within, Fits&& fits);

  const ContactTolerance& tolerance_;
  const ContactSet& set_;
  std::pmr::vector<std::optional<BoxGrid>> grids_;  ///< One a frame, for polygons of many pieces.
};

}  // namespace lmdbench
