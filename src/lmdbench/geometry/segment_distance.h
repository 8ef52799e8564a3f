// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <array>
#include <cstdint>
#include <limits>

namespace lmdbench {

/// The feature of a segment that carries a closest point.
enum class SegmentFeature : std::uint8_t { V0, V1, EDGE };

struct PointSegmentDistance {
  double squared_distance = std::numeric_limits<double>::quiet_NaN();
  Vec3 point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< on the segment
  SegmentFeature feature = SegmentFeature::EDGE;
};

/// Closest points of two segments. The invariants are those of TrianglePairDistance: the squared
/// distance is that of the two points, ends are bit-copies, parallel segments that overlap give the
/// middle of the overlap.
struct SegmentPairDistance {
  double squared_distance = std::numeric_limits<double>::quiet_NaN();
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  SegmentFeature feature_a = SegmentFeature::EDGE;
  SegmentFeature feature_b = SegmentFeature::EDGE;
  int minimiser_dimension = 0;     ///< 1 where the segments are parallel and overlap
  double minimiser_measure = 0.0;  ///< length of the overlap
};

/// Point of the segment nearest to `point`. Reversing the segment changes only the names of its
/// ends.
PointSegmentDistance point_segment_distance(const Vec3& point, const Segment& segment);

/// Swapping the segments or reversing one gives the same points bit for bit.
SegmentPairDistance segment_distance(const Segment& a, const Segment& b);

}  // namespace lmdbench
