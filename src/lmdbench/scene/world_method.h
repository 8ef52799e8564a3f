// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/scene.h>

#include <functional>
#include <memory>
#include <vector>

namespace lmdbench {

/// What `make` makes of the scene; where several meshes move a method among them (mover_method.h), of a world (`Scene::is_world`) one that
/// makes its set of pairs of meshes:
///
/// 1. a broad phase says which instances may be within reach (broad_phase.h);
/// 2. each of them is asked in the frame of its mesh: the method that `make` made of the moving mesh and that one sees the relative pose
///    (mesh_bounds.h), and nothing of the mesh is copied or placed for an instance;
/// 3. the sets are brought to the world, called after the instance, and sorted by `lmd_less`.
///
/// A set is a union over instances, because contacts of different fixed meshes are never one LMD (decision/DEFINITION.md). Where the method keeps
/// something from frame to frame (`MethodDescription::frame_coherent`) an instance that comes near is given a method for itself, out of a
/// pool, and gives it back when the broad phase drops it; an idle instance is a pose, an index and a box. Methods that look at all pairs
/// (`brute_force`) are truth: they look at the sphere of every instance in every frame, and share nothing of the broad phase.
///
/// Every method goes through this, after it through near frames (near_frame.h), which are made once a mesh.
/// @param description of the method that `make` makes
std::unique_ptr<Method> make_in_world(const Scene& scene, const MethodDescription& description,
                                      const std::function<std::unique_ptr<Method>(const Scene&)>& make);

/// The method with what a world counts beside it: queries of the tree; instances whose bounds were placed or whose room was used up;
/// instances whose meshes were searched.
MethodDescription in_world(MethodDescription description);

}  // namespace lmdbench
