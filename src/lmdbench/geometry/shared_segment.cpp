// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/shared_segment.h>
#include <lmdbench/geometry/sorted_triangle.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench::kernel {
namespace {

/// Part of the longest edge by which the corners are off the plane, and the overlap is long, in a certain
/// intersection; also the least ratio of altitude and edge of the face. Rounding moves the ends of the chord
/// by 1e-16 over this.
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
    // From the nearer end, where the division is the more accurate.
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
