// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/scene_look.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// A part of the program that a scene may need.
enum class Part {
  FLATTENING,        ///< Moves vertices of rounded planes back into them.
  DEFORMATION,       ///< Vertices that move from frame to frame.
  MOVERS,            ///< Meshes that move beside the moving one.
  LOCAL_TRACKING,    ///< Global searches at their own rate, with local tracking between.
  SEARCH_PER_FRAME,  ///< Methods that find their set from scratch in every frame.
  CRITICAL_PAIRS,    ///< Saddles beside LMDs, for an aggregation that needs them.
  DEVICE,            ///< The virtual device.
  SIMULATED_DEVICE,  ///< Its motion, in a closed loop.
  PROBE,             ///< A probe (experiment/probe.h); the item has its title.
  LMD_LISTS,         ///< Every frame's LMD list in the result.
  TORQUE_RENDERING,  ///< Torque on the device.
  THREADS            ///< Real threads for the global and local parts.
};

struct PlanItem {
  Part part;
  bool needed = false;
  std::string name;
  std::string why;
};

/// What a scene needs, what is left out and why. A run makes only the needed parts.
struct Plan {
  std::vector<PlanItem> items;
  std::vector<RuleDecision> rules;
  std::optional<SceneLook> scene;  ///< A look at the inputs, if one was made.

  bool needs(Part part) const;
  /// Of the item with this name.
  bool needs(std::string_view name) const;
};

Plan make_plan(const Experiment& experiment);

/// For people: one line for a part, one for an option of a method.
std::string plan_text(const Plan& plan, const Experiment& experiment);

/// JSON text: {"experiment": resolved experiment, "methods": [{"label", "name", "summary",
/// "promise", "tracks_locally", "options": [{"key", "value", "default", "description"}],
/// "counters": [{"name", "description"}]}], "needed": [{"part", "why"}], "left_out": [...]},
/// "rules" (see `rules_json`) and, where the plan has one, "scene" (see `to_json` of a SceneLook).
std::string plan_json(const Plan& plan, const Experiment& experiment);

}  // namespace lmdbench
