// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/experiment/mesh_deformation.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/placement.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// A deforming mesh, as the experiment places it.
struct DeformingMesh {
  const TriangleMesh& in_file;  ///< As read: the base of vertex files.
  Placement placement;          ///< Of `in_file`, and so of vertex files.
  const TriangleMesh& placed;   ///< In the mesh's own frame [m], for a generator.
  std::optional<Pose> X_WF;     ///< Of a fixed mesh: pose of the vertices in the world.
};

/// The vertices of a deforming mesh, frame by frame.
class FrameVertices {
 public:
  /// @param frame_rate_hz haptic frames a second
  /// @throws InputError naming the file for vertex files that are missing or have another number of
  ///   vertices, other triangles or a coordinate not finite; UsageError for more than FILE_BYTES
  FrameVertices(const MeshDeformation& deformation, const DeformingMesh& mesh, double frame_rate_hz);

  /// @param frame at least 0
  void at(std::int64_t frame, std::vector<Vec3>& vertices) const;

  const MeshDeformation& deformation() const { return deformation_; }
  /// Over the bytes of all vertex files, in their order; empty for a generator.
  const std::string& sha256() const { return sha256_; }
  std::int64_t file_bytes() const { return file_bytes_; }

 private:
  void read_files(const DeformingMesh& mesh);

  MeshDeformation deformation_;
  std::optional<Deformation> generator_;
  std::vector<std::vector<Vec3>> shapes_;  ///< Of a sequence; in the frame of the scene's body.
  std::optional<RigidTransform> X_WF_;
  double period_frames_ = 0.0;  ///< Of a generator; of a sequence from shape to shape.
  std::string sha256_;
  std::int64_t file_bytes_ = 0;
};

/// Vertices as text: a line each, `x y z`, separated by blanks or commas; `#` begins a comment.
/// @param name for messages
/// @throws InputError naming the line: not three numbers, not finite
std::vector<Vec3> parse_vertex_list(const std::string& text, const std::string& name);

}  // namespace lmdbench
