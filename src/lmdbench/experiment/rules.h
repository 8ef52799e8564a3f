// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What a run leaves out because the scene shows that it would change nothing. Each rule is data: a condition on the
/// scene, what is left out, a switch of the experiment (`/plan/NAME`). None touches what a method does in a timed
/// frame: a benchmark must not improve the algorithms that it compares.
/// Results are the same bits with a rule and without it (`lmdbench-study leave-out`).
namespace lmdbench {

struct Experiment;
struct ObjectChoice;

/// The same bits.
inline bool same_pose(const Pose& a, const Pose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

enum class Rule : std::uint8_t {
  SHARED_MESH,
  CONTACT_FORECAST,
  TRUTH_IN_CONTACT,
  REPEATED_POSE,
  WARM_CROSSCHECK
};
inline constexpr std::size_t RULE_COUNT = 5;

/// "auto": where its condition holds. "on": its condition must hold. "off": never.
enum class RuleSwitch : std::uint8_t { AUTO, ON, OFF };
using RuleSwitches = std::array<RuleSwitch, RULE_COUNT>;

/// All that conditions look at.
struct RuleFacts {
  const Experiment& experiment;
  std::span<const Pose> poses;          ///< Of the path's frames.
  const std::vector<bool>& in_contact;  ///< One a frame.
};

struct RuleVerdict {
  bool holds = false;
  std::string reason;  ///< With its figure.
};

struct RuleDescription {
  Rule rule;
  std::string_view name;    ///< Key under /plan.
  std::string_view effect;  ///< What is left out.
  std::string_view saving;  ///< What that saves.
  RuleVerdict (*condition)(const RuleFacts& facts);
};

/// In the order of `Rule`.
std::span<const RuleDescription> rule_descriptions();

/// "plan" of the experiment schema: a switch a rule.
nlohmann::json rules_schema();

/// @param entry  "plan" of an experiment with its defaults
RuleSwitches read_rule_switches(const nlohmann::json& entry);

/// Whether a rule may be used at all: its switch is not "off".
inline bool allowed(const RuleSwitches& switches, Rule rule) {
  return switches[static_cast<std::size_t>(rule)] != RuleSwitch::OFF;
}

struct RuleDecision {
  Rule rule;
  bool on = false;
  std::string reason;
};

/// @throws UsageError for a switch that is "on" where the condition does not hold
std::vector<RuleDecision> decide_rules(const RuleFacts& facts);

bool is_on(const std::vector<RuleDecision>& decisions, Rule rule);

/// For people: a line a rule.
std::string rules_text(const std::vector<RuleDecision>& decisions);
/// [{"name", "on", "effect", "saving", "reason"}]
nlohmann::ordered_json rules_json(const std::vector<RuleDecision>& decisions);

/// Whether two choices make one rigid mesh of the same file in the same way; poses and motions aside.
bool same_mesh(const ObjectChoice& a, const ObjectChoice& b);

/// Whether object `index` stands at its pose in its own frame: it has "instances", or another one that stands has the same mesh. Not
/// where somebody reads the vertices in the world frame (deformation, polylines, aggregations of surfaces and merges) or the first
/// frame in which a mesh is near must not prepare anything (the driver realtime).
bool stands_in_own_frame(const Experiment& experiment, std::size_t index);

/// The last object before `index` that stands in its own frame, as this one does, with the same mesh.
std::optional<std::size_t> earlier_body(const Experiment& experiment, std::size_t index);

/// The earlier object whose mesh, read and prepared, serves this one.
std::optional<std::size_t> shared_body(const Experiment& experiment, std::size_t index);

/// Whether some mesh stands so: its scene is a world (`Scene::is_world`).
bool has_placed_meshes(const Experiment& experiment);

}  // namespace lmdbench
