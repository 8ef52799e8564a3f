// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/base/run_program.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/methods/query.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/result_file/result_reader.h>
#include <lmdbench/view/report.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* MODULES = "import h5py, jinja2, markdown, matplotlib, numpy, PIL";
constexpr const char* PACKAGES =
    "apt-get install python3-h5py python3-jinja2 python3-markdown python3-matplotlib python3-numpy "
    "python3-pil";
/// Environment variable with the scripts' folder, if not the program's data folder.
constexpr const char* SCRIPTS_VARIABLE = "LMDBENCH_SCRIPTS";

fs::path report_script() {
  const char* folder = std::getenv(SCRIPTS_VARIABLE);
  fs::path script =
      (folder != nullptr ? fs::path(folder) : data_folder() / "scripts") / "report" / "report.py";
  if (!fs::exists(script))
    throw EnvironmentError(script.string(), "", "is missing: it makes the page",
                           fmt::format("set {} to the folder scripts/ of lmdbench", SCRIPTS_VARIABLE));
  return script;
}

/// The first interpreter with the modules: python3 may be a private build without them.
std::string find_python() {
  for (const char* candidate : {"python3", "/usr/bin/python3"}) {
    try {
      if (run_program({candidate, "-c", MODULES}, fs::current_path(), PACKAGES).exit_status == 0)
        return candidate;
    } catch (const EnvironmentError&) {
      continue;  // missing: try the next one
    }
  }
  throw EnvironmentError("python3", "", fmt::format("no interpreter can do '{}'", MODULES), PACKAGES);
}

/// The last line of a script's output: its error, without the traceback.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// Writes a scene for the 3D view, or the reason why there is none.
void write_scene_or_reason(const ResultReader& result, const fs::path& folder, const Tell& warn) {
  fs::create_directory(folder);
  try {
    write_report_scene(result, folder);
  } catch (const Error& error) {
    warn(fmt::format("{} gets no 3D view: {}", result.file().string(), error.what()));
    write_file_atomically(folder / "problem.txt", fmt::format("No view: {}", error.what()));
  }
}

}  // namespace

fs::path write_report(const ReportRequest& request, const Tell& progress, const Tell& warn) {
  refuse_no_folder(request.out, "--out");
  const fs::path script = report_script();
  const std::string python = find_python();
  const TemporaryFolder scenes(fs::temp_directory_path(), "lmdbench-report-");
  std::vector<std::string> argv{python, "-B", script.string()};  // writes nothing beside the script
  for (std::size_t i = 0; i < request.results.size(); ++i) {
    progress(fmt::format("reading {}", request.results[i].string()));
    const ResultReader result(request.results[i]);
    // A sweep has no frames to show.
    if (!result.has("/sweep")) write_scene_or_reason(result, scenes.path() / fmt::to_string(i), warn);
    argv.push_back(fs::absolute(request.results[i]).string());
  }
  const fs::path out = fs::absolute(request.out);
  argv.insert(argv.end(), {"--out", out.string(), "--scenes", scenes.path().string()});
  if (request.paper) argv.emplace_back("--paper");
  if (!request.paper_figures.empty()) argv.push_back(fs::absolute(request.paper_figures).string());
  if (!request.studies.empty()) argv.emplace_back("--study");
  for (const fs::path& study : request.studies) argv.push_back(fs::absolute(study).string());

  std::error_code error;
  fs::create_directories(out, error);
  if (error || ::access(out.c_str(), W_OK | X_OK) != 0)
    throw EnvironmentError(request.out.string(), "", "cannot be made, or not be written to",
                           "check the permissions, or name another folder with --out");
  progress("drawing the figures and the page");
  const ProgramOutcome outcome = run_program(argv, fs::current_path(), PACKAGES);
  if (outcome.exit_status == static_cast<int>(ExitCode::USAGE))
    throw UsageError("", "", last_line(outcome.output), "");
  if (outcome.exit_status == static_cast<int>(ExitCode::INPUT_DATA))
    throw InputError("", "", last_line(outcome.output), "");
  if (outcome.exit_status != 0)
    throw EnvironmentError(
        script.string(), "",
        fmt::format("left with exit code {}: {}", outcome.exit_status, last_line(outcome.output)),
        "check the disk, and the Python packages of scripts/packages.txt");
  return out / "index.html";
}

namespace {

constexpr std::size_t MOST_FRAMES = 600;
/// Movers times frames: beyond it the page shows fewer frames.
constexpr std::size_t MOST_MOVER_POSES = 30000;

/// Vertices of deforming meshes, over all frames: beyond it the page shows fewer frames.
constexpr std::size_t MOST_SHAPE_VERTICES = 1000000;

/// A mesh of the view, with its name there.
struct DrawnMesh {
  std::string role;
  std::size_t object = 0;  ///< Of the scene.
  bool deforms = false;

  TriangleMesh in(const Scene& scene) const {
    return scene.is_mover(object) ? scene.body(object)->surface().mesh
                                  : placed_mesh(scene.fixed[object - scene.mover_count()]);
  }
};

/// The moving mesh, one for each entry of `/movers`, and fixed ones.
std::vector<DrawnMesh> drawn_meshes(const ResultReader& result, const ResultScene& result_scene,
                                    const std::vector<ResultTrack>& tracks) {
  const Scene& scene = result_scene.rest;
  std::vector<DrawnMesh> meshes{{"moving", scene.held}};
  for (std::size_t entry = 0;; ++entry) {
    const std::string role = fmt::format("mover_{}", entry);
    const auto first = result.integer_attribute("/scene/" + role, "first_mover");
    if (!first) break;
    const auto mover =
        std::ranges::find(result_scene.motion.movers->number, static_cast<std::size_t>(*first));
    meshes.push_back({role, static_cast<std::size_t>(mover - result_scene.motion.movers->number.begin())});
  }
  for (const std::size_t i : drawn_bodies(scene, tracks))
    meshes.push_back({fmt::format("fixed_{}", i), scene.mover_count() + i});
  if (const SceneDeformation* deformation = result_scene.motion.deformation.get())
    for (DrawnMesh& mesh : meshes) mesh.deforms = deformation->find(scene.body(mesh.object).get()) != nullptr;
  return meshes;
}

/// A triangle mesh each; deforming ones also with every frame's vertices, in single precision.
void write_meshes(const std::vector<DrawnMesh>& meshes, const ResultScene& result_scene,
                  const std::vector<std::size_t>& frames, const std::filesystem::path& folder) {
  for (const DrawnMesh& mesh : meshes) write_off(folder / (mesh.role + ".off"), mesh.in(result_scene.rest));
  std::map<std::string, std::string> shapes;
  SceneFrames bodies(result_scene.rest, result_scene.motion);
  for (const std::size_t frame : frames) {
    bodies.to_frame(static_cast<std::int64_t>(frame));
    for (const DrawnMesh& mesh : meshes) {
      if (!mesh.deforms) continue;
      std::string& own = shapes[mesh.role];
      for (const Vec3& vertex : mesh.in(bodies.scene()).vertices) {
        const Eigen::Vector3f single = vertex.cast<float>();
        own.append(reinterpret_cast<const char*>(single.data()), sizeof(float) * 3);
      }
    }
  }
  for (const auto& [role, bytes] : shapes) write_file_atomically(folder / (role + ".shapes"), bytes);
}

}  // namespace

void write_report_scene(const ResultReader& result, const std::filesystem::path& folder) {
  const ResultScene result_scene = scene_of_result(result);
  const Scene& scene = result_scene.rest;
  std::size_t frames = MOST_FRAMES;
  if (result_scene.motion.movers)
    frames = std::clamp<std::size_t>(MOST_MOVER_POSES / scene.mover_count(), 1, frames);
  std::size_t vertices = 0;
  for (const DrawnMesh& mesh : drawn_meshes(result, result_scene, tracks_of_result(result, 1)))
    if (mesh.deforms) vertices += scene.body(mesh.object)->surface().mesh.vertices.size();
  if (vertices > 0) frames = std::clamp<std::size_t>(MOST_SHAPE_VERTICES / vertices, 1, frames);
  const std::vector<ResultTrack> tracks = tracks_of_result(result, frames);
  write_meshes(drawn_meshes(result, result_scene, tracks), result_scene, tracks.front().frames, folder);

  SceneFrames bodies(scene, result_scene.motion);
  const std::unique_ptr<Method> method = exact_method(bodies.scene());
  std::string lines;
  for (const ResultTrack& track : tracks)
    for (std::size_t i = 0; i < track.poses.size(); ++i) {
      bodies.to_frame(static_cast<std::int64_t>(track.frames[i]));
      const std::string line =
          query_json(query(*method, track.poses[i].pose, scene.cutoff, track.poses[i].time));
      lines += fmt::format("{{\"frame\":{},\"track\":{},{}\n", track.frames[i],
                           nlohmann::json(track.method).dump(), std::string_view(line).substr(1));
    }
  write_file_atomically(folder / "lmds.jsonl", lines);
}

}  // namespace lmdbench
