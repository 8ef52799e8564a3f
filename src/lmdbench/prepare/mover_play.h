// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// Several objects that move in one run, each on its own path: the held one and the others.
namespace lmdbench {

/// One of them, or an instance of one.
struct Mover {
  std::shared_ptr<const Body> body;
  std::string name;        ///< Tells meshes apart.
  std::size_t object = 0;  ///< Of the experiment.
  std::size_t which = 0;   ///< Instance of the object.
  Pose place;              ///< Frame of its path.
};

/// All movers with all their poses.
///
/// They stand here in an order that their meshes and paths decide, so that who lists them otherwise in the file gets the same bits: of a
/// pair the earlier one takes the part of the moving mesh, and forces are summed in this order. `number` says which one of the file each
/// is: 0 the held object, then those that move one after the other, instance by instance.
struct MoverPlay {
  std::vector<std::shared_ptr<const Body>> bodies;
  std::vector<std::size_t> number;
  std::vector<Vec3> references_M;        ///< Centres about which torque is taken.
  std::vector<std::vector<Pose>> poses;  ///< X_WM, of a frame of a mover.

  std::size_t count() const { return bodies.size(); }
  /// Where the moving mesh is.
  std::size_t moving() const;
  /// The scene with these movers in it; where they are is SceneFrames' to say.
  Scene with_movers(Scene scene) const;
};

/// @param movers in the order of the file, to be put into their own
/// @param poses of a mover of a frame
MoverPlay make_play(const std::vector<Mover>& movers, const std::vector<std::vector<Pose>>& poses);

/// An LMD as files have it: of its two objects the one with the lower number of the file moves.
struct FiledLmd {
  Lmd lmd;                       ///< `fixed_body` counts what stands, then the movers by their number.
  std::int64_t moving_body = 0;  ///< Number of the mover.
};
/// @param play of the scene; null where one mesh moves
FiledLmd as_filed(const Lmd& lmd, const Scene& scene, const MoverPlay* play);

}  // namespace lmdbench
