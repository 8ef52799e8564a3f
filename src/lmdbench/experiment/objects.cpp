// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/motion/tum_file.h>

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

Pose pose_of(const Json& entry, const std::string& place, const std::string& file) {
  const Json& p = entry["translation_m"];
  const Json& q = entry["rotation_xyzw"];
  Pose pose{Vec3(p[0].get<double>(), p[1].get<double>(), p[2].get<double>())};
  pose.rotation =
      Eigen::Quaterniond(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>());
  if (!(std::abs(pose.rotation.norm() - 1.0) <= QUATERNION_LENGTH_TOLERANCE))
    throw UsageError(file, place + "/rotation_xyzw",
                     fmt::format("quaternion of length {:.6g}", pose.rotation.norm()),
                     "give a unit quaternion in the order x, y, z, w");
  pose.rotation.normalize();
  return pose;
}

/// @param key of the path's file in the entry
ObjectMotion path_motion(const Json& entry, const char* key, const std::string& place,
                         const std::filesystem::path& file) {
  ObjectMotion motion;
  motion.kind = MotionKind::PATH;
  motion.path_place = place + "/" + key;
  if (entry.contains(key)) motion.path_file = shortened(file.parent_path() / entry[key].get<std::string>());
  motion.interpolation = entry["interpolation"] == "linear" ? Interpolation::LINEAR : Interpolation::CUBIC;
  motion.gap_intervals = entry["gap_intervals"].get<double>();
  return motion;
}

ObjectMotion sway_motion(const Json& entry) {
  ObjectMotion motion;
  motion.kind = MotionKind::SWAYS;
  Sway& sway = motion.sway;
  sway.way_diagonals = entry.value("way_diagonals", sway.way_diagonals);
  sway.turn_rad = entry.value("turn_rad", sway.turn_rad);
  sway.period_s = entry.value("period_s", sway.period_s);
  sway.seed = entry.value("seed", sway.seed);
  return motion;
}

/// @param motion as the entry's own key gives it
ObjectChoice object_choice(const Json& entry, const std::string& place, ObjectMotion motion,
                           const std::filesystem::path& path) {
  const std::string file = path.string();
  const Json& tolerance = entry["planar_tolerance"];
  ObjectChoice object;
  object.name = entry.value("name", "");
  object.place = place;
  object.mesh = entry["mesh"].get<std::string>();
  object.placement = read_placement(entry);
  if (entry.contains("pose")) object.pose = pose_of(entry["pose"], place + "/pose", file);
  // The option also takes a number as text.
  object.planar_tolerance =
      parse_planar_tolerance(tolerance.is_string() ? tolerance.get<std::string>() : tolerance.dump(), file,
                             place + "/planar_tolerance");
  object.orientation = parse_orientation(entry["orient"].get<std::string>(), file, place + "/orient");
  if (entry.contains("instances"))
    object.instances = read_instance_choice(entry["instances"], place + "/instances", path);
  if (entry.contains("deformation"))
    object.deformation = read_mesh_deformation(entry["deformation"], place + "/deformation", file);
  object.motion = std::move(motion);
  return object;
}

/// `moving`, `fixed` and `movers`.
std::vector<ObjectChoice> objects_by_kind(const Json& document, const std::filesystem::path& file) {
  std::vector<ObjectChoice> objects{object_choice(
      document["moving"], "/moving", path_motion(document["path"], "file", "/path", file), file)};
  const Json none = Json::array();
  const auto list = [&](const char* key) -> const Json& {
    return document.contains(key) ? document[key] : none;
  };
  for (std::size_t i = 0; i < list("fixed").size(); ++i)
    objects.push_back(object_choice(list("fixed")[i], fmt::format("/fixed/{}", i), {}, file));
  for (std::size_t i = 0; i < list("movers").size(); ++i) {
    const Json &entry = list("movers")[i], &path = entry["path"];
    const std::string place = fmt::format("/movers/{}", i);
    objects.push_back(object_choice(
        entry, place,
        path.contains("file") ? path_motion(path, "file", place + "/path", file) : sway_motion(path), file));
  }
  return objects;
}

/// `objects`.
std::vector<ObjectChoice> objects_of_list(const Json& document, const std::filesystem::path& file) {
  std::vector<ObjectChoice> objects;
  const Json& list = document["objects"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string place = fmt::format("/objects/{}", i);
    ObjectMotion motion;
    if (list[i].contains("motion")) {
      const Json& own = list[i]["motion"];
      if (!own.contains("path") && !own.contains("sway"))
        throw UsageError(file.string(), place + "/motion", "says neither path nor sway",
                         "give one of them; without motion an object stands");
      motion =
          own.contains("path") ? path_motion(own, "path", place + "/motion", file) : sway_motion(own["sway"]);
    } else if (i == 0) {
      motion = path_motion(document["path"], "file", "/path", file);
    }
    objects.push_back(object_choice(list[i], place, std::move(motion), file));
  }
  const ObjectChoice& held = objects.front();
  const auto refuse = [&](bool is_there, const char* key, const char* why, const char* remedy) {
    if (is_there) throw UsageError(file.string(), held.place + key, why, remedy);
  };
  refuse(held.motion.kind == MotionKind::SWAYS, "/motion/sway",
         "the first object is the one that the device holds, and it follows a path",
         "give it a path, or none: one is made for the scene; or list another object first");
  refuse(held.instances.has_value(), "/instances", "the device holds one mesh, the first object",
         "list another object first");
  refuse(!same_pose(held.pose, Pose{}), "/pose", "where the first object is its path says",
         "leave it out, or list another object first");
  return objects;
}

}  // namespace

std::string_view to_string(MotionKind kind) {
  switch (kind) {
    case MotionKind::HELD:
      return "held";
    case MotionKind::STANDS:
      return "stands";
    case MotionKind::PATH:
      return "path";
    case MotionKind::SWAYS:
      return "sways";
  }
  return "unknown";
}

void check_scene_keys(const Json& document, const std::string& file) {
  if (!document.is_object()) return;
  for (const char* key : {"moving", "fixed"})
    if (!document.contains("objects") && !document.contains(key))
      throw UsageError(file, "", fmt::format("Missing required property '{}'", key),
                       "name the meshes of the scene: objects, or moving and fixed");
  if (document.contains("path") && document.contains(Json::json_pointer("/objects/0/motion")))
    throw UsageError(file, "/path", "the first object has a motion, which is the path",
                     "leave one of them out");
}

std::vector<ObjectChoice> read_objects(const Json& document, const std::filesystem::path& file) {
  const bool is_list = document.contains("objects");
  std::vector<ObjectChoice> objects =
      is_list ? objects_of_list(document, file) : objects_by_kind(document, file);
  objects.front().motion.kind = MotionKind::HELD;
  std::set<std::string> names;
  std::size_t standing = 0, moving = 0;
  for (ObjectChoice& object : objects) {
    object.role = object.motion.kind == MotionKind::HELD ? "moving"
                  : object.stands()                      ? fmt::format("fixed_{}", standing++)
                                                         : fmt::format("mover_{}", moving++);
    if (object.name.empty()) object.name = object.role;
    if (!names.insert(object.name).second)
      throw UsageError(file.string(), object.place + "/name",
                       fmt::format("two objects are called \"{}\"", object.name),
                       "give one of them another name");
  }
  if (standing == 0)
    throw UsageError(file.string(), "/objects", "every object moves", "add one that stands: without motion");
  return objects;
}

}  // namespace lmdbench
