// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/plan.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace lmdbench {
namespace {

/// Whether a method tracks locally is a property of its class: asked of an instance
/// on a scene of one triangle.
bool tracks_locally(const MethodChoice& choice) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  mesh.triangles = {{0, 1, 2}};
  const auto body = std::make_shared<const Body>("plan", build_surface(mesh));
  return make_method(choice.name, Scene{body, {body}, 1.0}, choice.options)->tracks_locally();
}

std::string join_labels(const std::vector<std::string>& labels) {
  return fmt::format("{}", fmt::join(labels, ", "));
}

}  // namespace

bool Plan::needs(Part part) const {
  return std::any_of(items.begin(), items.end(),
                     [&](const PlanItem& item) { return item.part == part && item.needed; });
}

Plan make_plan(const Experiment& experiment) {
  std::vector<std::string> tracking;
  std::vector<std::string> searching;
  for (const MethodChoice& choice : experiment.methods)
    (tracks_locally(choice) ? tracking : searching).push_back(choice.label);

  Plan plan;
  const auto add = [&](Part part, const std::string& name, bool needed, const std::string& why_needed,
                       const std::string& why_left_out) {
    plan.items.push_back({part, needed, name, needed ? why_needed : why_left_out});
  };
  add(Part::LOCAL_TRACKING, "global searches and local tracking", !tracking.empty(),
      fmt::format("{}: a search every {} frames that arrives {} frames later", join_labels(tracking),
                  experiment.driver.search_every_frames, experiment.driver.search_latency_frames),
      "no method tracks locally");
  add(Part::SEARCH_PER_FRAME, "a search in every frame", !searching.empty(), join_labels(searching),
      "every method tracks locally");
  add(Part::DEVICE, "virtual device", true,
      fmt::format("{} clips the summed force; the loop is open", experiment.device), "");
  add(Part::TRUTH_PROBE, "truth probe", experiment.truth_stride_frames > 0,
      fmt::format("exhaustive LMD sets every {} frames, outside the timed frames",
                  experiment.truth_stride_frames),
      "probes/truth/stride_frames is 0: times of this run stand without an error");
  add(Part::FCL, "FCL cross-check", experiment.fcl_stride_frames > 0,
      fmt::format("minimum distances every {} frames, relative tolerance {:g}", experiment.fcl_stride_frames,
                  experiment.fcl_tolerance_relative),
      "probes/fcl/stride_frames is 0: no FCL hierarchy is built");
  add(Part::LMD_LISTS, "LMD lists in the result", experiment.record_lmds, "record/lmds is true",
      experiment.truth_stride_frames > 0
          ? "record/lmds is false: lists are kept in memory for probed frames only"
          : "record/lmds is false and nothing is probed");
  add(Part::TORQUE_RENDERING, "torque on the device", false, "",
      "the device actuates three degrees of freedom: torque is recorded, not rendered");
  add(Part::INTERSECTIONS, "intersection polylines", false, "", "the experiment does not ask for them");
  add(Part::THREADS, "threads", false, "", "the lockstep driver has one clock and one thread");
  return plan;
}

std::string plan_text(const Plan& plan, const Experiment& experiment) {
  std::string text = fmt::format("{}: {}\n", experiment.name, experiment.title);
  text += fmt::format("moving {}, fixed", experiment.moving.mesh);
  for (const MeshChoice& fixed : experiment.fixed) text += " " + fixed.mesh;
  text += fmt::format(", path {}, {:g} frames a second, {} repetitions\n", experiment.path_file.string(),
                      experiment.frame_rate_hz, experiment.driver.repetitions);
  for (const bool needed : {true, false}) {
    text += needed ? "needed:\n" : "left out:\n";
    for (const PlanItem& item : plan.items)
      if (item.needed == needed) text += fmt::format("  {:<36} {}\n", item.name, item.why);
  }
  return text;
}

std::string plan_json(const Plan& plan, const Experiment& experiment) {
  nlohmann::ordered_json json;
  json["experiment"] = nlohmann::ordered_json::parse(experiment.resolved_json);
  json["needed"] = nlohmann::ordered_json::array();
  json["left_out"] = nlohmann::ordered_json::array();
  for (const PlanItem& item : plan.items)
    json[item.needed ? "needed" : "left_out"].push_back({{"part", item.name}, {"why", item.why}});
  return json.dump(2);
}

}  // namespace lmdbench
