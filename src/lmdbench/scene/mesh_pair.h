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
#include <utility>
#include <vector>

namespace lmdbench {

/// Where two placed meshes are in a frame: what brings LMDs from the frame that their method works in to the world and back.
struct PlacedPair {
  RigidTransform X_WF;
  Vec3 origin_F;  ///< Of the near frame.
  Pose X_FM;      ///< Between the near frames.

  void to_world(Lmd& lmd, std::uint32_t fixed_body) const;
  void to_mesh(Lmd& lmd) const;
};

/// Two meshes as methods see them, the second one fixed and in its own frame, however many pairs of objects have them; with the methods
/// of such pairs that nobody has just now.
class MeshPair {
 public:
  using Make = std::function<std::unique_ptr<Method>(const Scene&)>;

  /// Makes a first method: now, not in the frame in which the first two objects come near.
  /// @param of_pair one fixed mesh, which is not placed
  MeshPair(const Scene& of_pair, const Make& make);

  PlacedPair placed(const Pose& X_WF, const Pose& X_WM) const;

  /// Whether methods keep something from frame to frame: then each pair of objects takes one, else one serves all.
  bool keeps_frames() const { return keeps_frames_; }
  /// @pre none was taken
  Method& shared() { return *idle_.front(); }
  std::unique_ptr<Method> take(const Make& make);
  void give_back(std::unique_ptr<Method> method) { idle_.push_back(std::move(method)); }
  /// Methods that were made.
  std::size_t made() const { return made_; }

 private:
  NearFrame frame_;
  bool keeps_frames_ = false;
  std::size_t made_ = 1;
  std::vector<std::unique_ptr<Method>> idle_;
};

}  // namespace lmdbench
