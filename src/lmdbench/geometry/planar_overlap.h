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

/// Overlap of the segment x0 x1, parallel to the face's plane, with the face. Does not exist where it is
/// shorter than the tolerance or runs along an edge of the face (which the edges answer).
EdgeOverFace edge_over_face(const Vec3& x0, const Vec3& x1, const FaceFrame& face, double tolerance);

/// Overlap of two parallel faces, projected on the first.
struct FaceOverFace {
  bool exists = false;
  Vec3 centroid_on_first, centroid_on_second;
  double area = 0.0;
};

/// Does not exist where the overlap is narrower than the tolerance.
FaceOverFace face_over_face(const FaceFrame& first, const FaceFrame& second, double tolerance);

}  // namespace lmdbench::kernel
