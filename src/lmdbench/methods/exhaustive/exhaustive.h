// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/methods/exhaustive/feature_grid.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

const MethodDescription& exhaustive_method();

/// Ground truth (decision/DEFINITION.md): decides every pair of features of the shapes whose boxes
/// come within reach; tests every pair of triangles whose boxes overlap for a shared point. Slow
/// and simple on purpose: no hierarchy, cone or filter, only a uniform grid for what is near a box.
class Exhaustive : public Method {
 public:
  /// What it counts.
  enum class Counter : std::uint8_t { FEATURE_PAIRS, CONTACTS, TRIANGLE_DISTANCES };

  /// @param of_pair `Scene::is_pair`
  explicit Exhaustive(Scene of_pair);

  const MethodDescription& description() const override { return exhaustive_method(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }
  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override;

 private:
  /// Calls ask(lead of the moving mesh, lead of the fixed one) for every pair near enough.
  template <class Ask>
  void for_each_feature_pair(const ShapePair& pair, WorkCounters& counters, Ask&& ask);
  /// Finds what intersects and calls with(the two at the pose).
  template <class With>
  void at_pose(const Pose& X_WM, WorkCounters& counters, With&& with);
  void find_intersections(const ShapePair& pair, WorkCounters& counters);

  Scene scene_;
  FeatureGrid grid_;  ///< Of the fixed body.
  std::vector<std::uint64_t> asked_vertex_, asked_edge_,
      asked_face_;  ///< Last feature that was asked with each.
  std::uint64_t asking_ = 0;
  ContactSet contacts_;
  std::vector<Intersection> intersections_;
};

}  // namespace lmdbench
