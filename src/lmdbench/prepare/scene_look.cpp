// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/rules.h>
#include <lmdbench/mesh/length_unit.h>
#include <lmdbench/mesh/winding_number.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/prepare/scene_look.h>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace lmdbench {
namespace {

/// A mesh with its pose and its box, which bounds the points inside the mesh.
class BoxedMesh {
 public:
  BoxedMesh(const SceneLook::Mesh& look, const FixedBody& body)
      : closed_(look.closed), mesh_(&body->surface().mesh), X_WF_(body.X_WF) {
    for (const Vec3& vertex : mesh_->vertices) box_.extend(vertex);
  }
  [[nodiscard]] bool encloses(const Vec3& point) const {
    const Vec3 point_F = X_WF_.rotation.conjugate() * (point - X_WF_.translation);
    return closed_ && box_.contains(point_F) && std::abs(winding_number(point_F, *mesh_)) > 0.5;
  }
  /// Moved inwards a little: that of a part which rests on another one is on its surface.
  [[nodiscard]] Vec3 first_vertex() const {
    const Vec3& vertex = mesh_->vertices.front();
    return RigidTransform(X_WF_).point(vertex + 1e-6 * (box_.center() - vertex));
  }

 private:
  bool closed_;
  const TriangleMesh* mesh_;
  Pose X_WF_;
  Eigen::AlignedBox3d box_;
};

/// Counts the tested frames in which something holds, and keeps the first.
struct FramesOf {
  std::int64_t count = 0, first = -1;

  void add(std::int64_t frame) {
    if (count++ == 0) first = frame;
  }
};

std::vector<SceneLook::Mesh> meshes_of(const Experiment& experiment, const std::vector<MeshNote>& notes) {
  std::vector<SceneLook::Mesh> meshes;
  for (const ObjectChoice& choice : experiment.objects) {
    const MeshNote& note = notes[meshes.size()];
    meshes.push_back({note.role, note.name, note.report.triangles, note.report.diagonal, note.report.closed,
                      static_cast<std::int64_t>(note.instances.size())});
    if (!choice.placement.diagonal)
      meshes.back().unit = choice.placement.scale.value_or(1.0);
    else
      meshes.back().unit.reset();
    meshes.back().unit_is_said =
        choice.placement.diagonal || choice.placement.scale || metres_of_format(choice.mesh);
  }
  return meshes;
}

std::vector<SceneWarning> warnings_of_sizes(const std::vector<SceneLook::Mesh>& meshes) {
  std::vector<SceneWarning> warnings;
  const auto [least, most] = std::minmax_element(
      meshes.begin(), meshes.end(),
      [](const SceneLook::Mesh& a, const SceneLook::Mesh& b) { return a.diagonal < b.diagonal; });
  const double ratio = most->diagonal / least->diagonal;
  const std::string unlike =
      fmt::format("{} {} is {:.4g} m large, {} {} {:.4g} m: {:.0f} times as much", most->role, most->name,
                  most->diagonal, least->role, least->name, least->diagonal, ratio);
  const double inch_in_mm = metres_of_unit("in", "") / metres_of_unit("mm", "");
  if (ratio > UNLIKELY_SIZE_RATIO)
    warnings.push_back({unlike, "where one is in millimetres, give it \"scale\": 0.001; else a diagonal_m"});
  else if (least->unit && least->unit == most->unit &&
           std::max(ratio / inch_in_mm, inch_in_mm / ratio) < INCH_RATIO_FACTOR)
    warnings.push_back(
        {unlike + ", about what an inch has millimetres, and both are read in one unit",
         "where one is in inches, give it \"scale\": 0.0254 and the other one its own (0.001 of "
         "millimetres)"});
  const auto large =
      std::max_element(meshes.begin(), meshes.end(), [](const SceneLook::Mesh& a, const SceneLook::Mesh& b) {
        return (a.unit_is_said ? 0.0 : a.diagonal) < (b.unit_is_said ? 0.0 : b.diagonal);
      });
  if (!large->unit_is_said && large->diagonal > UNLIKELY_SIZE)
    warnings.push_back(
        {fmt::format("{} {} is {:.4g} m large: its file says no unit, and its coordinates are "
                     "taken for metres",
                     large->role, large->name, large->diagonal),
         "where they are millimetres, give every mesh \"scale\": 0.001, else a \"scale\" of its own or "
         "a diagonal_m"});
  return warnings;
}

void look_at_cutoff(SceneLook& look) {
  const auto least = std::min_element(
      look.meshes.begin(), look.meshes.end(),
      [](const SceneLook::Mesh& a, const SceneLook::Mesh& b) { return a.diagonal < b.diagonal; });
  if (look.cutoff > least->diagonal)
    look.warnings.push_back(
        {fmt::format("the cutoff of {:.4g} m is larger than {} {}, {:.4g} m: all of it is in contact at once",
                     look.cutoff, least->role, least->name, least->diagonal),
         "lower /force/cutoff_m, which is in metres, or check scale and diagonal_m"});
}

/// The earlier object with the same mesh at the same place.
std::optional<std::size_t> coincident_object(const Experiment& experiment, const std::vector<MeshNote>& notes,
                                             std::size_t index) {
  const ObjectChoice& choice = experiment.objects[index];
  for (std::size_t i = 0; i < index; ++i) {
    const ObjectChoice& other = experiment.objects[i];
    if (choice.stands() && other.stands() && notes[i].sha256 == notes[index].sha256 && !choice.instances &&
        !other.instances && other.placement == choice.placement && same_pose(other.pose, choice.pose))
      return i;
  }
  return std::nullopt;
}

/// An object at one place twice has each of its contacts twice.
void look_at_entries(SceneLook& look, const Experiment& experiment, const PreparedRun& prepared) {
  std::int64_t coincident = 0;
  std::string first;
  for (std::size_t i = 0; i < experiment.objects.size(); ++i) {
    const std::optional<std::size_t> other = coincident_object(experiment, prepared.meshes, i);
    if (other && coincident++ == 0)
      first = fmt::format("{} is the mesh of {}, {}", experiment.objects[i].role,
                          experiment.objects[*other].role, experiment.objects[i].mesh);
  }
  if (coincident > 0)
    look.warnings.push_back(
        {fmt::format("{}, at the same place{}: each of its contacts is there twice and pushes twice", first,
                     coincident > 1 ? fmt::format(" (the first of {} such entries)", coincident) : ""),
         "remove the entry, or move it by its \"pose\""});
}

/// Distances cannot tell inside from outside.
void look_inside(SceneLook& look, const Experiment& experiment, const PreparedRun& prepared) {
  if (prepared.input.motion.movers) return;  // too many pairs to test
  if (experiment.is_world()) return;         // instances may well overlap
  SceneFrames bodies(prepared.scene(), prepared.input.motion);
  const std::size_t fixed_count = bodies.scene().fixed.size();
  std::vector<BoxedMesh> boxed;  // the moving mesh, then the fixed ones
  const auto box_them = [&] {
    boxed.clear();
    boxed.emplace_back(look.meshes.front(), bodies.scene().moving);
    for (std::size_t i = 0; i < fixed_count; ++i)
      boxed.emplace_back(look.meshes[i + 1], bodies.scene().fixed[i]);
  };
  box_them();
  std::vector<FramesOf> enclosed_by_moving(fixed_count), moving_inside(fixed_count);
  const std::vector<Pose>& poses = prepared.input.poses;
  const auto count = static_cast<std::int64_t>(poses.size());
  const std::int64_t samples = std::min(INSIDE_SAMPLES, count);
  for (std::int64_t k = 0; k < samples; ++k) {
    const std::int64_t frame = samples == 1 ? 0 : k * (count - 1) / (samples - 1);
    if (bodies.deforms()) {
      bodies.to_frame(frame);
      box_them();
    }
    const Pose& pose = poses[static_cast<std::size_t>(frame)];
    const RigidTransform X_WM(pose);
    for (std::size_t i = 0; i < fixed_count; ++i) {
      const BoxedMesh &moving = boxed.front(), &fixed = boxed[i + 1];
      const Vec3 fixed_M = pose.rotation.conjugate() * (fixed.first_vertex() - pose.translation);
      if (moving.encloses(fixed_M)) enclosed_by_moving[i].add(frame);
      if (fixed.encloses(X_WM.point(moving.first_vertex()))) moving_inside[i].add(frame);
    }
  }
  for (std::size_t i = 0; i < fixed_count; ++i) {
    const FramesOf &enclosed = enclosed_by_moving[i], &inside = moving_inside[i];
    const std::string& name = look.meshes[i + 1].name;
    if (enclosed.count > 0)
      look.warnings.push_back(
          {fmt::format(
               "the moving mesh ({:.4g} m) encloses a vertex of {} {} ({:.4g} m) in {} of {} frames looked "
               "at, first in frame {}",
               look.meshes.front().diagonal, look.meshes[i + 1].role, name, look.meshes[i + 1].diagonal,
               enclosed.count, samples, enclosed.first),
           "check the units of both (scale, diagonal_m) and the path; without a path one is made that stays "
           "outside"});
    if (inside.count > 0)
      look.warnings.push_back(
          {fmt::format(
               "the path is inside {} {} in {} of {} frames looked at, first in frame {}: LMDs there are "
               "those of two surfaces that have passed through each other",
               look.meshes[i + 1].role, name, inside.count, samples, inside.first),
           "move the path outside; without a path one is made that stays there"});
  }
}

/// @param path JSON pointer of its file
void look_at_path(SceneLook& look, const std::string& path, const PreparedRun& prepared) {
  if (!prepared.path_gaps.empty()) {
    const auto longest = std::max_element(
        prepared.path_gaps.begin(), prepared.path_gaps.end(),
        [](const RecordingGap& a, const RecordingGap& b) { return a.duration < b.duration; });
    double total = 0.0;
    for (const RecordingGap& gap : prepared.path_gaps) total += gap.duration;
    look.warnings.push_back(
        {fmt::format(
             "the path has {} gaps of {:.4g} s together, the longest {:.4g} s from {:.6g} s on: the mesh is "
             "held there",
             prepared.path_gaps.size(), total, longest->duration, longest->start),
         fmt::format("record it again, cut it there, or set {}/gap_intervals to 0 to interpolate over gaps",
                     path.substr(0, path.rfind('/')))});
  }
  if (look.frames_in_contact > 0) return;
  double bound = std::numeric_limits<double>::infinity();
  SceneDistance distance(prepared.scene(), prepared.input.motion);
  for (std::size_t frame = 0; frame < prepared.input.poses.size(); ++frame) {
    const auto at = static_cast<std::int64_t>(frame);
    const double least = distance.at(at, prepared.input.poses[frame], bound);
    if (!(least < bound)) continue;
    bound = least;
    look.nearest_frame = at;
  }
  look.nearest = bound;
  look.warnings.push_back(
      {fmt::format("the path never comes within the cutoff of {:.4g} m: {:.4g} m at its nearest, in frame "
                   "{}, {:.4g} m "
                   "short",
                   look.cutoff, look.nearest, look.nearest_frame, look.nearest - look.cutoff),
       "raise the cutoff, bring the path nearer, check scale and diagonal_m, or leave the path out: one is "
       "made"});
}

}  // namespace

std::string to_text(const SceneWarning& warning) {
  return fmt::format("{} (remedy: {})", warning.what, warning.remedy);
}

std::vector<SceneWarning> size_warnings(const Experiment& experiment, const std::vector<MeshNote>& notes) {
  return warnings_of_sizes(meshes_of(experiment, notes));
}

SceneLook look_at(const Experiment& experiment, const PreparedRun& prepared,
                  const std::vector<bool>& in_contact) {
  SceneLook look;
  look.meshes = meshes_of(experiment, prepared.meshes);
  look.cutoff = prepared.scene().cutoff;
  look.saturation = prepared.profiles.front().force.saturation_distance;
  look.maximum_force = prepared.profiles.front().force.maximum_force;
  look.force_limit = prepared.input.device.limit(prepared.profiles.front().force.largest_sum);
  look.frames = static_cast<std::int64_t>(in_contact.size());
  look.frames_in_contact = std::count(in_contact.begin(), in_contact.end(), true);
  look.several_profiles = prepared.profiles.size() > 1;
  look.defaults = prepared.defaults;
  look.warnings = warnings_of_sizes(look.meshes);
  look_at_cutoff(look);
  look_at_entries(look, experiment, prepared);
  // In a closed loop the path is the hand's intent, which may lie inside.
  if (!experiment.loop.closed) {
    look_inside(look, experiment, prepared);
    look_at_path(look, experiment.held().motion.path_place, prepared);
  }
  return look;
}

std::string to_text(const SceneLook& look) {
  std::string text = "scene:\n";
  for (const SceneLook::Mesh& mesh : look.meshes)
    text += fmt::format("  {:<10} {}: {} triangles, {:.4g} m, {}{}\n", mesh.role, mesh.name, mesh.triangles,
                        mesh.diagonal, mesh.closed ? "closed" : "open",
                        mesh.instances > 0 ? fmt::format(", {} instances", mesh.instances) : "");
  text += fmt::format(
      "  cutoff {:.4g} m, saturation {:.4g} m, {:g} N an LMD at most, the sum clipped to {:g} N\n",
      look.cutoff, look.saturation, look.maximum_force, look.force_limit);
  text += fmt::format("  {} frames, {} of them in contact{}\n", look.frames, look.frames_in_contact,
                      look.several_profiles ? " of the first profile" : "");
  double total = 0.0;
  for (const ExpectedTime& time : look.times) {
    text += fmt::format("  about {:.2g} s for {}\n", time.seconds, time.stage);
    total += time.seconds;
  }
  if (!look.times.empty()) text += fmt::format("  about {:.2g} s in all\n", total);
  text += defaults_text(look.defaults);
  for (const SceneWarning& warning : look.warnings) text += "warning: " + to_text(warning) + "\n";
  return text;
}

nlohmann::ordered_json to_json(const SceneLook& look) {
  using OrderedJson = nlohmann::ordered_json;
  OrderedJson json;
  json["meshes"] = OrderedJson::array();
  for (const SceneLook::Mesh& mesh : look.meshes) {
    json["meshes"].push_back({{"role", mesh.role},
                              {"name", mesh.name},
                              {"triangles", mesh.triangles},
                              {"diagonal_m", mesh.diagonal},
                              {"closed", mesh.closed}});
    if (mesh.instances > 0) json["meshes"].back()["instances"] = mesh.instances;
  }
  json["cutoff_m"] = look.cutoff;
  json["saturation_m"] = look.saturation;
  json["maximum_force_n"] = look.maximum_force;
  json["force_limit_n"] = look.force_limit;  // infinity becomes null
  json["frames"] = look.frames;
  json["frames_in_contact"] = look.frames_in_contact;
  json["nearest_m"] = look.nearest;  // NaN becomes null
  json["defaults"] = defaults_json(look.defaults);
  json["warnings"] = OrderedJson::array();
  for (const SceneWarning& warning : look.warnings)
    json["warnings"].push_back({{"what", warning.what}, {"remedy", warning.remedy}});
  if (look.times.empty()) return json;
  json["expected_seconds"] = OrderedJson::object();
  for (const ExpectedTime& time : look.times) json["expected_seconds"][time.stage] = time.seconds;
  return json;
}

namespace {

/// Mean seconds of a search at frames spread over the path, each with its shape.
double search_seconds(Method& method, SceneFrames& bodies, const std::vector<Pose>& poses) {
  const auto count = static_cast<std::int64_t>(poses.size());
  const std::int64_t samples = std::min(TIMED_FRAMES, count);
  const auto begin = std::chrono::steady_clock::now();
  for (std::int64_t k = 0; k < samples; ++k) {
    LmdSet lmds;
    WorkCounters counters;
    const std::int64_t frame = (2 * k + 1) * count / (2 * samples);
    bodies.to_frame(frame);
    method.search(poses[static_cast<std::size_t>(frame)], lmds, counters);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
         static_cast<double>(samples);
}

}  // namespace

std::vector<ExpectedTime> expected_times(const Experiment& experiment, const PreparedRun& prepared) {
  const auto frames = static_cast<double>(prepared.input.poses.size());
  std::vector<ExpectedTime> times;
  for (const MethodChoice& choice : experiment.methods) {
    SceneFrames bodies(prepared.profiles[choice.profile].scene, prepared.input.motion);
    const auto method = make_method(choice.name, bodies.scene(), choice.options);
    // Where meshes deform, a local update makes the method anew: as much as a search.
    const double searches = method->description().tracks_locally && !bodies.deforms()
                                ? frames / static_cast<double>(experiment.driver.search_every_frames)
                                : frames;
    times.push_back({choice.label, static_cast<double>(experiment.driver.repetitions) * searches *
                                       search_seconds(*method, bodies, prepared.input.poses)});
  }
  if (const std::int64_t stride = experiment.probe_stride("truth"); stride > 0) {
    SceneFrames bodies(prepared.scene(), prepared.input.motion);
    const auto truth = make_method("exhaustive", bodies.scene());
    // Two searches a probed frame: the true jump needs the next frame's force.
    times.push_back({"truth", 2.0 * frames / static_cast<double>(stride) *
                                  search_seconds(*truth, bodies, prepared.input.poses)});
  }
  return times;
}

}  // namespace lmdbench
