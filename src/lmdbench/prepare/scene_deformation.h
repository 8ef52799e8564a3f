// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>
#include <lmdbench/prepare/frame_vertices.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace lmdbench {

/// What a frame changes of a mesh against the frame before, of the first frame against the mesh at rest. Triangles that turn over or
/// lose their area are facts, no errors: the mesh is what its vertices say.
struct DeformationStep {
  std::int64_t moved_vertices = 0;
  double largest_move = 0.0;     ///< Of a vertex [m].
  std::int64_t turned_over = 0;  ///< Triangles whose normal turned by more than a right angle.
  std::int64_t lost_area = 0;    ///< Triangles that had an area and have none.
  std::int32_t first_turned_over = -1;
  std::int32_t first_lost_area = -1;
};

/// A body of a scene that deforms: with it all objects that share it.
struct DeformingBody {
  std::shared_ptr<const Body> rest;
  std::shared_ptr<const FrameVertices> vertices;
  std::vector<DeformationStep> steps = {};  ///< One a frame.
  double farthest = 0.0;                    ///< Longest way of a vertex from where it is at rest [m].
};

/// How the bodies of a scene deform in each frame. Immutable.
class SceneDeformation {
 public:
  /// Goes through all frames once.
  /// @param bodies without steps
  /// @throws InputError naming the experiment's place and the frame for vertices that no mesh can have
  SceneDeformation(std::vector<DeformingBody> bodies, std::int64_t frames);

  const std::vector<DeformingBody>& bodies() const { return bodies_; }
  /// @param body at rest
  /// @return null for one that does not deform
  const DeformingBody* find(const Body* body) const;
  std::int64_t frames() const { return static_cast<std::int64_t>(ways_.size()); }

  /// Bound on how much two points of different bodies come nearer or get farther apart from one frame to another, poses aside [m].
  double way(std::int64_t from, std::int64_t to) const;
  /// Longest way of a vertex of a body from where it is at rest [m]; 0 for one that does not deform.
  double farthest(const Body* body) const;

 private:
  std::vector<DeformingBody> bodies_;
  std::vector<double> ways_;  ///< Sum of the largest moves of all bodies up to each frame.
};

}  // namespace lmdbench
