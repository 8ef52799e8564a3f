// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/prepare/scene_deformation.h>

#include <string>
#include <vector>

/// Changes made to the meshes of a scene, and flaws that methods can live with.
namespace lmdbench {

/// Triangles that deforming turns over or flattens.
/// @param deformation of the scene; may be null
/// @param path_is_made a made path is for the meshes at rest
std::vector<std::string> deformation_warnings(const std::vector<MeshNote>& notes,
                                              const SceneDeformation* deformation, bool path_is_made);

/// Changes made by reading the meshes, and their flaws.
std::vector<std::string> mesh_warnings(const Experiment& experiment, const std::vector<MeshNote>& notes);

/// Limits of aggregations other than the sum.
std::vector<std::string> aggregation_warnings(const Experiment& experiment,
                                              const std::vector<MeshNote>& notes);

}  // namespace lmdbench
