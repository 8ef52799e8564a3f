// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/planar_overlap.h>
#include <lmdbench/geometry/sorted_triangle.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench::kernel {
namespace {

/// A triangle cut by three half planes has at most six corners.
struct Polygon {
  std::array<Vec2, 6> corners;
  int size = 0;
};

/// The part of the polygon to the left of the line from p to q (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, const Vec2& p, const Vec2& q) {
  Polygon result;
  for (int i = 0; i < polygon.size; ++i) {
    const Vec2& from = polygon.corners[i];
    const Vec2& to = polygon.corners[(i + 1) % polygon.size];
    const double side_from = cross(q - p, from - p);
    const double side_to = cross(q - p, to - p);
    if (side_from >= 0.0 && result.size < 6) result.corners[result.size++] = from;
    if ((side_from > 0.0 && side_to < 0.0) || (side_from < 0.0 && side_to > 0.0)) {
      if (result.size < 6)
        result.corners[result.size++] = from + (side_from / (side_from - side_to)) * (to - from);
    }
  }
  return result;
}

/// Weights of a triangle's corners for a point of its plane.
FaceFrame::Weights planar_weights(const std::array<Vec2, 3>& t, const Vec2& x) {
  const double double_area = cross(t[1] - t[0], t[2] - t[0]);
  const double b = cross(x - t[0], t[2] - t[0]) / double_area;
  const double c = cross(t[1] - t[0], x - t[0]) / double_area;
  return {1.0 - b - c, b, c};
}

}  // namespace

EdgeOverFace edge_over_face(const Vec3& x0, const Vec3& x1, const FaceFrame& face, double tolerance) {
  LMDBENCH_EXPECTS(face.has_face, "a triangle without area: the caller asks only for faces");
  EdgeOverFace result;
  const FaceFrame::Weights w0 = face.weights(x0);
  const FaceFrame::Weights w1 = face.weights(x1);
  double begin = 0.0;
  double end = 1.0;
  for (const auto& [from, to] : {std::array{w0.a, w1.a}, std::array{w0.b, w1.b}, std::array{w0.c, w1.c}}) {
    if (from < 0.0 && to < 0.0) return result;
    if (from < 0.0) begin = std::max(begin, from / (from - to));
    if (to < 0.0) end = std::min(end, from / (from - to));
  }
  const double length = (end - begin) * (x1 - x0).norm();
  if (!(length > tolerance)) return result;
  const double middle = 0.5 * (begin + end);
  const FaceFrame::Weights w{w0.a + middle * (w1.a - w0.a), w0.b + middle * (w1.b - w0.b),
                             w0.c + middle * (w1.c - w0.c)};
  if (!face.is_interior(w)) return result;
  result.exists = true;
  result.length = length;
  result.middle_on_edge = x0 + middle * (x1 - x0);
  result.middle_on_face = face.point(w);
  return result;
}

FaceOverFace face_over_face(const FaceFrame& first, const FaceFrame& second, double tolerance) {
  LMDBENCH_EXPECTS(first.has_face && second.has_face,
                   "a triangle without area: the caller asks only for faces");
  FaceOverFace result;
  // Coordinates along e and h of the first face, metres.
  const double length_e = std::sqrt(first.squared_e);
  const double length_h = std::sqrt(first.squared_h);
  const auto planar = [&](const Vec3& x) {
    const Vec3 from_a = x - first.a;
    const double s = from_a.dot(first.e) / first.squared_e;
    return Vec2(s * length_e, (from_a - s * first.e).dot(first.h) / length_h);
  };
  const std::array<Vec2, 3> projected{planar(second.a), planar(second.a + second.e),
                                      planar(second.a + second.ca)};
  Polygon polygon;
  polygon.size = 3;
  std::copy(projected.begin(), projected.end(), polygon.corners.begin());
  if (cross(polygon.corners[1] - polygon.corners[0], polygon.corners[2] - polygon.corners[0]) < 0.0) {
    std::swap(polygon.corners[1], polygon.corners[2]);
  }
  const std::array<Vec2, 3> frame{Vec2::Zero(), Vec2(length_e, 0.0), Vec2(first.u * length_e, length_h)};
  for (int k = 0; k < 3 && polygon.size > 0; ++k) polygon = cut(polygon, frame[k], frame[(k + 1) % 3]);
  if (polygon.size < 3) return result;
  const AreaAndCentroid whole =
      area_and_centroid({polygon.corners.data(), static_cast<std::size_t>(polygon.size)});
  double longest = 0.0;
  for (int i = 0; i < polygon.size; ++i) {
    longest = std::max(longest, (polygon.corners[(i + 1) % polygon.size] - polygon.corners[i]).norm());
  }
  if (!(whole.area > tolerance * longest)) return result;
  result.exists = true;
  result.area = whole.area;
  result.centroid_on_first =
      first.a + whole.centroid[0] / length_e * first.e + whole.centroid[1] / length_h * first.h;
  // Two faces that drift apart by rounding only may be at an angle where one is tiny: the
  // perpendiculars of the two faces then meet the second's plane at different points.
  FaceFrame::Weights on_second = second.weights(result.centroid_on_first);
  if (second.is_outside(on_second)) on_second = planar_weights(projected, whole.centroid);
  result.centroid_on_second = second.point(on_second);
  return result;
}

namespace {

/// In a certain intersection: least height of the corners over the plane and least overlap, in
/// parts of the longest edge; also least ratio of the face's altitude and edge. Rounding moves the
/// ends of the chord by 1e-16 over this.
constexpr double CERTAIN_PART = 1e-5;

}  // namespace

SharedSegment shared_segment(const FaceFrame& face, const Triangle& corners) {
  SharedSegment result;
  const Vec3 normal = face.e.cross(face.h);
  std::array<double, 3> height;
  std::array<Vec3, 3> ends;
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    height[k] = normal.dot(corners[k] - face.a);
    if (height[k] == 0.0) ends[count++] = corners[k];
  }
  if (count == 3) return result;  // coplanar
  for (const auto& [i, j] : EDGE_ENDS) {
    if (!(height[i] * height[j] < 0.0) || count == 2) continue;
    // From the nearer end, where the division is more accurate.
    const int near = std::abs(height[i]) <= std::abs(height[j]) ? i : j;
    const int far = i + j - near;
    ends[count++] =
        corners[near] + height[near] / (height[near] - height[far]) * (corners[far] - corners[near]);
  }
  if (count == 0) return result;
  if (count == 1) ends[1] = ends[0];
  const FaceFrame::Weights w0 = face.weights(ends[0]);
  const FaceFrame::Weights w1 = face.weights(ends[1]);
  double begin = 0.0, end = 1.0;
  result.is_clear = true;
  for (const auto& [from, to] : {std::array{w0.a, w1.a}, std::array{w0.b, w1.b}, std::array{w0.c, w1.c}}) {
    if (from < 0.0 && to < 0.0) {
      result.is_clear = false;
    } else if (from < 0.0) {
      begin = std::max(begin, from / (from - to));
    } else if (to < 0.0) {
      end = std::min(end, from / (from - to));
    }
  }
  if (begin > end) {
    result.is_clear = false;
    begin = end = std::clamp(0.5 * (begin + end), 0.0, 1.0);
  }
  const Vec3 chord = ends[1] - ends[0];
  result.begin = ends[0] + begin * chord;
  result.end = end == 1.0 ? ends[1] : Vec3(ends[0] + end * chord);
  result.length = (end - begin) * chord.norm();
  const double squared_longest =
      std::max({face.squared_e, (corners[1] - corners[0]).squaredNorm(),
                (corners[2] - corners[1]).squaredNorm(), (corners[2] - corners[0]).squaredNorm()});
  constexpr double SQUARED_PART = CERTAIN_PART * CERTAIN_PART;
  const double least_squared_height =
      std::min({height[0] * height[0], height[1] * height[1], height[2] * height[2]});
  result.is_certain = result.is_clear && face.squared_h > SQUARED_PART * face.squared_e &&
                      result.length * result.length > SQUARED_PART * squared_longest &&
                      least_squared_height > SQUARED_PART * squared_longest * face.squared_e * face.squared_h;
  return result;
}

SharedSegment shared_segment(const Triangle& a, const FaceFrame& face_a, const Triangle& b,
                             const FaceFrame& face_b) {
  const bool use_a = face_a.has_face && (!face_b.has_face || face_a.squared_h >= face_b.squared_h);
  if (use_a) return shared_segment(face_a, b);
  return face_b.has_face ? shared_segment(face_b, a) : SharedSegment{};
}

}  // namespace lmdbench::kernel
