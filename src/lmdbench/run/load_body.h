// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/run/prepare.h>

#include <memory>
#include <string>
#include <vector>

namespace lmdbench {

/// A mesh at its place in the scene. What moves, and what has instances, stays in its own frame.
/// @param role "moving", "mover_0", "fixed_0", ...
/// @param notes receives what is worth knowing of it
/// @throws InputError for a mesh that cannot be used
std::shared_ptr<const Body> load_body(const MeshChoice& choice, const std::string& role,
                                      const Experiment& experiment, std::vector<MeshNote>& notes);

}  // namespace lmdbench
