// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body.h>

#include <support/random.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

/// Poses and places of generated meshes and scenes.
namespace lmdbench::parts {

/// Any rotation, and up to `reach` from the origin along each axis.
Pose random_placement(double reach, experiments::Random& random);

/// A mesh as stored in a file: moved by a pose from its design frame; with `in_floats` then rounded
/// to single precision and flattened like an import.
std::shared_ptr<const Body> placed_body(const char* name, TriangleMesh mesh, const Pose& X_FD,
                                        bool in_floats);
/// Scaled, then moved by an offset.
std::shared_ptr<const Body> scaled_body(const char* name, TriangleMesh mesh, double size, const Vec3& offset);

/// Unrelated poses; or one, and from there equal steps and turns.
std::vector<Pose> poses_of(std::size_t count, bool slides, const Vec3& step, const Eigen::Quaterniond& turn,
                           const std::function<Pose()>& unrelated);

}  // namespace lmdbench::parts
