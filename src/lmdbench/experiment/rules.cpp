// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>

#include <algorithm>

namespace lmdbench {
namespace {

constexpr const char* DEFORMS = "a mesh deforms: the same pose is not the same scene";
constexpr const char* SEVERAL_MOVE = "several meshes move: the same pose of one is not the same scene";

RuleVerdict shared_mesh(const RuleFacts& facts) {
  const std::vector<ObjectChoice>& objects = facts.experiment.objects;
  for (std::size_t i = 1; i < objects.size(); ++i)
    if (const auto earlier = earlier_body(facts.experiment, i))
      return {true,
              fmt::format("{} and {} are {}", objects[*earlier].role, objects[i].role, objects[i].mesh)};
  for (const bool stands : {true, false})
    for (std::size_t i = 1; i < objects.size(); ++i)
      if (objects[i].stands() == stands && shared_body(facts.experiment, i) == std::size_t{0})
        return {true, stands ? fmt::format("the moving mesh and {} are {}, placed alike", objects[i].role,
                                           objects[i].mesh)
                             : fmt::format("the moving mesh and that of {} are {}", objects[i].place,
                                           objects[i].mesh)};
  return {false, "no fixed mesh is the moving one, placed alike and unmoved"};
}

RuleVerdict contact_forecast(const RuleFacts& facts) {
  if (facts.experiment.several_move()) return {false, SEVERAL_MOVE};
  if (facts.poses.size() < 2) return {false, "the path has one frame"};
  return {true, fmt::format("{} frames follow one another", facts.poses.size())};
}

RuleVerdict truth_in_contact(const RuleFacts& facts) {
  const auto truth_frames = probed_frames(facts.experiment, "truth", facts.poses.size());
  if (truth_frames.empty()) return {false, "no frame is compared with truth"};
  if (facts.experiment.loop.closed)
    return {true, "as many exhaustive searches as the devices' frames are out of contact"};
  std::int64_t searches = 0, empty = 0;
  for (const std::int64_t frame : truth_frames) {
    for (const std::int64_t at : {frame, frame + 1}) {
      ++searches;
      if (!facts.in_contact[static_cast<std::size_t>(at)]) ++empty;
    }
  }
  return {empty > 0,
          fmt::format("{} of {} exhaustive searches would be of frames out of contact", empty, searches)};
}

/// How many of the frames, in their order, have the pose of the previous one.
std::int64_t repeats_among(const std::vector<std::int64_t>& frames, std::span<const Pose> poses) {
  std::int64_t repeats = 0;
  for (std::size_t k = 1; k < frames.size(); ++k)
    repeats +=
        same_pose(poses[static_cast<std::size_t>(frames[k - 1])], poses[static_cast<std::size_t>(frames[k])])
            ? 1
            : 0;
  return repeats;
}

RuleVerdict repeated_pose(const RuleFacts& facts) {
  const auto fcl_frames = probed_frames(facts.experiment, "fcl", facts.poses.size());
  const auto probed = probed_frames(facts.experiment, "truth", facts.poses.size());
  if (probed.empty() && fcl_frames.empty()) return {false, "no frame is probed"};
  if (facts.experiment.deforms()) return {false, DEFORMS};
  if (facts.experiment.several_move()) return {false, SEVERAL_MOVE};
  // A closed loop's encoder readings are unknown here, but they count in steps.
  if (facts.experiment.loop.closed) {
    const bool steps = facts.experiment.loop.resolution_m > 0.0;
    return {steps, steps ? fmt::format("the device's encoders count in steps of {:g} m",
                                       facts.experiment.loop.resolution_m)
                         : "the simulated device's encoders are exact"};
  }
  std::vector<std::int64_t> truth_frames;  // each is searched with its next one
  for (const std::int64_t frame : probed) truth_frames.insert(truth_frames.end(), {frame, frame + 1});
  const std::int64_t truth = repeats_among(truth_frames, facts.poses);
  const std::int64_t fcl = repeats_among(fcl_frames, facts.poses);
  return {truth + fcl > 0,
          fmt::format(
              "{} of {} exhaustive searches and {} of {} cross-checks would be at the pose of the one before",
              truth, truth_frames.size(), fcl, fcl_frames.size())};
}

RuleVerdict warm_crosscheck(const RuleFacts& facts) {
  const std::int64_t stride = facts.experiment.probe_stride("fcl");
  if (stride == 0) return {false, "nothing is compared with FCL"};
  if (facts.experiment.deforms()) return {false, DEFORMS};
  if (facts.experiment.several_move()) return {false, SEVERAL_MOVE};
  return {true, fmt::format("minimum distances every {} frames of one path", stride)};
}

constexpr std::array<RuleDescription, RULE_COUNT> RULES{{
    {Rule::SHARED_MESH, "shared_mesh", "a mesh that appears twice is read and prepared once",
     "time and memory of its reading, flattening, hierarchies and models", &shared_mesh},
    {Rule::CONTACT_FORECAST, "contact_forecast",
     "frames whose contact follows from an earlier frame and the motion since are not searched for it",
     "time of the scan for frames in contact", &contact_forecast},
    {Rule::TRUTH_IN_CONTACT, "truth_in_contact",
     "frames out of contact have an empty true set without a search", "exhaustive searches",
     &truth_in_contact},
    {Rule::REPEATED_POSE, "repeated_pose",
     "a probed frame at the pose of the one probed before has its true set and its distances",
     "exhaustive searches and cross-checks of a mesh at rest", &repeated_pose},
    {Rule::WARM_CROSSCHECK, "warm_crosscheck",
     "the exact distance beside FCL's begins with the nearest triangles of the frame before",
     "time of the cross-check", &warm_crosscheck},
}};

}  // namespace

std::span<const RuleDescription> rule_descriptions() {
  return RULES;
}

nlohmann::json rules_schema() {
  nlohmann::json properties = nlohmann::json::object();
  for (const RuleDescription& rule : RULES)
    properties[std::string(rule.name)] = {
        {"enum", {"auto", "on", "off"}},
        {"default", "auto"},
        {"description", fmt::format("{}; saves {}", rule.effect, rule.saving)}};
  return {{"type", "object"},
          {"additionalProperties", false},
          {"default", nlohmann::json::object()},
          {"description",
           "what is left out because the scene shows that it would change nothing: auto where the scene "
           "allows it, off "
           "never, on: an error where the scene does not"},
          {"properties", std::move(properties)}};
}

RuleSwitches read_rule_switches(const nlohmann::json& entry) {
  RuleSwitches switches{};
  for (const RuleDescription& rule : RULES) {
    const nlohmann::json& value = entry[std::string(rule.name)];
    switches[static_cast<std::size_t>(rule.rule)] = value == "on"    ? RuleSwitch::ON
                                                    : value == "off" ? RuleSwitch::OFF
                                                                     : RuleSwitch::AUTO;
  }
  return switches;
}

std::vector<RuleDecision> decide_rules(const RuleFacts& facts) {
  std::vector<RuleDecision> decisions;
  for (const RuleDescription& rule : RULES) {
    const RuleVerdict verdict = rule.condition(facts);
    const RuleSwitch chosen = facts.experiment.rules[static_cast<std::size_t>(rule.rule)];
    if (chosen == RuleSwitch::ON && !verdict.holds)
      throw UsageError(facts.experiment.file.string(), fmt::format("/plan/{}", rule.name),
                       "cannot be on: " + verdict.reason, "leave it on auto");
    decisions.push_back({rule.rule, verdict.holds && chosen != RuleSwitch::OFF,
                         chosen == RuleSwitch::OFF ? "switched off" : verdict.reason});
  }
  return decisions;
}

bool is_on(const std::vector<RuleDecision>& decisions, Rule rule) {
  return std::any_of(decisions.begin(), decisions.end(),
                     [&](const RuleDecision& decision) { return decision.rule == rule && decision.on; });
}

std::string rules_text(const std::vector<RuleDecision>& decisions) {
  std::string text = "rules (--set /plan/RULE=on|off|auto):\n";
  for (const RuleDecision& decision : decisions) {
    const RuleDescription& rule = RULES[static_cast<std::size_t>(decision.rule)];
    text += fmt::format("  {:<17} {:<4} {} ({}; saves {})\n", rule.name, decision.on ? "on" : "off",
                        decision.reason, rule.effect, rule.saving);
  }
  return text;
}

nlohmann::ordered_json rules_json(const std::vector<RuleDecision>& decisions) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const RuleDecision& decision : decisions) {
    const RuleDescription& rule = RULES[static_cast<std::size_t>(decision.rule)];
    json.push_back({{"name", rule.name},
                    {"on", decision.on},
                    {"effect", rule.effect},
                    {"saving", rule.saving},
                    {"reason", decision.reason}});
  }
  return json;
}

bool same_mesh(const ObjectChoice& a, const ObjectChoice& b) {
  return a.mesh == b.mesh && a.placement == b.placement && a.planar_tolerance == b.planar_tolerance &&
         a.orientation == b.orientation && !a.deformation && !b.deformation;
}

std::optional<std::size_t> earlier_body(const Experiment& experiment, std::size_t index) {
  if (!stands_in_own_frame(experiment, index)) return std::nullopt;
  for (std::size_t i = index; i-- > 0;)
    if (same_mesh(experiment.objects[i], experiment.objects[index]) && stands_in_own_frame(experiment, i))
      return i;
  return std::nullopt;
}

std::optional<std::size_t> shared_body(const Experiment& experiment, std::size_t index) {
  const ObjectChoice& object = experiment.objects[index];
  if (object.stands()) {
    if (const auto earlier = earlier_body(experiment, index)) return earlier;
    const bool in_own_frame = stands_in_own_frame(experiment, index) || same_pose(object.pose, Pose{});
    return in_own_frame && same_mesh(experiment.held(), object) ? std::optional(std::size_t{0})
                                                                : std::nullopt;
  }
  for (std::size_t i = 0; i < index; ++i)
    if (!experiment.objects[i].stands() && same_mesh(experiment.objects[i], object)) return i;
  return std::nullopt;
}

bool stands_in_own_frame(const Experiment& experiment, std::size_t index) {
  const ObjectChoice& object = experiment.objects[index];
  if (!object.stands()) return false;
  if (object.instances) return true;
  if (experiment.deforms() || experiment.realtime || experiment.probe_stride("polylines") > 0) return false;
  for (const ForceChoice& force : experiment.profiles)
    if (force.aggregation->needs > AggregationNeeds::CRITICAL_PAIRS) return false;
  return std::ranges::any_of(experiment.objects, [&](const ObjectChoice& other) {
    return &other != &object && other.stands() && same_mesh(other, object);
  });
}

bool has_placed_meshes(const Experiment& experiment) {
  for (std::size_t i = 1; i < experiment.objects.size(); ++i)
    if (stands_in_own_frame(experiment, i) &&
        (experiment.objects[i].instances || !same_pose(experiment.objects[i].pose, Pose{})))
      return true;
  return false;
}

}  // namespace lmdbench
