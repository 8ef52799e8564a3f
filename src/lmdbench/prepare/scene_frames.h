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

/// All of a scene that depends on the frame, except the pose of the moving mesh.
struct SceneMotion {
  std::shared_ptr<const MoverPlay> movers = nullptr;              ///< Null where only one moves.
  std::shared_ptr<const SceneDeformation> deformation = nullptr;  ///< Null where all are rigid.

  bool is_any() const { return movers != nullptr || deformation != nullptr; }
};

/// The scene frame by frame, for one user: all poses but the moving mesh's, and all shapes. Bodies
/// that deform are own copies, so what a method prepared of them follows for it alone, at its cost.
class SceneFrames {
 public:
  /// Begins in the first frame, with meshes at rest.
  /// @param rest includes the movers of `motion`
  SceneFrames(const Scene& rest, const SceneMotion& motion);

  const Scene& scene() const { return scene_; }
  bool deforms() const { return motion_.deformation != nullptr; }
  bool is_any() const { return motion_.is_any(); }

  /// The extra cost of the first step (Body::deform). Call it after all preparations.
  void prepare_to_deform();
  /// Goes to a frame. Frames may come in any order; after the last one the scene does not change.
  /// @return time for bodies and preparations to follow [s], without the making of the vertices
  double to_frame(std::int64_t frame);
  /// Only moves movers; shapes stay.
  void move_to_frame(std::int64_t frame);

 private:
  Scene scene_;
  SceneMotion motion_;
  std::shared_ptr<std::vector<Pose>> poses_;  ///< Of the movers.
  std::vector<std::shared_ptr<Body>> own_;    ///< One a deforming body, in their order.
  std::vector<Vec3> vertices_;                ///< Scratch.
};

}  // namespace lmdbench
