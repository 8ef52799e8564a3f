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

/// Where generated meshes and scenes come to be.
namespace lmdbench::parts {

/// Any turn, and up to `reach` from the origin along each axis.
Pose random_placement(double reach, experiments::Random& random);

/// A mesh as its file holds it: moved by a pose from the frame of its design, and where `in_floats`
/// rounded to single precision and flattened as an import does it.
std::shared_ptr<const Body> placed_body(const char* name, TriangleMesh mesh, const Pose& X_FD,
                                        bool in_floats);
/// Scaled, then moved by an offset.
std::shared_ptr<const Body> scaled_body(const char* name, TriangleMesh mesh, double size, const Vec3& offset);

/// Poses that have nothing to do with each other; or one, and from there equal steps and turns.
std::vector<Pose> poses_of(std::size_t count, bool slides, const Vec3& step, const Eigen::Quaterniond& turn,
                           const std::function<Pose()>& unrelated);

}  // namespace lmdbench::parts
