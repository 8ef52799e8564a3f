// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

/// What any two small meshes at any pose must keep to, for the fuzzer and the test that replays its corpus.
namespace lmdbench::testing {

struct FuzzScene {
  Scene scene;
  Pose X_WM;
};

/// Bytes: a kind and a size for each of two meshes, a cutoff, a translation and a rotation. Meshes are closed
/// shapes whose vertices are moved on a coarse lattice, or soups of triangles on it, so that flat, parallel,
/// duplicate and touching triangles are common. Nothing for too few bytes or meshes without triangles.
std::optional<FuzzScene> scene_from_bytes(std::span<const std::uint8_t> bytes);

/// Empty, or what is broken: `certified` is `exhaustive`, both sets are in their order, every number is finite that
/// must be, each LMD's distance is that of its points, and for closed manifold meshes that are apart the candidates of the
/// improved algorithm without its visibility test hold a pair as near as the nearest LMD.
std::string broken_promise(const FuzzScene& fuzz);

}  // namespace lmdbench::testing
