// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/deform/refit_bounds.h>
#include <lmdbench/methods/certified/layout/single_precision.h>
#include <lmdbench/methods/certified/layout/wide_lane.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace lmdbench {

namespace {

/// Steps that axes and centres are refined by.
constexpr int AXIS_STEPS = 12, CENTRE_STEPS = 12;

/// Middle of the box of points, moved along the axis to the middle of their extent along it.
Vec3 middle_of(std::span<const Vec3> points, const Vec3& axis) {
  Vec3 low = points[0], high = low;
  double least = low.dot(axis), greatest = least;
  for (const Vec3& p : points.subspan(1)) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    const double along = p.dot(axis);
    least = std::min(least, along);
    greatest = std::max(greatest, along);
  }
  const Vec3 middle = 0.5 * (low + high);
  return middle + (0.5 * (least + greatest) - middle.dot(axis)) * axis;
}

void store_centre(WideNode& node, std::uint32_t lane, const Vec3& centre) {
  for (int k = 0; k < 3; ++k) node.centre[k][lane] = to_single(centre[k]);
}

void store_sizes(WideNode& node, std::uint32_t lane, double radius, double thickness, bool has_axis,
                 double rounding) {
  node.radius[lane] = round_up_to_single(radius * (1.0 + 1e-15) + rounding);
  node.thickness[lane] =
      has_axis ? round_up_to_single(thickness * (1.0 + 1e-15) + rounding) : UNBOUNDED_THICKNESS;
}

/// Bounds points by a body about a centre along an axis, both as they are stored.
void bound_points(WideNode& node, std::uint32_t lane, std::span<const Vec3> points, const Vec3& axis,
                  double rounding) {
  const Vec3 centre = centre_of_lane(node, lane);
  double squared_radius = 0.0, thickness = 0.0;
  for (const Vec3& p : points) {
    const Vec3 from = p - centre;
    squared_radius = std::max(squared_radius, from.squaredNorm());
    thickness = std::max(thickness, std::abs(from.dot(axis)));
  }
  store_sizes(node, lane, std::sqrt(squared_radius), thickness, !axis.isZero(0.0), rounding);
}

/// How far a lane's body extends along a unit direction from its centre: to its sphere, or to the
/// rim where its slab cuts the sphere off.
double reach_of_lane(const WideNode& node, std::uint32_t lane, const Vec3& direction) {
  const double radius = static_cast<double>(node.radius[lane]);
  const double thickness = std::min(radius, static_cast<double>(node.thickness[lane]));
  const double cosine = std::min(1.0, std::abs(axis_of_lane(node, lane).dot(direction)));
  if (!(radius * cosine > thickness)) return radius;
  // Axes are unit up to rounding of single precision.
  return std::min(radius, thickness * cosine +
                              std::sqrt((radius * radius - thickness * thickness) * (1.0 - cosine * cosine)) +
                              1e-6 * radius);
}

}  // namespace

void bound_feature(WideNode& node, std::uint32_t lane, const WideHierarchy& hierarchy, const Surface& surface,
                   const WideItem& item) {
  FeatureCorners corners(surface, item.ref.feature_id());
  std::array<Vec3, 3> points;
  std::size_t count = 0;
  for (const std::int32_t v : corners.view())
    points[count++] = surface.mesh.vertices[static_cast<std::size_t>(v)] - hierarchy.origin;
  const Vec3 axis = store_cap(node, lane, item.cap, item.carries_lmd);
  const std::span<const Vec3> own(points.data(), count);
  store_centre(node, lane, middle_of(own, axis));
  bound_points(node, lane, own, axis, hierarchy.rounding());
}

void InnerBounds::collect(Lane& lane, const WideNode& below, const WideHierarchy& hierarchy,
                          const Surface& surface, const ShapeComplex& shape) {
  lane.part_count = lane.point_count = 0;
  lane.all_plain = true;
  for (std::uint32_t l = 0; l < WIDE_WIDTH; ++l) {
    const WideRef ref = WideRef::from_bits(below.child[l]);
    if (ref.is_empty()) continue;
    lane.all_plain = lane.all_plain && ref.is_feature() && !shape.is_lead_of_several(ref.feature_id());
    if (ref.is_feature()) {
      lane.parts[lane.part_count++] = {&below, l};
      continue;
    }
    const WideNode& inner = hierarchy.nodes[ref.node_index()];
    for (std::uint32_t k = 0; k < WIDE_WIDTH; ++k)
      if (inner.child[k] != 0) lane.parts[lane.part_count++] = {&inner, k};
  }
  if (!lane.all_plain) {
    for (std::size_t k = 0; k < lane.part_count; ++k)
      lane.points[lane.point_count++] = centre_of_lane(*lane.parts[k].node, lane.parts[k].lane);
    return;
  }
  std::array<std::int32_t, 3 * WIDE_WIDTH> vertices;
  for (std::size_t k = 0; k < lane.part_count; ++k) {
    const FeatureCorners corners(surface, WideRef::from_bits(below.child[lane.parts[k].lane]).feature_id());
    for (const std::int32_t v : corners.view()) {
      const auto end = vertices.begin() + static_cast<std::ptrdiff_t>(lane.point_count);
      if (std::find(vertices.begin(), end, v) != end) continue;
      vertices[lane.point_count] = v;
      lane.points[lane.point_count++] = surface.mesh.vertices[static_cast<std::size_t>(v)] - hierarchy.origin;
    }
  }
}

/// @param count  of the longest list of parts; shorter ones repeat their last
void InnerBounds::put_caps(std::uint32_t lane, Lane& content, std::size_t count) {
  content.carries_lmd = false;
  content.has_axis = true;
  std::size_t k = 0;
  const Part* last = nullptr;
  const auto put = [&](const Part& part) {
    const std::size_t at = k++ * WIDE_WIDTH + lane;
    caps_.axes.x[at] = part.node->axis[0][part.lane];
    caps_.axes.y[at] = part.node->axis[1][part.lane];
    caps_.axes.z[at] = part.node->axis[2][part.lane];
    caps_.cosines[at] = part.node->cosine[part.lane];
    caps_.sines[at] = part.node->sine[part.lane];
  };
  for (std::size_t i = 0; i < content.part_count; ++i) {
    const Part& part = content.parts[i];
    if (!part.carries_lmd()) continue;
    content.carries_lmd = true;
    content.has_axis = content.has_axis && !axis_of_lane(*part.node, part.lane).isZero(0.0);
    last = &part;
    put(part);
  }
  content.has_axis = content.has_axis && content.carries_lmd;
  while (last != nullptr && k < count) put(*last);
}

/// Cone round the cones of a lane's parts about an axis; all directions from 90 degrees on, where
/// it is not convex (decision E1).
PolarCap InnerBounds::cap_about(const Lane& lane, const Vec3& chosen_axis) {
  const Vec3 axis = chosen_axis.normalized();
  double least = 1.0;
  for (std::size_t k = 0; k < lane.part_count; ++k) {
    const Part& part = lane.parts[k];
    if (!part.carries_lmd()) continue;
    const Vec3 own = axis_of_lane(*part.node, part.lane);
    // Axes are unit up to rounding of single precision.
    const double cosine = std::min(1.0, axis.dot(own) / own.norm());
    const double own_cosine = static_cast<double>(part.node->cosine[part.lane]);
    const double own_sine = std::sqrt(std::max(0.0, 1.0 - own_cosine * own_cosine));
    if (cosine * own_cosine - own_sine >= least) continue;  // most need no root
    least = std::min(least, cosine * own_cosine - std::sqrt(1.0 - cosine * cosine) * own_sine);
  }
  least -= 8.0 * std::numeric_limits<double>::epsilon();
  // Written so that an axis that is no number is refused.
  if (!(least > 0.0) || !axis.allFinite()) return {};
  return {axis, least, std::sqrt(std::max(0.0, 1.0 - least * least))};
}

void InnerBounds::bound(WideNode& node, std::uint32_t lanes, const WideHierarchy& hierarchy,
                        const Surface& surface, const ShapeComplex& shape) {
  const auto for_each_lane = [&](auto&& visit) {
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
      visit(lane, lanes_[lane]);
    }
  };
  std::size_t most_parts = 1, most_points = 1;
  for_each_lane([&](std::uint32_t lane, Lane& content) {
    collect(content, hierarchy.nodes[WideRef::from_bits(node.child[lane]).node_index()], hierarchy, surface,
            shape);
    most_parts = std::max(most_parts, content.part_count);
    most_points = std::max(most_points, content.point_count);
  });
  caps_.resize(most_parts);
  for_each_lane([&](std::uint32_t lane, Lane& content) { put_caps(lane, content, most_parts); });
  LaneVectors axes{};
  find_lane_axes(caps_, AXIS_STEPS, axes);
  points_.resize(most_points);
  for_each_lane([&](std::uint32_t lane, Lane& content) {
    const PolarCap cap =
        content.has_axis ? cap_about(content, Vec3(axes.x[lane], axes.y[lane], axes.z[lane])) : PolarCap{};
    store_cap(node, lane, cap, content.carries_lmd);
    axes.x[lane] = node.axis[0][lane];
    axes.y[lane] = node.axis[1][lane];
    axes.z[lane] = node.axis[2][lane];
    if (content.point_count == 0) content.points[content.point_count++] = Vec3::Zero();
    // From a point of the set: so small sets lose no digits.
    for (std::size_t k = 0; k < most_points; ++k)
      points_.set(k, lane, content.points[std::min(k, content.point_count - 1)] - content.points[0]);
  });
  LaneVectors offsets{};
  find_lane_centres(points_, axes, CENTRE_STEPS, offsets);
  for_each_lane([&](std::uint32_t lane, Lane& content) {
    store_centre(node, lane, content.points[0] + Vec3(offsets.x[lane], offsets.y[lane], offsets.z[lane]));
    if (content.part_count == 0) {  // All its features have lost their cones.
      store_sizes(node, lane, 0.0, 0.0, false, 0.0);
      return;
    }
    const Vec3 axis = axis_of_lane(node, lane);
    if (content.all_plain) {
      bound_points(node, lane, {content.points.data(), content.point_count}, axis, hierarchy.rounding());
      return;
    }
    const Vec3 centre = centre_of_lane(node, lane);
    double radius = 0.0, thickness = 0.0;
    for (std::size_t k = 0; k < content.part_count; ++k) {
      const Part& part = content.parts[k];
      const Vec3 from = content.points[k] - centre;
      radius = std::max(radius, from.norm() + static_cast<double>(part.node->radius[part.lane]));
      thickness = std::max(thickness, std::abs(from.dot(axis)) + reach_of_lane(*part.node, part.lane, axis));
    }
    store_sizes(node, lane, radius, thickness, !axis.isZero(0.0), hierarchy.rounding());
  });
}

}  // namespace lmdbench
