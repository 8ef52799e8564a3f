// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/lmd/overlap.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

namespace lmdbench {

namespace {

/// Share of the rounding by which a segment along a piece's side still lies in the piece. Less than the whole, because at a
/// small angle to the side it moves the segment's ends by as much over that angle.
constexpr double SIDE_ROUNDING = 0.125;

/// A region's pieces in the frame of an overlap.
class PlacedRegion {
 public:
  PlacedRegion(const ShapeSide& side, std::int32_t region, const PlanarFrame& frame_W)
      : shape_(side.shape.shapes.of_region(region)) {
    if (shape_ == nullptr) {
      const Triangle t = side.surface.mesh.triangle(side.shape.lead_of_region(region));
      single_ = ConvexPolygon(frame_W, side.is_moving ? side.X_WS.triangle(t) : t);
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

  /// Calls visit(piece) for the pieces near some points.
  template <class Points>
  void find_near(const Points& points, double reach, std::vector<std::int32_t>& near) const {
    near.clear();
    if (shape_ == nullptr) {
      near.push_back(0);
      return;
    }
    Box2 box;
    for (const Vec2& x : points) box.add(turn_back_ * (x - origin_));
    shape_->piece_grid.for_each_near(box, reach, [&](std::int32_t index) { near.push_back(index); });
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }

  void find_near_segment(const Vec2& a, const Vec2& b, double reach, std::vector<std::int32_t>& near) const {
    near.clear();
    if (shape_ == nullptr) {
      near.push_back(0);
      return;
    }
    shape_->piece_grid.for_each_near(turn_back_ * (a - origin_), turn_back_ * (b - origin_), reach,
                                     [&](std::int32_t index) { near.push_back(index); });
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }

  std::span<const std::int32_t> neighbours(std::int32_t piece) const {
    return shape_ == nullptr ? std::span<const std::int32_t>() : shape_->piece_neighbours[piece];
  }

 private:
  const RegionShape* shape_;
  ConvexPolygon single_;
  Vec2 origin_ = Vec2::Zero();
  Eigen::Matrix2d turn_ = Eigen::Matrix2d::Identity(), turn_back_ = Eigen::Matrix2d::Identity();
  bool is_turned_over_ = false;
};

struct Cut {
  std::int32_t of_moving, of_fixed;
  ConvexPolygon polygon;
  Box2 box;
};

/// Whether a polygon is no wider than a length: by its area, over its longest side.
bool is_no_wider(const ConvexPolygon& polygon, double area, double width) {
  double longest = 0.0;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k)
    longest =
        std::max(longest, (polygon.corners[(k + 1) % polygon.corners.size()] - polygon.corners[k]).norm());
  return !(area > width * longest);
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

std::vector<OverlapPart> overlap_of_regions(const ShapeSide& moving, std::int32_t region_moving,
                                            const ShapeSide& fixed, std::int32_t region_fixed,
                                            const PlanarFrame& frame_W, double rounding) {
  const PlacedRegion a(moving, region_moving, frame_W), b(fixed, region_fixed, frame_W);
  const bool ask_b = a.size() <= b.size();
  const PlacedRegion &few = ask_b ? a : b, &many = ask_b ? b : a;
  std::vector<Cut> cuts;
  std::vector<std::int32_t> near;
  for (std::size_t i = 0; i < few.size(); ++i) {
    const ConvexPolygon own = few.piece(i);
    many.find_near(own.corners, rounding, near);
    for (const std::int32_t j : near) {
      const ConvexPolygon other = many.piece(static_cast<std::size_t>(j));
      if (!own.touches(other, 0.0)) continue;
      ConvexPolygon cut = ask_b ? own.cut_by(other) : other.cut_by(own);
      if (is_no_wider(cut, cut.measure().area, rounding)) continue;
      const auto index = static_cast<std::int32_t>(i);
      const Box2 box = cut.box();
      cuts.push_back({ask_b ? index : j, ask_b ? j : index, std::move(cut), box});
    }
  }
  const auto key = [](const Cut& cut) { return std::pair(cut.of_moving, cut.of_fixed); };
  std::ranges::sort(cuts, [&](const Cut& x, const Cut& y) { return key(x) < key(y); });

  std::vector<std::size_t> parents(cuts.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const auto join_with = [&](std::size_t k, std::int32_t i, std::int32_t j) {
    const std::pair wanted(i, j);
    const auto found = std::lower_bound(cuts.begin(), cuts.end(), wanted,
                                        [&](const Cut& cut, const auto& pair) { return key(cut) < pair; });
    if (found == cuts.end() || key(*found) != wanted) return;
    const auto other = static_cast<std::size_t>(found - cuts.begin());
    if (other >= k) return;
    const std::size_t root_k = root_of(parents, k), root_other = root_of(parents, other);
    if (root_k == root_other || !cuts[k].box.comes_within(cuts[other].box, rounding) ||
        !cuts[k].polygon.touches(cuts[other].polygon, rounding))
      return;
    parents[std::max(root_k, root_other)] = std::min(root_k, root_other);
  };
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const auto of_fixed = b.neighbours(cuts[k].of_fixed);
    for (const std::int32_t j : of_fixed) join_with(k, cuts[k].of_moving, j);
    for (const std::int32_t i : a.neighbours(cuts[k].of_moving)) {
      join_with(k, i, cuts[k].of_fixed);
      for (const std::int32_t j : of_fixed) join_with(k, i, j);
    }
  }

  std::vector<OverlapPart> parts;
  std::vector<std::size_t> part_of_root(cuts.size());
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const std::size_t root = root_of(parents, k);
    if (root == k) {
      part_of_root[k] = parts.size();
      parts.emplace_back();
    }
    OverlapPart& part = parts[part_of_root[root]];
    const AreaAndCentroid measure = cuts[k].polygon.measure();
    part.area += measure.area;
    part.centroid += measure.area * measure.centroid;
    part.pieces.push_back(std::move(cuts[k].polygon));
  }
  for (OverlapPart& part : parts) part.centroid /= part.area;
  return parts;
}

std::vector<SegmentPart> parts_over_region(const Vec3& begin, const Vec3& end, const ShapeSide& side,
                                           std::int32_t region, const PlanarFrame& frame_W, double rounding) {
  const PlacedRegion placed(side, region, frame_W);
  const Vec2 a = frame_W.flat(begin), b = frame_W.flat(end);
  const double length = (end - begin).norm();
  std::vector<std::int32_t> near;
  placed.find_near_segment(a, b, rounding, near);
  std::vector<SegmentPart> parts;
  for (const std::int32_t index : near) {
    const SegmentPart part =
        placed.piece(static_cast<std::size_t>(index)).part_of(a, b, SIDE_ROUNDING * rounding);
    if (part.end > part.begin) parts.push_back(part);
  }
  std::ranges::sort(parts, [](const SegmentPart& x, const SegmentPart& y) { return x.begin < y.begin; });
  std::vector<SegmentPart> joined;
  for (const SegmentPart& part : parts) {
    if (!joined.empty() && (part.begin - joined.back().end) * length <= rounding)
      joined.back().end = std::max(joined.back().end, part.end);
    else
      joined.push_back(part);
  }
  std::erase_if(joined,
                [&](const SegmentPart& part) { return (part.end - part.begin) * length <= rounding; });
  return joined;
}

bool region_holds(const ShapeSide& side, std::int32_t region, const Vec3& p_S, double reach) {
  const auto is_near = [&](std::int32_t t) {
    return (point_triangle_distance(p_S, side.surface.mesh.triangle(t)).point - p_S).squaredNorm() <=
           reach * reach;
  };
  const RegionShape* shape = side.shape.shapes.of_region(region);
  if (shape == nullptr) return is_near(side.shape.lead_of_region(region));
  Box2 box;
  box.add(shape->frame.flat(p_S));
  bool holds = false;
  side.shape.for_each_face_near(region, box, reach, [&](std::int32_t t) { holds = holds || is_near(t); });
  return holds;
}

}  // namespace lmdbench
