// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/near_frame.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace lmdbench {

/// Place of two meshes in a frame: takes LMDs from the method's frame to the world and back.
struct PlacedPair {
  RigidTransform X_WF{};
  Vec3 origin_F = Vec3::Zero();  ///< Of the near frame.
  Pose X_FM{};                   ///< Between the near frames.
  bool is_world = false;         ///< F is the world: a product with the identity would round.

  /// Of a scene's pair. F is the world where all fixed meshes stand where their vertices are.
  static PlacedPair of(const Scene& scene, const ObjectPair& pair, const Pose& X_WM);

  /// @param number `ObjectPair::number`
  void to_world(Lmd& lmd, std::int32_t number) const;
  void to_mesh(Lmd& lmd) const;
};

/// Two meshes as methods see them, the second fixed in its own frame, for all pairs of objects that
/// have them; with idle methods of such pairs.
class MeshPair {
 public:
  using Make = std::function<std::unique_ptr<Method>(const Scene& of_pair)>;

  /// Makes a first method: now, not in the frame in which the first two objects come near.
  /// @param of_pair one fixed mesh, which is not placed
  /// @param make must outlive this
  MeshPair(const Scene& of_pair, const Make& make);

  /// Makes all anew where a mesh deformed and methods do not follow it (MethodDescription) or see
  /// copies of it. The cost falls when the pair is next near. FCL's models are built again: FCL
  /// 0.7.0's refit from the leaves up returns wrong distances for RSS and OBBRSS.
  /// @return whether it did: methods that were taken are then of no use
  bool follow_deformation();

  const NearFrame& frame() const { return frame_; }
  /// @param pair in the frames of the meshes
  PlacedPair in_near_frame(PlacedPair pair) const;

  /// Whether methods keep results between frames: then each pair takes one, else one serves all.
  bool keeps_frames() const { return keeps_frames_; }
  /// @pre none was taken
  Method& shared() { return *idle_.front(); }
  std::unique_ptr<Method> take();
  void give_back(std::unique_ptr<Method> method) { idle_.push_back(std::move(method)); }
  /// Methods that were made.
  std::size_t made() const { return made_; }

 private:
  std::uint64_t deformations() const;

  Scene of_pair_;
  const Make& make_;
  NearFrame frame_;
  bool keeps_frames_ = false, sees_deformation_ = false;
  std::uint64_t deformations_ = 0;  ///< Of both meshes, that methods know.
  std::size_t made_ = 0;
  std::vector<std::unique_ptr<Method>> idle_;
};

}  // namespace lmdbench
