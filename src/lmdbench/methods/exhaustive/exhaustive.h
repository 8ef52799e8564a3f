// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/flat_pieces.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/methods/exhaustive/triangle_grid.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

const MethodDescription& exhaustive_method();

/// Ground truth (lmd/DEFINITION.md): every triangle pair within the cutoff, exact triangle distance, the
/// first-order test, one entry per feature pair and per plateau. Slow and simple on purpose; it shares no
/// search code with what it judges: no hierarchy and no cone, only a uniform grid that lists the fixed
/// triangles near a box.
class Exhaustive : public Method {
 public:
  /// What it counts.
  enum class Counter : std::uint8_t { LEAF_PAIRS, REJECTED_CUTOFF, TRIANGLE_DISTANCES, FIRST_ORDER_TESTS };

  explicit Exhaustive(Scene scene);

  const MethodDescription& description() const override { return exhaustive_method(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }

 private:
  Scene scene_;
  std::vector<TriangleGrid> grids_;  ///< One a fixed body.
  std::vector<LocalMinimum> minima_;
  std::vector<Intersection> intersections_;
  FlatPieces flat_pieces_;
};

}  // namespace lmdbench
