// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result/write_result.h>
#include <lmdbench/result_file/write_column.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lmdbench {

void write_profile(ResultWriter& writer, const std::string& group, const PreparedProfile& profile,
                   const VirtualPhantom& device) {
  writer.attribute(group, "cutoff_m", profile.force.cutoff);
  writer.attribute(group, "saturation_m", profile.force.saturation_distance);
  writer.attribute(group, "maximum_force_n", profile.force.maximum_force);
  writer.attribute(group, "sharpness", profile.force.sharpness);
  writer.attribute(group, "force_limit_n", device.limit(profile.force.largest_sum));
}

namespace {

/// The `fixed_body` and pose of each instance.
void write_instances(ResultWriter& writer, const std::string& group, const MeshNote& mesh) {
  writer.attribute(group, "first_fixed_body", mesh.first_fixed_body);
  writer.attribute(group, "coincident_instances",
                   static_cast<std::int64_t>(count_coincident(mesh.instances)));
  write_column(writer, {group + "/position", "m", "origin of each instance's frame, world frame"},
               mesh.instances, [](const Pose& pose) { return pose.translation; });
  write_column(writer, {group + "/orientation", "1", "quaternion x, y, z, w of each instance's frame"},
               mesh.instances, [](const Pose& pose) { return pose.rotation; });
}

/// How a mesh deforms, and what each frame changes of it.
void write_deformation(ResultWriter& writer, const std::string& group, const MeshNote& mesh,
                       const DeformingBody& body) {
  writer.attribute(group, "deformation", to_text(mesh.vertices->deformation()));
  writer.attribute(group, "farthest_m", body.farthest);
  const auto column = [&](const char* name, const char* units, const char* long_name,
                          auto DeformationStep::*value) {
    write_column(writer, {group + "/deformation/" + name, units, long_name}, body.steps,
                 [value](const DeformationStep& step) { return step.*value; });
  };
  column("moved_vertices", "1", "vertices that moved since the frame before, in the first frame since rest",
         &DeformationStep::moved_vertices);
  column("turned_over", "1", "triangles whose normal turned by more than a right angle since then",
         &DeformationStep::turned_over);
  column("lost_area", "1", "triangles that had an area then and have none", &DeformationStep::lost_area);
  column("largest_move", "m", "longest way of a vertex since then", &DeformationStep::largest_move);
}

/// The table of objects, in the order of the file.
void write_objects(ResultWriter& writer, const std::vector<MeshNote>& meshes) {
  const auto column = [&](const std::string& name, const std::string& long_name, const auto& value) {
    write_column(writer, {"/scene/objects/" + name, "1", long_name}, meshes, value);
  };
  column("name", "of the object: its own, else its role", [](const MeshNote& mesh) { return mesh.object; });
  column("role", "the group of its mesh in /scene", [](const MeshNote& mesh) { return mesh.role; });
  column("mesh", "name or file of its mesh", [](const MeshNote& mesh) { return mesh.name; });
  column("motion", "held, stands, path or sways",
         [](const MeshNote& mesh) { return std::string(to_string(mesh.motion)); });
  column("first", "number of its first instance, among what stands or among what moves",
         [](const MeshNote& mesh) {
           return mesh.motion == MotionKind::STANDS ? mesh.first_fixed_body : mesh.first_mover;
         });
  column("instances", "how many of it there are", [](const MeshNote& mesh) {
    return std::max<std::int64_t>(1, mesh.movers + static_cast<std::int64_t>(mesh.instances.size()));
  });
}

}  // namespace

void write_scene(ResultWriter& writer, const RunResult& result) {
  const PreparedRun& prepared = result.prepared;
  writer.attribute("/scene", "frame_rate_hz", prepared.input.frame_rate_hz);
  write_profile(writer, "/scene", prepared.profiles.front(), prepared.input.device);
  const Device& device = prepared.input.device.device();
  writer.attribute("/scene", "device", std::string(device.name));
  writer.attribute("/scene", "device_maximum_force_n", device.maximum_force.value);
  writer.attribute("/scene", "device_continuous_force_n", device.continuous_force.value);
  for (const MeshNote& mesh : prepared.meshes) {
    const std::string group = "/scene/" + mesh.role;
    writer.attribute(group, "mesh", mesh.name);
    writer.attribute(group, "sha256", mesh.sha256);
    writer.attribute(group, "triangles", mesh.report.triangles);
    writer.attribute(group, "diagonal_m", mesh.report.diagonal);
    writer.attribute(group, "closed", std::int64_t{mesh.report.closed});
    writer.attribute(group, "manifold", std::int64_t{mesh.report.manifold});
    writer.attribute(group, "planar_tolerance_m", mesh.flattening.tolerance);
    writer.attribute(group, "planar_moved_vertices", mesh.flattening.moved_vertices);
    writer.attribute(group, "planar_largest_move_m", mesh.flattening.largest_move);
    writer.attribute(group, "orient", std::string(to_string(mesh.orientation.choice)));
    writer.attribute(group, "turned_triangles", mesh.orientation.turned_triangles);
    writer.attribute(group, "validity", to_json(mesh.report).dump());
    if (!mesh.instances.empty()) write_instances(writer, group, mesh);
    if (mesh.movers > 0) {
      writer.attribute(group, "first_mover", mesh.first_mover);
      writer.attribute(group, "movers", mesh.movers);
    }
    if (mesh.vertices)
      write_deformation(writer, group, mesh, *prepared.input.motion.deformation->find(mesh.body.get()));
  }
  write_objects(writer, prepared.meshes);
  writer.write({"/scene/torque_reference", "m",
                "centre of the moving mesh's bounding box in its own frame: torque is about it"},
               std::span<const double>(prepared.input.reference_M.data(), 3), {3});
  writer.attribute("/scene", "starts_touching", std::int64_t{prepared.starts_touching});
  writer.write({"/scene/warnings", "1", "what a reader of this result must know"}, result.warnings);
}

}  // namespace lmdbench
