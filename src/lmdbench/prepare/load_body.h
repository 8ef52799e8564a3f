// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/prepare/prepare.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// A mesh of the scene.
/// @param role "moving", "mover_0", "fixed_0", ...
/// @param X_WF takes its vertices into the world; without it they stay in the mesh's own frame
/// @param notes receives what is worth knowing of it
/// @throws InputError for a mesh that cannot be used
std::shared_ptr<const Body> load_body(const MeshChoice& choice, const std::string& role,
                                      const Experiment& experiment, const std::optional<Pose>& X_WF,
                                      std::vector<MeshNote>& notes);

/// A fixed mesh with its vertices in the world frame.
TriangleMesh placed_mesh(const FixedBody& fixed);

}  // namespace lmdbench
