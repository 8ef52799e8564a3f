// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/flat_pieces.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/methods/certified/flat/flat_mesh.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lmdbench {

/// One of the two meshes of a flat contact.
struct FlatSide {
  const Surface& surface;
  const FlatMesh& mesh;
  const RigidTransform& X_WS;
  bool is_moving;

  Plane plane(std::int32_t region) const {
    const Plane& own = mesh.regions->planes[static_cast<std::size_t>(region)];
    return {X_WS.point(own.point), X_WS.direction(own.normal)};
  }
  Vec3 vertex(std::int32_t v) const { return X_WS.point(surface.mesh.vertices[static_cast<std::size_t>(v)]); }
};

/// What is known of two flat features.
enum class FlatVerdict : std::uint8_t {
  NONE,   ///< They are no parallel contact.
  FOUND,  ///< They are one, and what it consists of was added.
  UNSURE  ///< So nearly parallel, or so near, that rounding decides: their
          ///< triangles must be looked at.
};

/// Parallel contacts of a frame between the moving mesh and one fixed mesh, each a whole connected set of
/// minimisers, found from the outlines of regions and straight edges without their triangles. The sets are
/// those that the definition makes of the triangles' (plateau.h, flat_pieces.h), with the same names:
///
/// - two regions: the overlap of their outlines along the contact's direction, piece by convex piece; pieces
///   that touch are one set, its centroid weighted by area;
/// - a straight edge over a region: the parts of the edge inside the outline;
/// - two straight edges: the part of the line that they share.
///
/// Features are parallel when their distance varies over the set by no more than `ParallelRule` allows. Between that and
/// `acceptable_tilt` the definition's own tolerances decide triangle by triangle: UNSURE.
class FlatContacts {
 public:
  /// A connected set of minimisers.
  struct Contact {
    Lmd lmd;
    FeatureId flat_moving,
        flat_fixed;                    ///< `index` counts regions or straight edges.
    std::size_t first = 0, count = 0;  ///< Pieces of a region pair, in pieces_.
    Vec3 end0 = Vec3::Zero(),
         end1 = Vec3::Zero();  ///< Of a segment, on the fixed mesh.
  };

  /// @param coordinates largest coordinate of the two meshes in the world
  /// @param tolerance parallel_tolerance of the meshes
  void start(std::int32_t body, double cutoff, double touch, double coordinates, double tolerance,
             const ParallelRule& rule);
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// Whether some features are tilted by more than rounding and less than `acceptable_tilt`, without a planar tolerance: then
  /// which pieces a plateau has is known only triangle by triangle, for all features alike.
  bool is_in_doubt() const { return in_doubt_; }
  /// To be called when all contacts are found. Contacts of different flat features that touch at one height are one set
  /// of minimisers to the definition: ridges that meet in a corner, the halves of a face that rounding left in two
  /// regions. Leaves them to their triangles, for good until `start`.
  /// @returns whether there are any; then all contacts are forgotten, and everything is to be decided again
  bool leave_touching_contacts();
  /// The same of contacts beside minima that are no part of them: an edge that lies in a region's plane and is no side of it.
  /// @param minima of this body
  bool leave_contacts_beside(const FlatSide& moving, const FlatSide& fixed,
                             std::span<const LocalMinimum> minima);

  FlatVerdict add_faces(const FlatSide& moving, std::int32_t region_moving, const FlatSide& fixed,
                        std::int32_t region_fixed);
  FlatVerdict add_edge_face(const FlatSide& of_edge, std::int32_t straight, const FlatSide& of_face,
                            std::int32_t region);
  FlatVerdict add_edges(const FlatSide& moving, std::int32_t straight_moving, const FlatSide& fixed,
                        std::int32_t straight_fixed);

  /// Whether all triangles of a pair of flat features are to decide.
  bool is_left_to_triangles(const FeatureId& flat_moving, const FeatureId& flat_fixed) const {
    return std::find(unsure_.begin(), unsure_.end(), std::pair(flat_moving, flat_fixed)) != unsure_.end();
  }
  /// Whether a minimum of two features of the meshes is a part of a contact that was found.
  /// @param p_W, q_W its points
  bool contains(const FlatSide& moving, const FeatureId& on_moving, const FlatSide& fixed,
                const FeatureId& on_fixed, const Vec3& p_W, const Vec3& q_W) const;
  /// Whether two features lie on the flat features of a contact, so that a minimum of theirs square to it is a
  /// part of it.
  const Contact* contact_of(const FlatSide& moving, const FeatureId& on_moving, const FlatSide& fixed,
                            const FeatureId& on_fixed, std::size_t from = 0) const;

 private:
  FlatVerdict judge(const Extent& distances, double tilt);
  /// Tilt that the definition's first-order test may accept between features at a distance [m]: rounding grants the more
  /// the shorter the direction is.
  double acceptable_tilt(double distance) const;
  /// Beyond it nothing is parallel, at whatever distance.
  double largest_tilt() const;
  bool has_face_away(const FlatSide& side, const FeatureId& feature, const Vec3& n) const;
  bool has_other_beside(const FlatSide& side, std::int32_t straight, const Vec3& n) const;
  bool follows_border_aslant(const FlatSide& of_face, std::int32_t region, const Vec3& x0, const Vec3& u,
                             const Vec3& n) const;
  std::span<const ConvexPolygon> pieces_of(const Contact& contact) const;
  /// Whether a minimum has a contact's distance and direction.
  bool is_level_with(const Contact& contact, const Vec3& p_W, const Vec3& q_W) const;
  /// The same, and a point in it.
  bool is_at(std::size_t contact, const Vec3& p_W, const Vec3& q_W) const;
  bool forget_contacts();
  bool do_touch(std::size_t one, std::size_t other, double gap) const;
  bool are_one_set(std::size_t one, std::size_t other) const;
  bool is_left(const FeatureId& flat_moving, const FeatureId& flat_fixed) const {
    return std::find(left_.begin(), left_.end(), std::pair(flat_moving, flat_fixed)) != left_.end();
  }
  FlatVerdict doubt() {
    in_doubt_ = in_doubt_ || tolerance_ == 0.0;
    return FlatVerdict::UNSURE;
  }
  /// Remembers a pair that is left to its triangles.
  FlatVerdict unsure(const FeatureId& flat_moving, const FeatureId& flat_fixed) {
    unsure_.push_back({flat_moving, flat_fixed});
    return FlatVerdict::UNSURE;
  }
  /// Whether two features lie on a pair that is left to its triangles: then they are pieces of one plateau.
  bool is_on_unsure(const FlatSide& moving, const FeatureId& on_moving, const FlatSide& fixed,
                    const FeatureId& on_fixed) const;
  void add(const FlatSide& moving, const FlatSide& fixed, Contact contact);
  void collect_pieces(const FlatSide& side, std::int32_t region, const PlanarFrame& frame_W,
                      std::vector<ConvexPolygon>& pieces) const;

  std::int32_t body_ = 0;
  double cutoff_ = 0.0, touch_ = 0.0, coordinates_ = 0.0, tolerance_ = 0.0;
  ParallelRule rule_{};
  bool in_doubt_ = false;
  std::vector<Contact> contacts_;
  std::vector<std::pair<FeatureId, FeatureId>> unsure_;
  std::vector<std::pair<FeatureId, FeatureId>> left_;  ///< Of contacts that touch others.
  std::vector<ConvexPolygon> pieces_;                  ///< In frames_ of their contact.
  std::vector<PlanarFrame> frames_;                    ///< One a contact; of a segment it is not used.
  std::vector<ConvexPolygon> of_moving_, of_fixed_, overlaps_;
  std::vector<std::size_t> group_;
};

}  // namespace lmdbench
