// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregation.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/plan.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

/// Vertices as in the file.
const PlanarTolerance TAKEN_AS_THEY_ARE{PlanarTolerance::Kind::LENGTH, 0.0};

std::string join_labels(const std::vector<std::string>& labels) {
  return fmt::format("{}", fmt::join(labels, ", "));
}

/// A method of the experiment with its options; a changed value has its default beside it.
std::string choice_text(const MethodChoice& choice) {
  const MethodDescription& method = method_description(choice.name);
  std::string text =
      fmt::format("  {}: {} ({}, force law {}, aggregation {})\n", choice.label, method.summary,
                  to_string(method.promise), to_string(choice.force_law), choice.aggregation->name);
  for (const auto& [key, value] : choice.options.items()) {
    const Json& standard = method.options[key]["default"];
    text += fmt::format("    {:<34} {}{}\n", key, value.dump(),
                        value == standard ? "" : fmt::format(" (default {})", standard.dump()));
  }
  return text;
}

nlohmann::ordered_json choice_json(const MethodChoice& choice) {
  const MethodDescription& method = method_description(choice.name);
  nlohmann::ordered_json json{{"label", choice.label},
                              {"name", method.name},
                              {"summary", method.summary},
                              {"promise", to_string(method.promise)},
                              {"tracks_locally", method.tracks_locally},
                              {"aggregation", choice.aggregation->name},
                              {"options", nlohmann::ordered_json::array()},
                              {"counters", nlohmann::ordered_json::array()}};
  for (const auto& [key, value] : choice.options.items())
    json["options"].push_back({{"key", key},
                               {"value", value},
                               {"default", method.options[key]["default"]},
                               {"description", method.options[key]["description"]}});
  for (const CounterDescription& counter : method.counters)
    json["counters"].push_back({{"name", counter.name}, {"description", counter.summary}});
  return json;
}

/// The closed loop in words.
std::string loop_text(const LoopChoice& loop) {
  return fmt::format("{:g} kg, {:g} N s/m, friction {:g} N, resolution {:g} m, {}, force {} frames late",
                     loop.dynamics.mass_kg, loop.dynamics.damping_n_s_per_m, loop.dynamics.friction_n,
                     loop.resolution_m, loop.dynamics.hand ? "hand " + loop.dynamics.hand->name : "no hand",
                     loop.delay_frames);
}

/// Objects that move beside the held one.
std::string movers_text(const Experiment& experiment) {
  std::vector<std::string> entries;
  for (const ObjectChoice& object : experiment.objects) {
    const ObjectMotion& motion = object.motion;
    if (motion.kind == MotionKind::PATH)
      entries.push_back(fmt::format("{} {}, path {}", object.role, object.mesh, motion.path_file.string()));
    if (motion.kind == MotionKind::SWAYS)
      entries.push_back(fmt::format("{} {}, sways {:g} diagonals and {:g} rad in {:g} s", object.role,
                                    object.mesh, motion.sway.way_diagonals, motion.sway.turn_rad,
                                    motion.sway.period_s));
  }
  return fmt::format("{}; every pair is looked at, each mover has its force", fmt::join(entries, "; "));
}

/// Deforming meshes, and how each method treats them.
std::string deformation_text(const Experiment& experiment) {
  std::vector<std::string> meshes, following, remade;
  for (const ObjectChoice& object : experiment.objects)
    if (object.deformation) meshes.push_back(fmt::format("{} {}", object.role, to_text(*object.deformation)));
  for (const MethodChoice& choice : experiment.methods)
    (method_description(choice.name).follows_deformation ? following : remade).push_back(choice.label);
  std::string text = fmt::format("{}", fmt::join(meshes, "; "));
  if (!following.empty()) text += fmt::format("; {}: what is prepared follows", join_labels(following));
  if (!remade.empty())
    text +=
        fmt::format("; {}: made anew in every frame, in the time of the local update", join_labels(remade));
  return text;
}

}  // namespace

bool Plan::needs(Part part) const {
  return std::any_of(items.begin(), items.end(),
                     [&](const PlanItem& item) { return item.part == part && item.needed; });
}

bool Plan::needs(std::string_view name) const {
  return std::ranges::any_of(items, [&](const PlanItem& item) { return item.name == name && item.needed; });
}

Plan make_plan(const Experiment& experiment) {
  std::vector<std::string> tracking;
  std::vector<std::string> searching;
  for (const MethodChoice& choice : experiment.methods)
    (method_description(choice.name).tracks_locally ? tracking : searching).push_back(choice.label);

  Plan plan;
  const auto add = [&](Part part, const std::string& name, bool needed, const std::string& why_needed,
                       const std::string& why_left_out) {
    plan.items.push_back({part, needed, name, needed ? why_needed : why_left_out});
  };
  std::vector<std::string> tolerances;
  bool flattens = false;
  for (const ObjectChoice& object : experiment.objects) {
    tolerances.push_back(fmt::format("{} {}", object.role, to_string(object.planar_tolerance)));
    flattens = flattens || object.planar_tolerance != TAKEN_AS_THEY_ARE;
  }
  add(Part::FLATTENING, "rounded planes", flattens,
      fmt::format("planar tolerance: {}; `lmdbench mesh info` says what that moves", join_labels(tolerances)),
      "planar_tolerance is off for every mesh");
  add(Part::DEFORMATION, "meshes that deform", experiment.deforms(), deformation_text(experiment),
      "no mesh has a deformation: all are rigid");
  add(Part::MOVERS, "several meshes that move", experiment.several_move(), movers_text(experiment),
      "there are no movers: one mesh moves");
  add(Part::LOCAL_TRACKING, "global searches and local tracking", !tracking.empty(),
      experiment.realtime
          ? fmt::format("{}: in threads of their own", join_labels(tracking))
          : fmt::format("{}: a search every {} frames that arrives {} frames later", join_labels(tracking),
                        experiment.driver.search_every_frames, experiment.driver.search_latency_frames),
      "no method tracks locally");
  add(Part::SEARCH_PER_FRAME, "a search in every frame", !searching.empty(), join_labels(searching),
      "every method tracks locally");
  add(Part::DEVICE, "virtual device", true,
      fmt::format("{} clips the summed force; the loop is {}", experiment.device,
                  experiment.loop.closed ? "closed" : "open"),
      "");
  std::vector<std::string> summed, combined;
  for (const MethodChoice& choice : experiment.methods) {
    const std::string_view wanted = experiment.profiles[choice.profile].aggregation->name;
    if (choice.counts_indices())
      combined.push_back(fmt::format("{} {}", choice.label, wanted));
    else if (choice.aggregation->name != wanted)
      summed.push_back(choice.label);
  }
  add(Part::CRITICAL_PAIRS, "saddles beside LMDs", !combined.empty(),
      fmt::format(
          "force/aggregation: {}{}", join_labels(combined),
          summed.empty() ? "" : fmt::format("; {}: summed, no saddles are found", join_labels(summed))),
      summed.empty() ? "force/aggregation is sum: every LMD pushes"
                     : fmt::format("{}: summed, no saddles are found", join_labels(summed)));
  add(Part::SIMULATED_DEVICE, "simulated device", experiment.loop.closed, loop_text(experiment.loop),
      "loop/kind is open: poses come from the path");
  const auto add_probes = [&](std::string_view parent) {
    for (const Probe& probe : probes()) {
      if (probe.parent != parent) continue;
      const auto chosen = experiment.probes.find(probe.name);
      const bool needed = chosen != experiment.probes.end() && chosen->second.stride_frames > 0;
      add(Part::PROBE, probe.title, needed, needed ? probe.why(chosen->second) : "", probe.left_out);
    }
  };
  add_probes("/probes");
  add(Part::LMD_LISTS, "LMD lists in the result", experiment.record_lmds, "record/lmds is true",
      experiment.probe_stride("truth") > 0
          ? "record/lmds is false: lists are kept in memory for probed frames only"
          : "record/lmds is false and nothing is probed");
  add(Part::TORQUE_RENDERING, "torque on the device", experiment.loop.rotation.has_value(),
      experiment.loop.rotation ? fmt::format("six actuated degrees of freedom: {:g} kg m^2, {:g} N m s, "
                                             "friction {:g} N m, resolution {:g} rad",
                                             experiment.loop.rotation->dynamics.mass_kg,
                                             experiment.loop.rotation->dynamics.damping_n_s_per_m,
                                             experiment.loop.rotation->dynamics.friction_n,
                                             experiment.loop.rotation->resolution_rad)
                               : "",
      "the device actuates three degrees of freedom: torque is not rendered, and recorded where "
      "record/torque is true");
  add_probes("/record");
  add(Part::THREADS, "threads", experiment.realtime.has_value(),
      "the driver realtime: servo loop, recorder and, for methods that track locally, search and tracking, "
      "on the machine's "
      "clock; results differ from run to run",
      "the lockstep driver has one clock and one thread");
  return plan;
}

std::string plan_text(const Plan& plan, const Experiment& experiment) {
  std::string text = fmt::format("{}: {}\n", experiment.name, experiment.title);
  text += fmt::format("moving {}, fixed", experiment.held().mesh);
  for (const ObjectChoice& object : experiment.objects)
    if (object.stands()) text += " " + object.mesh;
  const std::filesystem::path& path = experiment.held().motion.path_file;
  text += fmt::format(", path {}, {:g} frames a second, {} repetitions\n",
                      path.empty() ? "made for the scene" : path.string(), experiment.frame_rate_hz,
                      experiment.driver.repetitions);
  for (const bool needed : {true, false}) {
    text += needed ? "needed:\n" : "left out:\n";
    for (const PlanItem& item : plan.items)
      if (item.needed == needed) text += fmt::format("  {:<36} {}\n", item.name, item.why);
  }
  if (!plan.rules.empty()) text += rules_text(plan.rules);
  if (plan.scene) text += to_text(*plan.scene);
  text += "methods:\n";
  for (const MethodChoice& choice : experiment.methods) text += choice_text(choice);
  return text;
}

std::string plan_json(const Plan& plan, const Experiment& experiment) {
  nlohmann::ordered_json json;
  json["experiment"] = nlohmann::ordered_json::parse(experiment.resolved_json);
  json["methods"] = nlohmann::ordered_json::array();
  for (const MethodChoice& choice : experiment.methods) json["methods"].push_back(choice_json(choice));
  json["needed"] = nlohmann::ordered_json::array();
  json["left_out"] = nlohmann::ordered_json::array();
  for (const PlanItem& item : plan.items)
    json[item.needed ? "needed" : "left_out"].push_back({{"part", item.name}, {"why", item.why}});
  if (!plan.rules.empty()) json["rules"] = rules_json(plan.rules);
  if (plan.scene) json["scene"] = to_json(*plan.scene);
  // Names of files may contain any bytes.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace lmdbench
