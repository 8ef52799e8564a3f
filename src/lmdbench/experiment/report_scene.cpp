// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/prepare.h>
#include <lmdbench/experiment/report_scene.h>
#include <lmdbench/methods/query.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {
namespace {

constexpr std::size_t MOST_FRAMES = 600;
/// How the inputs of a result name the file of a mesh: "mesh:bunny-16k".
constexpr std::string_view MESH_ROLE = "mesh:";

/// Lets the experiment read its meshes where the run read them, and makes sure that they are still the same.
void use_recorded_files(Experiment& experiment, const ResultReader& result) {
  const std::vector<std::string> roles = result.texts("/provenance/inputs/role");
  const std::vector<std::string> files = result.texts("/provenance/inputs/file");
  const std::vector<std::string> hashes = result.texts("/provenance/inputs/sha256");
  std::vector<MeshChoice*> choices{&experiment.moving};
  for (MeshChoice& fixed : experiment.fixed) choices.push_back(&fixed);
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (!roles[i].starts_with(MESH_ROLE)) continue;
    if (sha256_of_file(files[i]) != hashes[i])
      throw InputError(files[i], "", "has changed since the run: the result was made from other bytes",
                       "give the mesh back its content, or run the experiment again");
    const std::string name = roles[i].substr(MESH_ROLE.size());
    for (MeshChoice* choice : choices)
      if (choice->mesh == name) choice->mesh = std::filesystem::absolute(files[i]).string();
  }
}

std::vector<TimedPose> recorded_poses(const ResultReader& result, std::vector<std::size_t>& frames) {
  const std::vector<double> times = result.reals("/path/time");
  const std::vector<double> p = result.reals("/path/position");
  const std::vector<double> q = result.reals("/path/orientation");
  const std::size_t stride = std::max<std::size_t>(1, (times.size() + MOST_FRAMES - 1) / MOST_FRAMES);
  std::vector<TimedPose> poses;
  for (std::size_t f = 0; f < times.size(); f += stride) {
    frames.push_back(f);
    const Pose pose{Vec3(p[3 * f], p[3 * f + 1], p[3 * f + 2]),
                    Eigen::Quaterniond(q[4 * f + 3], q[4 * f], q[4 * f + 1], q[4 * f + 2])};
    poses.push_back({times[f], pose});
  }
  return poses;
}

/// The method whose sets are the truth at a price that every frame can pay.
std::unique_ptr<Method> exact_method(const Scene& scene) {
  for (const MethodDescription& description : method_descriptions())
    if (description.promise == Promise::COMPLETE_SET && !description.brute_force)
      return make_method(description.name, scene);
  throw EnvironmentError("", "", "this build has no method that is complete in every frame",
                         "build all methods");
}

}  // namespace

void write_report_scene(const ResultReader& result, const std::filesystem::path& folder) {
  Experiment experiment =
      parse_experiment(result.texts("/provenance/experiment").at(0),
                       result.text_attribute("/provenance", "experiment_file").value_or(""));
  use_recorded_files(experiment, result);
  std::vector<MeshNote> notes;
  Scene scene = load_scene(experiment, notes);
  scene.cutoff = result.real_attribute("/scene", "cutoff_m").value();
  write_off(folder / "moving.off", scene.moving->surface().mesh);
  for (std::size_t i = 0; i < scene.fixed.size(); ++i)
    write_off(folder / fmt::format("fixed_{}.off", i), scene.fixed[i]->surface().mesh);

  const std::unique_ptr<Method> method = exact_method(scene);
  std::vector<std::size_t> frames;
  const std::vector<TimedPose> poses = recorded_poses(result, frames);
  std::string lines;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string line = query_json(query(*method, poses[i].pose, scene.cutoff, poses[i].time));
    lines += fmt::format("{{\"frame\":{},{}\n", frames[i], std::string_view(line).substr(1));
  }
  write_file_atomically(folder / "lmds.jsonl", lines);
}

}  // namespace lmdbench
