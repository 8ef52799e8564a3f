// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/prepare/scene_deformation.h>

#include <string>
#include <vector>

/// What was done to the meshes of a scene, and flaws that methods can live with.
namespace lmdbench {

/// What deforming does to triangles.
/// @param deformation of the scene; may be null
/// @param path_is_made for the meshes at rest
std::vector<std::string> deformation_warnings(const std::vector<MeshNote>& notes,
                                              const SceneDeformation* deformation, bool path_is_made);

/// What reading the meshes did to them, and what they are.
std::vector<std::string> mesh_warnings(const Experiment& experiment, const std::vector<MeshNote>& notes);

/// What an aggregation other than the sum cannot keep to.
std::vector<std::string> aggregation_warnings(const Experiment& experiment,
                                              const std::vector<MeshNote>& notes);

}  // namespace lmdbench
