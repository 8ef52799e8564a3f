// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>

namespace lmdbench {

/// Distance of a mesh's middle from an origin, in half diagonals, from which on it is moved. Nearer
/// ones stay: their coordinates cost a few times the rounding of the mesh's own size.
inline constexpr double FAR_AWAY = 16.0;

/// A scene in frames whose origins lie amid the meshes (certified/PROOF.md, lemma 1): coordinates
/// are of the meshes' size.
///
/// At coordinates C computed points are off by about 1e-16 C, and a direction between two points at
/// distance d by 1e-16 C / d. At edges below about 1e-8 C that exceeds every tolerance of the
/// definition: which LMDs there are is chance, and two exact methods disagree. Differences of
/// neighbouring numbers are exact, so far vertices lose nothing when they are moved. The pose is
/// composed with both shifts once: it moves the mesh as a whole by 1e-16 C and turns nothing.
/// Meshes that deform keep the origins that they had at rest, so all methods ask in one frame.
class NearFrame {
 public:
  /// @param of_pair `Scene::is_pair`
  explicit NearFrame(const Scene& of_pair);

  /// False when no mesh is far from its frame's origin: then the scene is the one that was given.
  bool differs() const { return differs_; }
  const Scene& scene() const { return scene_; }
  Pose to_near(const Pose& X_WM) const;
  /// Of the near world, in the world: added to points. Distances and directions stay: they are more
  /// accurate in the near frame than from the world's rounded points.
  const Vec3& origin_W() const { return origin_W_; }

 private:
  Scene scene_;
  Vec3 origin_M_ = Vec3::Zero();  ///< Of the near frame of the moving mesh, in its own frame.
  Vec3 origin_W_ = Vec3::Zero();  ///< Of the near world, in the world.
  bool differs_ = false;
};

}  // namespace lmdbench
