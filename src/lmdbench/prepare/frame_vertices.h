// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/experiment/mesh_deformation.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/placement.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lmdbench {

/// A mesh that deforms, as the experiment places it.
struct DeformingMesh {
  const TriangleMesh& in_file;  ///< As it was read: what vertex files are held against.
  Placement placement;          ///< Of `in_file`; vertex files are placed by the same move and scale.
  const TriangleMesh& placed;   ///< In the mesh's own frame [m]: what a generator deforms.
  std::optional<Pose> X_WF;     ///< Of a fixed mesh: takes the vertices into the world.
};

/// The vertices of a mesh that deforms, frame by frame.
class FrameVertices {
 public:
  /// @param frame_rate_hz haptic frames a second
  /// @throws InputError naming the file for vertex files that are not there, have another number of vertices, other triangles or a
  ///         coordinate that is no number; UsageError where they take more memory than FILE_BYTES allows
  FrameVertices(const MeshDeformation& deformation, const DeformingMesh& mesh, double frame_rate_hz);

  /// @param frame at least 0
  void at(std::int64_t frame, std::vector<Vec3>& vertices) const;

  const MeshDeformation& deformation() const { return deformation_; }
  /// Of the bytes of all vertex files, in their order; empty for a generator.
  const std::string& sha256() const { return sha256_; }
  std::int64_t file_bytes() const { return file_bytes_; }

 private:
  void read_files(const DeformingMesh& mesh);

  MeshDeformation deformation_;
  std::optional<Deformation> generator_;
  std::vector<std::vector<Vec3>> shapes_;  ///< Of a sequence; in the frame of the scene's body.
  std::optional<RigidTransform> X_WF_;
  double period_frames_ = 0.0;  ///< Of a generator, or from one shape to the next.
  std::string sha256_;
  std::int64_t file_bytes_ = 0;
};

/// Vertices as text: a line each, `x y z`, separated by blanks or commas; `#` begins a comment.
/// @param name for messages
/// @throws InputError naming the line: not three numbers, not finite
std::vector<Vec3> parse_vertex_list(const std::string& text, const std::string& name);

}  // namespace lmdbench
