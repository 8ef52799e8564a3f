// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

/// Promises for any two small meshes at any pose, for the fuzzer and the test of its corpus.
namespace lmdbench::testing {

struct FuzzScene {
  Scene scene;
  Pose X_WM;
};

/// Bytes: kind and size of two meshes, a cutoff, a translation, a rotation. Meshes are closed
/// shapes with vertices on a coarse lattice, or triangle soups on it: flat, parallel, duplicate and
/// touching triangles are common. Nothing for too few bytes or meshes without triangles.
std::optional<FuzzScene> scene_from_bytes(std::span<const std::uint8_t> bytes);

/// Empty, or what is broken. `certified` is `exhaustive`, sets are sorted, numbers are finite, and
/// distances are those of the points. For closed manifold meshes that are apart, the candidates of
/// `improved` without visibility test include a pair as near as the nearest LMD.
std::string broken_promise(const FuzzScene& fuzz);

}  // namespace lmdbench::testing
