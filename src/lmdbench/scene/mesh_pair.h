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

/// Where two placed meshes are in a frame: what brings LMDs from the frame that their method works in to the world and back.
struct PlacedPair {
  RigidTransform X_WF{};
  Vec3 origin_F = Vec3::Zero();  ///< Of the near frame.
  Pose X_FM{};                   ///< Between the near frames.
  bool is_world = false;         ///< F is the world: a product with the identity would round.

  /// Of a scene's pair. In a scene whose fixed meshes all stand where their vertices are, F is the world.
  static PlacedPair of(const Scene& scene, const ObjectPair& pair, const Pose& X_WM);

  /// @param number `ObjectPair::number`
  void to_world(Lmd& lmd, std::int32_t number) const;
  void to_mesh(Lmd& lmd) const;
};

/// Two meshes as methods see them, the second one fixed and in its own frame, however many pairs of objects have them; with the methods
/// of such pairs that nobody has just now.
class MeshPair {
 public:
  using Make = std::function<std::unique_ptr<Method>(const Scene& of_pair)>;

  /// Makes a first method: now, not in the frame in which the first two objects come near.
  /// @param of_pair one fixed mesh, which is not placed
  /// @param make must outlive this
  MeshPair(const Scene& of_pair, const Make& make);

  /// Makes everything anew where a mesh has deformed and methods do not follow (`MethodDescription::follows_deformation`) or do not see the
  /// meshes themselves. So a method is right, and its preparation is paid when the pair is next near. What FCL holds of a mesh is built again
  /// with it: FCL 0.7.0's refit from the leaves up returns wrong distances for RSS and OBBRSS.
  /// @return whether it did: then methods that were taken are of no use any more
  bool follow_deformation();

  const NearFrame& frame() const { return frame_; }
  /// @param pair in the frames of the meshes
  PlacedPair in_near_frame(PlacedPair pair) const;

  /// Whether methods keep something from frame to frame: then each pair of objects takes one, else one serves all.
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
