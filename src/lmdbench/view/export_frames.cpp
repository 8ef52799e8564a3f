// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/methods/query.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/result/sized_datasets.h>
#include <lmdbench/result_file/vtu_file.h>
#include <lmdbench/view/export_frames.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <regex>
#include <set>
#include <utility>

namespace lmdbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* FEATURE_OF = "feature of {} (0 vertex, 1 edge, 2 face)";

bool is_vtk(const fs::path& file) {
  return file_begins_with(file, "<?xml version=\"1.0\"?>\n<VTKFile ");
}

/// Whether an export gives such names, to a file or to a frame in the folder of a series.
bool is_export_name(const fs::path& file) {
  static const std::regex NAMES(
      "(movers|moving|lmds|forces|polylines|fixed_[0-9]+)(-.*)?\\.pvd|fixed_[0-9]+\\.vtu");
  return std::regex_match(file.filename().string(), NAMES) && is_vtk(file);
}
bool is_frame_name(const fs::path& file) {
  static const std::regex NAMES("[0-9]{6,}\\.vtu"),
      LEFT_BY_A_KILL("\\.[0-9]{6,}\\.vtu\\.[0-9]+-[0-9]+\\.part");
  const std::string name = file.filename().string();
  return (std::regex_match(name, NAMES) && is_vtk(file)) || std::regex_match(name, LEFT_BY_A_KILL);
}

/// Writes into the requested folder, and replaces earlier exports only.
class Exporter {
 public:
  Exporter(fs::path input, fs::path folder) : input_(std::move(input)), folder_(std::move(folder)) {}

  void write(const fs::path& name, const std::string& text) {
    const fs::path file = folder_ / name;
    refuse_unsafe_output(file, {"VTK file", &is_vtk}, {input_}, "--out");
    write_file_atomically(file, text);
    files_.insert(file);
  }
  void write_top(const fs::path& name, const std::string& text) {
    write(name, text);
    written_.push_back(folder_ / name);
  }
  const std::vector<fs::path>& written() const { return written_; }

  /// Removes what an earlier export left and this one has not written: two results in one folder
  /// would be shown as one.
  void remove_stale() const {
    for (const fs::path& file : listed(folder_)) {
      if (!is_export_name(file)) continue;
      const fs::path series = folder_ / file.stem();
      if (file.extension() == ".pvd" && fs::is_directory(fs::symlink_status(series))) {
        for (const fs::path& frame : listed(series))
          if (is_frame_name(frame)) remove_unless_written(frame);
        std::error_code not_empty;
        fs::remove(series, not_empty);
      }
      remove_unless_written(file);
    }
  }

  /// The name of a series: "lmds-TRACK", or "lmds-of-TRACK" where a label has taken that.
  std::string series_name(const std::string& what, const std::string& track) {
    std::string name = what + (track.empty() ? "" : "-" + track);
    for (std::string prefix = what + "-of-"; !series_.insert(name).second; prefix += "of-")
      name = prefix + track;
    return name;
  }

 private:
  static std::vector<fs::path> listed(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    return files;
  }
  void remove_unless_written(const fs::path& file) const {
    std::error_code ignored;  // of somebody else, or gone
    if (!files_.contains(file)) fs::remove(file, ignored);
  }

  fs::path input_, folder_;
  std::vector<fs::path> written_;
  std::set<fs::path> files_;
  std::set<std::string> series_;
};

/// A collection over time: one file a frame.
class Series {
 public:
  Series(Exporter& exporter, const std::string& what, const std::string& track)
      : exporter_(exporter), name_(exporter.series_name(what, track)) {}

  void add(double time, std::size_t frame, const VtuGrid& grid) {
    const std::string file = fmt::format("{}/{:06}.vtu", name_, frame);
    exporter_.write(file, vtu_text(grid));
    files_.emplace_back(time, file);
  }
  void finish() { exporter_.write_top(name_ + ".pvd", pvd_text(files_)); }

 private:
  Exporter& exporter_;
  std::string name_;
  std::vector<std::pair<double, std::string>> files_;
};

VtuGrid mesh_grid(const TriangleMesh& mesh, const RigidTransform& X_WM) {
  VtuGrid grid;
  grid.cell = VtuCell::TRIANGLE;
  for (const Vec3& vertex : mesh.vertices) grid.points.push_back(X_WM.point(vertex));
  for (const auto& triangle : mesh.triangles) {
    grid.corners.insert(grid.corners.end(), triangle.begin(), triangle.end());
    grid.ends.push_back(static_cast<std::int32_t>(grid.corners.size()));
  }
  return grid;
}

VtuGrid empty_lmd_grid() {
  VtuGrid grid;
  grid.cell = VtuCell::POLYLINE;
  grid.cell_data = {{"distance [m]", 1, {}},
                    {fmt::format(fmt::runtime(FEATURE_OF), "moving"), 1, {}},
                    {fmt::format(fmt::runtime(FEATURE_OF), "fixed"), 1, {}}};
  return grid;
}

void add_lmd(VtuGrid& grid, const Vec3& point_moving, const Vec3& point_fixed, double distance,
             double kind_moving, double kind_fixed) {
  grid.add({point_moving, point_fixed});
  grid.cell_data[0].values.push_back(distance);
  grid.cell_data[1].values.push_back(kind_moving);
  grid.cell_data[2].values.push_back(kind_fixed);
}

Vec3 row(const std::vector<double>& values, std::size_t index) {
  return {values[3 * index], values[3 * index + 1], values[3 * index + 2]};
}

/// A method's LMD lists, as recorded by the run.
struct RecordedLmds {
  std::vector<std::size_t> offset;
  std::vector<std::int64_t> kind_moving, kind_fixed;
  std::vector<double> distance, point_moving, point_fixed;

  RecordedLmds(const ResultReader& result, const std::string& group, std::size_t frames)
      : offset(list_offsets(result, group + "/frame_offset", frames)),
        kind_moving(integers_of_size(result, group + "/feature_moving_kind", offset.back())),
        kind_fixed(integers_of_size(result, group + "/feature_fixed_kind", offset.back())),
        distance(finite_reals_of_size(result, group + "/distance", offset.back())),
        point_moving(finite_reals_of_size(result, group + "/point_moving", 3 * offset.back())),
        point_fixed(finite_reals_of_size(result, group + "/point_fixed", 3 * offset.back())) {}

  VtuGrid grid(std::size_t frame) const {
    VtuGrid grid = empty_lmd_grid();
    for (std::size_t i = offset[frame]; i < offset[frame + 1]; ++i)
      add_lmd(grid, row(point_moving, i), row(point_fixed, i), distance[i],
              static_cast<double>(kind_moving[i]), static_cast<double>(kind_fixed[i]));
    return grid;
  }
};

/// Exports the recorded LMD lists.
void export_recorded(Exporter& exporter, const ResultReader& result, const std::vector<std::string>& labels,
                     const ResultTrack& track, std::size_t frames) {
  for (const std::string& label : labels) {
    const std::string group = "/methods/" + label + "/lmds";
    if (!result.has(group + "/frame_offset")) continue;
    const RecordedLmds recorded(result, group, frames);
    Series series(exporter, "lmds", label);
    for (std::size_t i = 0; i < track.frames.size(); ++i)
      series.add(track.poses[i].time, track.frames[i], recorded.grid(track.frames[i]));
    series.finish();
  }
}

/// The fixed meshes: once, or in each frame where they deform.
void export_fixed(Exporter& exporter, const ResultScene& result_scene,
                  const std::vector<ResultTrack>& tracks) {
  const SceneDeformation* deformation = result_scene.motion.deformation.get();
  for (const std::size_t i : drawn_bodies(result_scene.rest, tracks)) {
    const std::string name = fmt::format("fixed_{}", i);
    if (deformation == nullptr || deformation->find(result_scene.rest.fixed[i].body.get()) == nullptr) {
      exporter.write_top(name + ".vtu", vtu_text(mesh_grid(placed_mesh(result_scene.rest.fixed[i]), {})));
      continue;
    }
    SceneFrames bodies(result_scene.rest, result_scene.motion);
    for (const ResultTrack& track : tracks) {
      Series series(exporter, name, track.method);
      for (std::size_t k = 0; k < track.frames.size(); ++k) {
        bodies.to_frame(static_cast<std::int64_t>(track.frames[k]));
        series.add(track.poses[k].time, track.frames[k], mesh_grid(placed_mesh(bodies.scene().fixed[i]), {}));
      }
      series.finish();
    }
  }
}

void export_track(Exporter& exporter, const ResultReader& result, const ResultScene& result_scene,
                  const ResultTrack& track) {
  SceneFrames bodies(result_scene.rest, result_scene.motion);
  const Scene& scene = bodies.scene();
  const std::vector<std::string> labels =
      track.method.empty() ? result.groups("/methods") : std::vector<std::string>{track.method};
  const TriangleMesh& mesh = scene.moving->surface().mesh;
  const std::unique_ptr<Method> exact = exact_method(scene);
  Series moving(exporter, "moving", track.method), lmds(exporter, "lmds-exact", track.method),
      forces(exporter, "forces", track.method);
  std::vector<std::vector<double>> force_of;
  for (const std::string& label : labels)
    force_of.push_back(finite_reals_of_size(result, "/methods/" + label + "/force", 3 * result_scene.frames));
  for (std::size_t i = 0; i < track.frames.size(); ++i) {
    const auto& [time, pose] = track.poses[i];
    const std::size_t frame = track.frames[i];
    const RigidTransform transform(pose);
    bodies.to_frame(static_cast<std::int64_t>(frame));
    moving.add(time, frame, mesh_grid(mesh, transform));
    VtuGrid pairs = empty_lmd_grid();
    for (const Lmd& lmd : query(*exact, track.poses[i].pose, scene.cutoff).lmds)
      add_lmd(pairs, lmd.point_moving, lmd.point_fixed, lmd.distance,
              static_cast<double>(lmd.feature_moving.kind), static_cast<double>(lmd.feature_fixed.kind));
    lmds.add(time, frame, pairs);
    VtuGrid middle;
    middle.add({transform.point(bounding_box_centre(mesh))});
    for (std::size_t m = 0; m < labels.size(); ++m) {
      const Vec3 force = row(force_of[m], frame);
      middle.point_data.push_back({"force of " + labels[m] + " [N]", 3, {force.x(), force.y(), force.z()}});
    }
    forces.add(time, frame, middle);
  }
  for (Series* series : {&moving, &lmds, &forces}) series->finish();
  export_recorded(exporter, result, labels, track, result_scene.frames);
}

/// Meshes, exact LMDs and forces of several movers, each with its number.
void export_movers(Exporter& exporter, const ResultReader& result, const ResultScene& result_scene,
                   const ResultTrack& track) {
  const MoverPlay& play = *result_scene.motion.movers;
  SceneFrames frames(result_scene.rest, result_scene.motion);
  const Scene& scene = frames.scene();
  const std::unique_ptr<Method> exact = exact_method(scene);
  const std::vector<std::string> labels =
      track.method.empty() ? result.groups("/methods") : std::vector<std::string>{track.method};
  // A run on the clock renders only the held object's force.
  const bool all_feel = std::ranges::all_of(
      labels, [&](const std::string& label) { return result.has("/methods/" + label + "/movers/force"); });
  const std::size_t felt = all_feel ? play.count() : 1;
  std::vector<std::vector<double>> force_of;
  for (const std::string& label : labels)
    force_of.push_back(finite_reals_of_size(result,
                                            "/methods/" + label + (all_feel ? "/movers/force" : "/force"),
                                            3 * felt * result_scene.frames));
  Series movers(exporter, "movers", track.method), lmds(exporter, "lmds-movers", track.method),
      forces(exporter, "forces-movers", track.method);
  for (std::size_t i = 0; i < track.frames.size(); ++i) {
    const std::size_t frame = track.frames[i];
    const auto& [time, pose] = track.poses[i];
    frames.to_frame(static_cast<std::int64_t>(frame));
    VtuGrid meshes, middles, pairs = empty_lmd_grid();
    meshes.cell = VtuCell::TRIANGLE;
    meshes.cell_data = {{"mover", 1, {}}};
    middles.point_data = {{"mover", 1, {}}};
    for (const std::string& label : labels)
      middles.point_data.push_back({"force of " + label + " [N]", 3, {}});
    for (std::size_t m = 0; m < play.count(); ++m) {
      const RigidTransform X_WM(scene.pose(m, pose));
      const VtuGrid mesh = mesh_grid(scene.body(m)->surface().mesh, X_WM);
      const auto first = static_cast<std::int32_t>(meshes.points.size()),
                 ends = static_cast<std::int32_t>(meshes.corners.size());
      meshes.points.insert(meshes.points.end(), mesh.points.begin(), mesh.points.end());
      for (const std::int32_t corner : mesh.corners) meshes.corners.push_back(first + corner);
      for (const std::int32_t end : mesh.ends) meshes.ends.push_back(ends + end);
      meshes.cell_data[0].values.insert(meshes.cell_data[0].values.end(), mesh.ends.size(),
                                        static_cast<double>(play.number[m]));
      if (!all_feel && m != play.moving()) continue;
      middles.add({X_WM.point(play.references_M[m])});
      middles.point_data[0].values.push_back(static_cast<double>(play.number[m]));
      for (std::size_t l = 0; l < labels.size(); ++l) {
        const Vec3 force = row(force_of[l], all_feel ? frame * felt + play.number[m] : frame);
        middles.point_data[l + 1].values.insert(middles.point_data[l + 1].values.end(), force.begin(),
                                                force.end());
      }
    }
    const LmdSet set = lmds_at(*exact, pose);
    for (const Lmd& lmd : set)
      add_lmd(pairs, lmd.point_moving, lmd.point_fixed, lmd.distance,
              static_cast<double>(lmd.feature_moving.kind), static_cast<double>(lmd.feature_fixed.kind));
    movers.add(time, frame, meshes);
    lmds.add(time, frame, pairs);
    forces.add(time, frame, middles);
  }
  for (Series* series : {&movers, &lmds, &forces}) series->finish();
  export_recorded(exporter, result, labels, track, result_scene.frames);
}

void export_polylines(Exporter& exporter, const ResultReader& result, const ResultTrack& track) {
  const std::string& method = track.method;
  std::vector<std::string> groups{"/polylines"};
  // Under several profiles each method holds those of its own cutoff, on the same poses.
  for (const std::string& label :
       method.empty() ? result.groups("/methods") : std::vector<std::string>{method})
    groups.push_back("/methods/" + label + "/polylines");
  const auto found =
      std::ranges::find_if(groups, [&](const std::string& group) { return result.has(group + "/frame"); });
  if (found == groups.end()) return;
  const std::string& group = *found;
  const std::vector<std::int64_t> frames = result.integers(group + "/frame");
  const std::vector<std::size_t> lines = list_offsets(result, group + "/frame_offset", frames.size());
  const std::vector<std::size_t> first_point = list_offsets(result, group + "/point_offset", lines.back());
  const std::vector<std::int64_t> closed = integers_of_size(result, group + "/closed", lines.back());
  const std::vector<double> points = finite_reals_of_size(result, group + "/point", 3 * first_point.back());
  const std::vector<double> times = result.reals("/path/time");
  Series series(exporter, "polylines", method);
  const std::size_t most = track.frames.size(), stride = (frames.size() + most - 1) / most;
  for (std::size_t f = 0; f < frames.size(); f += stride) {
    VtuGrid grid;
    grid.cell = VtuCell::POLYLINE;
    for (std::size_t l = lines[f]; l < lines[f + 1]; ++l) {
      std::vector<Vec3> line;
      for (std::size_t p = first_point[l]; p < first_point[l + 1]; ++p) line.push_back(row(points, p));
      if (closed[l] != 0 && !line.empty()) line.push_back(line.front());
      grid.add(line);
    }
    const auto frame = static_cast<std::size_t>(frames[f]);
    if (frame >= times.size())
      throw InputError(result.file().string(), group + "/frame", "names a frame that the path has not",
                       "run the experiment again");
    series.add(times[frame], frame, grid);
  }
  series.finish();
}

}  // namespace

std::vector<fs::path> export_frames(const ResultReader& result, const fs::path& folder,
                                    std::size_t most_frames) {
  refuse_sweep(result);
  refuse_no_folder(folder, "--out");
  for (const std::string& label : result.groups("/methods"))
    if (const std::string force = "/methods/" + label + "/force"; !result.has(force))
      throw InputError(result.file().string(), force, "is missing: the run kept no values of frames",
                       "run the experiment again with --set /record/frames=true");
  const ResultScene result_scene = scene_of_result(result);
  Exporter exporter(result.file(), folder);
  const std::vector<ResultTrack> tracks = tracks_of_result(result, most_frames);
  export_fixed(exporter, result_scene, tracks);
  for (const ResultTrack& track : tracks) {
    if (result_scene.motion.movers)
      export_movers(exporter, result, result_scene, track);
    else
      export_track(exporter, result, result_scene, track);
    export_polylines(exporter, result, track);
  }
  exporter.remove_stale();
  return exporter.written();
}

}  // namespace lmdbench
