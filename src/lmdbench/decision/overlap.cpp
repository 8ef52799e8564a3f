// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/overlap.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/types.h>

#include <Eigen/LU>

#include <algorithm>
#include <utility>

namespace lmdbench {

namespace {

/// Share of the rounding by which a segment along a piece's side still lies in the piece. At a
/// small angle to the side the segment's ends move by so much over that angle.
constexpr double SIDE_ROUNDING = 0.125;

/// A region in the frame of an overlap.
class PlacedRegion {
 public:
  PlacedRegion(const ShapeSide& side, std::int32_t region, const PlanarFrame& frame_W)
      : shape_(side.shape.shapes.of_region(region)) {
    if (shape_ == nullptr) {
      single_ = ConvexPolygon(frame_W, side.triangle(side.shape.lead_of_region(region)));
      return;
    }
    const Vec3& origin = shape_->frame.origin;
    origin_ = frame_W.flat(side.is_moving ? side.X_WS.point(origin) : origin);
    const Vec3 u = side.direction(shape_->frame.u), v = side.direction(shape_->frame.v);
    turn_ << frame_W.u.dot(u), frame_W.u.dot(v), frame_W.v.dot(u), frame_W.v.dot(v);
    turn_back_ = turn_.inverse();
    is_turned_over_ = turn_.determinant() < 0.0;
  }

  std::size_t size() const { return shape_ == nullptr ? 1 : shape_->pieces.size(); }

  ConvexPolygon piece(std::size_t index) const {
    if (shape_ == nullptr) return single_;
    ConvexPolygon placed;
    placed.corners.reserve(shape_->pieces[index].corners.size());
    for (const Vec2& x : shape_->pieces[index].corners) placed.corners.push_back(origin_ + turn_ * x);
    if (is_turned_over_) std::reverse(placed.corners.begin(), placed.corners.end());
    return placed;
  }

  /// Indices of the pieces near some points.
  std::vector<std::int32_t> pieces_near(std::span<const PolygonSide> outline, double within) const {
    Box2 box;
    for (const PolygonSide& side : outline) box.add(turn_back_ * (side.from - origin_));
    std::vector<std::int32_t> near;
    shape_->piece_grid.for_each_near(box, within, [&](std::int32_t index) {
      near.push_back(index);
      return true;
    });
    return near;
  }

  /// Appends the sides of the border.
  void append_sides(std::vector<PolygonSide>& sides) const {
    if (shape_ == nullptr) {
      append_sides_of(single_, sides);
      return;
    }
    for (const PolygonSide& side : shape_->sides) {
      const Vec2 from = origin_ + turn_ * side.from, to = origin_ + turn_ * side.to;
      sides.push_back(is_turned_over_ ? PolygonSide{to, from} : PolygonSide{from, to});
    }
  }

 private:
  const RegionShape* shape_;
  ConvexPolygon single_;
  Vec2 origin_ = Vec2::Zero();
  Eigen::Matrix2d turn_ = Eigen::Matrix2d::Identity(), turn_back_ = Eigen::Matrix2d::Identity();
  bool is_turned_over_ = false;
};

/// Regions of more pieces hand on only those near the other region.
constexpr std::size_t FEW_PIECES = 16;

}  // namespace

std::vector<OverlapPart> overlap_of_regions(const ShapeSide& moving, std::int32_t region_moving,
                                            const ShapeSide& fixed, std::int32_t region_fixed,
                                            const PlanarFrame& frame_W, double rounding) {
  LMDBENCH_EXPECTS(rounding >= 0.0, "a tolerance that is negative or not a number");
  const PlacedRegion a(moving, region_moving, frame_W), b(fixed, region_fixed, frame_W);
  const PlacedRegion &few = a.size() <= b.size() ? a : b, &many = a.size() <= b.size() ? b : a;
  std::vector<PolygonSide> of_few, of_many;
  few.append_sides(of_few);
  if (many.size() <= FEW_PIECES) {
    many.append_sides(of_many);
  } else {
    const std::vector<std::int32_t> near = many.pieces_near(of_few, rounding);
    // So many pieces have more sides than the border.
    if (2 * near.size() > many.size())
      many.append_sides(of_many);
    else
      for (const std::int32_t j : near) append_sides_of(many.piece(static_cast<std::size_t>(j)), of_many);
  }
  std::vector<OverlapPart> parts;
  for (SharedPart& shared : shared_parts(of_few, of_many, rounding)) {
    OverlapPart part;
    for (const ConvexPolygon& piece : shared) {
      const AreaAndCentroid measure = piece.measure();
      part.area += measure.area;
      part.centroid += measure.area * measure.centroid;
    }
    if (!(part.area > 0.0)) continue;
    part.centroid /= part.area;
    LMDBENCH_ENSURES(part.centroid.allFinite(), "an area below the smallest number that has an inverse");
    part.pieces = std::move(shared);
    parts.push_back(std::move(part));
  }
  return parts;
}

PlanarFrame frame_of_overlap(const ShapeSide& moving, std::int32_t region_moving, const ShapeSide& fixed,
                             std::int32_t region_fixed, const Vec3& point, const Vec3& n) {
  LMDBENCH_EXPECTS(is_unit(n), "a direction that was not normalised");
  const auto pieces = [](const ShapeSide& side, std::int32_t region) {
    const RegionShape* shape = side.shape.shapes.of_region(region);
    return shape == nullptr ? std::size_t{0} : shape->pieces.size();
  };
  PlanarFrame frame(point, n);
  const bool of_moving = pieces(moving, region_moving) > pieces(fixed, region_fixed);
  const ShapeSide& side = of_moving ? moving : fixed;
  const RegionShape* shape = side.shape.shapes.of_region(of_moving ? region_moving : region_fixed);
  if (shape == nullptr) return frame;
  const Vec3 u = side.direction(shape->frame.u);
  frame.u = (u - u.dot(n) * n).normalized();
  frame.v = n.cross(frame.u);
  return frame;
}

SegmentParts parts_over_region(const Vec3& begin_S, const Vec3& end_S, const ShapeSide& side,
                               std::int32_t region, double rounding) {
  const RegionShape* shape = side.shape.shapes.of_region(region);
  const double length = (end_S - begin_S).norm(), spare = SIDE_ROUNDING * rounding;
  SegmentParts parts;
  const auto add = [&](const SegmentPart& part) {
    if (part.end > part.begin) parts.push_back(part);
  };
  if (shape == nullptr) {
    const Plane& plane = side.shape.regions.planes[static_cast<std::size_t>(region)];
    const PlanarFrame frame(plane.point, plane.normal);
    add(ConvexPolygon(frame, side.surface.mesh.triangle(side.shape.lead_of_region(region)))
            .part_of(frame.flat(begin_S), frame.flat(end_S), spare));
  } else {
    const Vec2 a = shape->frame.flat(begin_S), b = shape->frame.flat(end_S);
    shape->piece_grid.for_each_near(a, b, rounding, [&](std::int32_t index) {
      add(shape->pieces[static_cast<std::size_t>(index)].part_of(a, b, spare));
    });
  }
  std::ranges::sort(parts, {}, &SegmentPart::begin);
  // A piece may have been met twice.
  std::size_t count = 0;
  for (const SegmentPart part : parts) {
    if (count > 0 && (part.begin - parts[count - 1].end) * length <= rounding)
      parts[count - 1].end = std::max(parts[count - 1].end, part.end);
    else
      parts[count++] = part;
  }
  parts.resize(count);
  parts.erase(
      std::remove_if(parts.begin(), parts.end(),
                     [&](const SegmentPart& part) { return (part.end - part.begin) * length <= rounding; }),
      parts.end());
  return parts;
}

bool is_on_face(const ShapeSide& side, const Vec3& n_S, std::int32_t face, const Vec3& p_S, double within) {
  const Triangle t = side.surface.mesh.triangle(face);
  // Nearly all points asked for lie beyond a side.
  if ((t[1] - t[0]).cross(t[2] - t[0]).dot(n_S) > 0.0)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 along = t[(k + 1) % 3] - t[k];
      const double beyond = along.cross(t[k] - p_S).dot(n_S);
      if (beyond > 0.0 && beyond * beyond > within * within * along.squaredNorm()) return false;
    }
  return (point_triangle_distance(p_S, t).point - p_S).squaredNorm() <= within * within;
}

}  // namespace lmdbench
