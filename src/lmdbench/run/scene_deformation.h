// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>
#include <lmdbench/run/frame_vertices.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
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

/// A body of a scene that deforms.
struct DeformingBody {
  std::size_t index = 0;  ///< 0: the moving one; i + 1: fixed mesh i.
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
  SceneDeformation(const Scene& rest, std::vector<DeformingBody> bodies, std::int64_t frames);

  const std::vector<DeformingBody>& bodies() const { return bodies_; }
  const DeformingBody* find(std::size_t index) const;

  /// Bound on how much two points of different bodies come nearer or get farther apart from one frame to another, poses aside [m].
  double way(std::int64_t from, std::int64_t to) const;
  /// Longest way of a vertex of a body from where it is at rest [m]; 0 for one that does not deform.
  double farthest(std::size_t index) const;

 private:
  std::vector<DeformingBody> bodies_;
  std::vector<double> ways_;  ///< Sum of the largest moves of all bodies up to each frame.
};

/// The scene in one frame after the other, for one user: the bodies that deform are copies of their own. So what a method has
/// prepared of them follows for it alone, and what that takes is its own.
class DeformingScene {
 public:
  /// @param deformation null where nothing deforms: the scene is then the one given
  DeformingScene(const Scene& rest, std::shared_ptr<const SceneDeformation> deformation);

  const Scene& scene() const { return scene_; }
  bool deforms() const { return deformation_ != nullptr; }

  /// What the first step costs beyond any other (Body::deform). For after the preparations were asked for.
  void prepare_to_deform();
  /// Gives the bodies the vertices of a frame; frames may come in any order.
  /// @return what the bodies and all that was prepared of them took to follow [s]; making the vertices is no part of it
  double to_frame(std::int64_t frame);

 private:
  Scene scene_;
  std::shared_ptr<const SceneDeformation> deformation_;
  std::vector<std::shared_ptr<Body>> own_;  ///< One a deforming body, in their order.
  std::vector<Vec3> vertices_;              ///< Scratch.
};

}  // namespace lmdbench
