// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>
#include <lmdbench/prepare/frame_vertices.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace lmdbench {

/// Changes of a mesh against the previous frame, of the first frame against the mesh at rest.
/// Triangles that turn over or lose their area are no errors: the mesh is as its vertices are.
struct DeformationStep {
  std::int64_t moved_vertices = 0;
  double largest_move = 0.0;     ///< Of one vertex [m].
  std::int64_t turned_over = 0;  ///< Triangles whose normal turned by more than a right angle.
  std::int64_t lost_area = 0;    ///< Triangles that had an area and have none.
  std::int32_t first_turned_over = -1;
  std::int32_t first_lost_area = -1;
};

/// A deforming body of a scene, for all objects that share it.
struct DeformingBody {
  std::shared_ptr<const Body> rest;
  std::shared_ptr<const FrameVertices> vertices;
  std::vector<DeformationStep> steps = {};  ///< One a frame.
  double farthest = 0.0;                    ///< Largest distance of a vertex from rest [m].
};

/// How the bodies of a scene deform in each frame. Immutable.
class SceneDeformation {
 public:
  /// Goes through all frames once.
  /// @param bodies without steps
  /// @throws InputError naming the experiment's place and the frame with impossible vertices
  SceneDeformation(std::vector<DeformingBody> bodies, std::int64_t frames);

  const std::vector<DeformingBody>& bodies() const { return bodies_; }
  /// @param body at rest
  /// @return null for a rigid one
  const DeformingBody* find(const Body* body) const;
  std::int64_t frames() const { return static_cast<std::int64_t>(ways_.size()); }

  /// Bound on the change of distance of two bodies' points between frames, at fixed poses [m].
  double way(std::int64_t from, std::int64_t to) const;
  /// Largest distance of a vertex of a body from its place at rest [m]; 0 for a rigid body.
  double farthest(const Body* body) const;

 private:
  std::vector<DeformingBody> bodies_;
  std::vector<double> ways_;  ///< Sum of the largest moves of all bodies up to each frame.
};

}  // namespace lmdbench
