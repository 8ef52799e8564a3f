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

/// Work that a run leaves out because the scene shows that it changes nothing. Each rule is data: a
/// condition on the scene, the work left out, a switch of the experiment (`/plan/NAME`). None
/// touches a method's work in a timed frame: a benchmark must not improve what it compares.
/// Results are the same bits with a rule and without it (`lmdbench-study leave-out`).
namespace lmdbench {

struct Experiment;
struct ObjectChoice;

/// Equality of all bits.
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

/// "auto": on if its condition holds. "on": its condition must hold. "off": never.
enum class RuleSwitch : std::uint8_t { AUTO, ON, OFF };
using RuleSwitches = std::array<RuleSwitch, RULE_COUNT>;

/// Inputs of the conditions.
struct RuleFacts {
  const Experiment& experiment;
  std::span<const Pose> poses;          ///< Of the path's frames.
  const std::vector<bool>& in_contact;  ///< One a frame.
};

struct RuleVerdict {
  bool holds = false;
  std::string reason;  ///< With its number.
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

/// "plan" of the experiment schema: one switch for each rule.
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

/// Whether two choices make the same rigid mesh of one file, apart from pose and motion.
bool same_mesh(const ObjectChoice& a, const ObjectChoice& b);

/// Whether object `index` stands at its pose in its own frame: it has "instances", or shares its
/// mesh with another standing one. Not where vertices are read in the world frame (deformation,
/// polylines, aggregations of surfaces and merges) or frames may prepare nothing (realtime driver).
bool stands_in_own_frame(const Experiment& experiment, std::size_t index);

/// The last object before `index` with the same mesh that also stands in its own frame.
std::optional<std::size_t> earlier_body(const Experiment& experiment, std::size_t index);

/// The earlier object whose read and prepared mesh serves this one.
std::optional<std::size_t> shared_body(const Experiment& experiment, std::size_t index);

/// Whether some mesh stands in its own frame: then the scene is a world (`Scene::is_world`).
bool has_placed_meshes(const Experiment& experiment);

}  // namespace lmdbench
