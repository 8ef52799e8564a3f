// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>

namespace lmdbench {

/// Distance of a mesh's middle from an origin, in half diagonals, from which on the mesh counts as far away.
/// Nearer ones are left as they are: what rounding at their coordinates costs is a few units of the rounding
/// that the mesh's own size brings.
inline constexpr double FAR_AWAY = 16.0;

/// A scene in frames whose origins lie amid the meshes (certified/PROOF.md, lemma 1), so that coordinates are of the meshes' size.
///
/// At coordinates C every computed point is off by about 1e-16 C, and a direction between two points at the
/// distance d by 1e-16 C / d. Where edges are shorter than about 1e-8 C, that is more than any tolerance of the
/// definition, and which LMDs there are is chance: the kernel no longer tells a face from its edge, and two
/// exact methods disagree. Nothing of this is the meshes' doing. Differences of neighbouring numbers are exact,
/// so moving the vertices to an origin amid them loses nothing; the pose is composed with both shifts once,
/// which moves the moving mesh as a whole by 1e-16 C and turns nothing.
class NearFrame {
 public:
  /// @param of_pair `Scene::is_pair`
  explicit NearFrame(const Scene& of_pair);

  /// False when no mesh is far from its frame's origin: then the scene is the one that was given.
  bool differs() const { return differs_; }
  const Scene& scene() const { return scene_; }
  Pose to_near(const Pose& X_WM) const;
  /// Of the near world, in the world: what is to be added to points. Distances and directions, which are accurate in the near frame,
  /// stay, so that they are better than what the world's rounded points give.
  const Vec3& origin_W() const { return origin_W_; }

 private:
  Scene scene_;
  Vec3 origin_M_ = Vec3::Zero();  ///< Of the near frame of the moving mesh, in its own frame.
  Vec3 origin_W_ = Vec3::Zero();  ///< Of the near world, in the world.
  bool differs_ = false;
};

}  // namespace lmdbench
