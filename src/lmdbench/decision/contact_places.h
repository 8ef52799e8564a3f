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

/// Where the contacts of two meshes are, and which of them come together (DEFINITION.md, "One place, one LMD").
class ContactPlaces {
 public:
  /// @param memory  of what is kept between questions
  ContactPlaces(const ShapePair& pair, const ContactSet& set, std::pmr::memory_resource& memory)
      : tolerance_(pair.tolerance), set_(set), grids_(&memory) {}

  /// Of a contact's place on the fixed mesh, wider by `reach` [m]; world.
  Eigen::AlignedBox3d box_of(const Contact& contact, double reach) const;

  /// The point of a contact's place that is nearest to a point q of the fixed mesh in the plane of contact; world. It lies on the
  /// contact's features, as a centroid need not; and the parts of one overlap are convex where they lie on one pair of triangles, so that
  /// no two have one name.
  Vec3 nearest_place(const Contact& contact, const Vec3& q) const;

  /// How far the distances of two contacts of one LMD may differ [m].
  /// @param way  from one to the other, on both meshes together [m]; none where they meet
  double granted(const Contact& a, const Contact& b, double way = 0.0) const;

  /// Whether two contacts have one direction, to the tilt that the tolerance explains and to what is known of either. A nut at its seat
  /// is as far from the floor of its slot as from the wall, and on the nut the two places meet.
  bool have_one_direction(const Contact& a, const Contact& b, double way = 0.0) const;

  /// Whether the places of two contacts come within the tolerance of each other, on both meshes.
  bool meet(const Contact& a, const Contact& b);

 private:
  /// By how much the distance may fall on the way from the farther of two contacts to the other one, and rounding have made a minimum
  /// of it [m].
  double fall_of_farther(const Contact& a, const Contact& b, double way) const;

  template <class Fits>
  bool any_piece_near(const Contact& contact, const Box2& box, double reach, Fits&& fits);

  const ContactTolerance& tolerance_;
  const ContactSet& set_;
  std::pmr::vector<std::optional<BoxGrid>> grids_;  ///< Of the polygons of many pieces, one a frame.
};

}  // namespace lmdbench
