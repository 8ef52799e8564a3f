// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace lmdbench {

/// Makes a generated shape (shapes.h) from {"kind": "torus", "ring_radius": 0.4, ...}; keys are the
/// parameters' names there, lengths in metres. Every key is required, no other is allowed.
/// @param file, pointer  of the recipe, for messages
/// @throws InputError naming the key
TriangleMesh make_shape(const nlohmann::json& recipe, const std::string& file, const std::string& pointer);

}  // namespace lmdbench
