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

/// A moving object, or an instance of one.
struct Mover {
  std::shared_ptr<const Body> body;
  std::string name;        ///< Identifies its mesh.
  std::size_t object = 0;  ///< Index in the experiment.
  std::size_t which = 0;   ///< Instance of the object.
  Pose place;              ///< Frame of its path.
};

/// All movers with all their poses.
///
/// Their order depends on their meshes and paths alone, so that another order in the file gives the
/// same bits: of a pair the earlier one is the moving mesh, and forces are summed in this order.
/// `number` is that of the file: 0 the held object, then those that move, instance by instance.
struct MoverPlay {
  std::vector<std::shared_ptr<const Body>> bodies;
  std::vector<std::size_t> number;
  std::vector<Vec3> references_M;        ///< Centres about which torque is taken.
  std::vector<std::vector<Pose>> poses;  ///< X_WM, [mover][frame].

  std::size_t count() const { return bodies.size(); }
  /// Index of the moving mesh.
  std::size_t moving() const;
  /// The scene with these movers; SceneFrames sets their poses.
  Scene with_movers(Scene scene) const;
};

/// @param movers in file order
/// @param poses [mover][frame]
MoverPlay make_play(const std::vector<Mover>& movers, const std::vector<std::vector<Pose>>& poses);

/// An LMD as in files: of its two objects the one with the lower number in the file moves.
struct FiledLmd {
  Lmd lmd;                       ///< `fixed_body`: standing ones, then movers.
  std::int64_t moving_body = 0;  ///< Number of the mover.
};
/// @param play of the scene; null where one mesh moves
FiledLmd as_filed(const Lmd& lmd, const Scene& scene, const MoverPlay* play);

}  // namespace lmdbench
