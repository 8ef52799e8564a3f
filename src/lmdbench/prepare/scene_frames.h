// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>
#include <lmdbench/prepare/mover_play.h>
#include <lmdbench/prepare/scene_deformation.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace lmdbench {

/// What of a scene is a function of the frame, but for the pose of the moving mesh.
struct SceneMotion {
  std::shared_ptr<const MoverPlay> movers = nullptr;              ///< Null where one mesh moves.
  std::shared_ptr<const SceneDeformation> deformation = nullptr;  ///< Null where all meshes are rigid.

  bool is_any() const { return movers != nullptr || deformation != nullptr; }
};

/// The scene in one frame after the other, for one user: where everything is but the moving mesh, and the shape of what deforms. Bodies that
/// deform are copies of their own, so what a method has prepared of them follows for it alone, and what that takes is its own.
class SceneFrames {
 public:
  /// Begins in the first frame, with meshes at rest.
  /// @param rest with the movers of `motion` in it
  SceneFrames(const Scene& rest, const SceneMotion& motion);

  const Scene& scene() const { return scene_; }
  bool deforms() const { return motion_.deformation != nullptr; }
  bool is_any() const { return motion_.is_any(); }

  /// What the first step costs beyond any other (Body::deform). For after the preparations were asked for.
  void prepare_to_deform();
  /// Goes to a frame; frames may come in any order, and beyond the last one the scene stays.
  /// @return what the bodies and all that was prepared of them took to follow [s]; making the vertices is no part of it
  double to_frame(std::int64_t frame);
  /// Movers alone; shapes stay.
  void move_to_frame(std::int64_t frame);

 private:
  Scene scene_;
  SceneMotion motion_;
  std::shared_ptr<std::vector<Pose>> poses_;  ///< Of the movers.
  std::vector<std::shared_ptr<Body>> own_;    ///< One a deforming body, in their order.
  std::vector<Vec3> vertices_;                ///< Scratch.
};

}  // namespace lmdbench
