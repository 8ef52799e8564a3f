// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/types.h>

namespace lmdbench::kernel {

/// Part of a segment whose projection falls on a face.
struct EdgeOverFace {
  bool exists = false;
  Vec3 middle_on_edge, middle_on_face;
  double length = 0.0;
};

/// Overlap of the segment x0 x1, parallel to the face's plane, with the face. Does not exist where
/// it is shorter than the tolerance or along an edge of the face (edge pairs find that).
EdgeOverFace edge_over_face(const Vec3& x0, const Vec3& x1, const FaceFrame& face, double tolerance);

/// Overlap of two parallel faces, projected on the first.
struct FaceOverFace {
  bool exists = false;
  Vec3 centroid_on_first, centroid_on_second;
  double area = 0.0;
};

/// Does not exist where the overlap is narrower than the tolerance.
FaceOverFace face_over_face(const FaceFrame& first, const FaceFrame& second, double tolerance);

/// What two intersecting triangles of different planes share.
struct SharedSegment {
  bool is_clear = false;  ///< false without a chord, or if only rounding has it over the face
  bool is_certain =
      false;  ///< the triangles intersect by a margin (CERTAIN_PART) that needs no exact predicate
  Vec3 begin, end;
  double length = 0.0;

  Vec3 middle() const { return 0.5 * (begin + end); }
};

/// Cuts `corners` by the face's plane and keeps the part of the chord over the face. The chord lies
/// on edges of `corners` and is cut in the frame of `face`, so both ends are on both triangles up
/// to rounding however thin `corners` is. The better-shaped triangle should be the face.
/// @pre corners in lexicographic order, face.has_face
SharedSegment shared_segment(const FaceFrame& face, const Triangle& corners);

/// The better-shaped triangle as the face; not clear where neither has a face.
SharedSegment shared_segment(const Triangle& a, const FaceFrame& face_a, const Triangle& b,
                             const FaceFrame& face_b);

}  // namespace lmdbench::kernel
