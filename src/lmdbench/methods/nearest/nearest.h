// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>

namespace lmdbench {

/// Free choices of `nearest`. Members are called as in experiment files.
struct NearestOptions {
  /// Begins a search with the last pair's bound. FCL has no such mode, but its result may be
  /// seeded: half the time along a path, and what a user who cares for time does.
  bool warm_start = true;
};

const MethodDescription& nearest_method();

/// What most programs do: one contact a frame, the nearest pair as FCL finds it (OBBRSS, triangle
/// by triangle), with a force within the cutoff. Where that pair changes its place the whole force
/// does: multi-contact methods are compared with this.
///
/// 1. FCL sees the meshes at a unit mean edge length: its kernel skips faces under an absolute size
///    (fcl_crosscheck.h). The search begins with the bound of the last frame's pair.
/// 2. While the meshes are apart, distance and points are FCL's own, with its known errors on
///    nearly parallel edges. In contact they mean nothing; the triangles it names are measured.
/// 3. FCL names triangles, an LMD features: those of the exact distance of the two triangles.
class Nearest : public Method {
 public:
  /// What it counts.
  enum class Counter : std::uint8_t { FCL_QUERIES, TRIANGLE_DISTANCES };

  /// @param of_pair `Scene::is_pair`
  /// @throws InputError for a mesh without triangles
  explicit Nearest(Scene of_pair, const NearestOptions& options = {});

  const MethodDescription& description() const override { return nearest_method(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }

 private:
  Scene scene_;
  bool warm_start_;
  FclCrosscheck fcl_;
};

}  // namespace lmdbench
