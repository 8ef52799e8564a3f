// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/motion/grazing.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/mesh_scene.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/phantom/device.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/load_body.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/prepare/prepare_movers.h>
#include <lmdbench/prepare/there_and_back.h>
#include <lmdbench/snch/hierarchy.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <utility>

namespace lmdbench {
namespace {

/// Of the diagonal: vertices this little before a face are in its plane, as rounding leaves them.
constexpr double CONVEX_TOLERANCE = 1e-7;
constexpr std::size_t MOST_CONVEX_TRIANGLES = 2000;
/// Of a made path's poses every so many are looked at for their contacts.
constexpr std::size_t CONTACT_STRIDE = 5;

Path load_frames(const Experiment& experiment, std::vector<InputFile>& files,
                 std::vector<RecordingGap>& gaps) {
  const FileContent content = read_input_file(experiment.path_file, {.what = "path"});
  const PathInterpolator path(parse_tum(content.bytes, experiment.path_file.string()),
                              experiment.interpolation, experiment.gap_intervals);
  gaps = path.gaps();
  files.push_back(
      {"path", experiment.path_file, content.sha256, static_cast<std::int64_t>(content.bytes.size())});
  // A path that is cut by "frames" may be longer than any run.
  std::optional<std::size_t> wanted;
  if (experiment.frames) wanted = static_cast<std::size_t>(*experiment.frames);
  refuse_too_many_frames(path, experiment.frame_rate_hz, wanted, experiment.path_file.string());
  return resample(path, experiment.frame_rate_hz, wanted);
}

/// The path there and back until the run is over.
void lengthen(std::vector<Pose>& poses, std::vector<double>& times, double frame_rate_hz, double seconds) {
  const auto wanted = static_cast<std::size_t>(std::llround(seconds * frame_rate_hz)) + 1;
  there_and_back(poses, wanted);
  times.resize(poses.size());
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / frame_rate_hz;
}

/// Diagonal of the smallest mesh [m].
double least_diagonal(const Scene& scene) {
  double least = bounding_box_diagonal(scene.moving->surface().mesh);
  for (const auto& fixed : scene.fixed) least = std::min(least, bounding_box_diagonal(fixed->surface().mesh));
  return least;
}

/// Every vertex lies behind every face. Two such meshes have at most one LMD. Of large meshes nobody asks: no.
bool is_convex(const Surface& surface) {
  if (surface.mesh.triangles.size() > MOST_CONVEX_TRIANGLES) return false;
  const double slack = CONVEX_TOLERANCE * bounding_box_diagonal(surface.mesh);
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const Vec3 corner = surface.mesh.triangle(static_cast<std::int32_t>(t))[0];
    for (const Vec3& vertex : surface.mesh.vertices)
      if (surface.face_normals[t].dot(vertex - corner) > slack) return false;
  }
  return true;
}

/// LMDs in the median frame of those in contact.
double median_contacts(const Scene& scene, const Path& path) {
  const std::unique_ptr<Method> method = make_method("certified", scene);
  std::vector<double> counts;
  LmdSet lmds;
  WorkCounters ignored;
  for (std::size_t i = 0; i < path.size(); i += CONTACT_STRIDE) {
    lmds.clear();
    method->search(path[i].pose, lmds, ignored);
    if (!lmds.empty()) counts.push_back(static_cast<double>(lmds.size()));
  }
  return counts.empty() ? 0.0 : median(counts);
}

/// A path for a scene that has none.
GrazingPath make_path(const Experiment& experiment, const Scene& scene, const Progress& progress) {
  const double smallest = least_diagonal(scene);
  if (scene.cutoff > smallest)
    throw UsageError(experiment.file.string(), "/force/cutoff_m",
                     fmt::format("the cutoff of {:.4g} m is larger than the smallest mesh, {:.4g} m: all of "
                                 "it would be in contact "
                                 "everywhere, and no path grazes",
                                 scene.cutoff, smallest),
                     fmt::format("give a cutoff in metres, of a hundredth of the mesh or so ({:.3g}), or "
                                 "leave it out; check scale",
                                 0.01 * smallest));
  TriangleMesh fixed;  // all of them as one
  for (const auto& body : scene.fixed) {
    const TriangleMesh mesh = placed_mesh(body);
    const auto first = static_cast<std::int32_t>(fixed.vertices.size());
    fixed.vertices.insert(fixed.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& corners : mesh.triangles)
      fixed.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
  }
  const bool one_contact = scene.fixed.size() == 1 && is_convex(scene.moving->surface()) &&
                           is_convex(scene.fixed.front()->surface());
  return rich_grazing_path(
      mesh_scene(scene.moving->surface().mesh, std::move(fixed)), scene.cutoff, experiment.frame_rate_hz,
      [&](const Path& path) { return one_contact ? RICH_CONTACTS : median_contacts(scene, path); },
      [&](std::size_t done, std::size_t all) { tell_progress(progress, done, all); });
}

DefaultNote note_of(const GrazingPath& made, double cutoff) {
  return {"/path/file",
          fmt::format("a path of {:g} s that is made (seed {}, smallest gap {:.3g} m)", made.spec.duration(),
                      made.spec.seed, made.smallest_gap),
          fmt::format(
              "slides and turns at {:g} to {:g} cutoffs of {:g} m; `lmdbench init` writes one for editing",
              GRAZING_GAPS_IN_CUTOFFS[1].gap, GRAZING_GAPS_IN_CUTOFFS[2].gap, cutoff)};
}

Path frames_of(const GrazingPath& made, const Experiment& experiment, std::vector<InputFile>& files) {
  const std::string text = tum_text(made.path);
  files.push_back({"path", "", sha256_of_text(text), static_cast<std::int64_t>(text.size())});
  std::optional<std::size_t> wanted;
  if (experiment.frames) wanted = static_cast<std::size_t>(*experiment.frames);
  return resample(PathInterpolator(made.path, experiment.interpolation), experiment.frame_rate_hz, wanted);
}

ForceProfile profile_for(const ForceChoice& force, double cutoff, const std::string& place,
                         const Experiment& experiment) {
  ForceProfile profile;
  profile.cutoff = cutoff;
  profile.saturation_distance = force.saturation(cutoff);
  profile.maximum_force = force.maximum_force_n;
  profile.sharpness = force.sharpness;
  if (force.clip_at_maximum) profile.largest_sum = force.maximum_force_n;
  // Loading could only compare two lengths; here a share of the mesh's diagonal has become one.
  if (!(profile.saturation_distance < profile.cutoff))
    throw UsageError(experiment.file.string(), place + "/saturation_m",
                     fmt::format("saturation at {} m is not below the cutoff of {} m",
                                 profile.saturation_distance, profile.cutoff),
                     "saturate nearer than the cutoff");
  return profile;
}

/// What every run needs of each mesh, side by side where the meshes are large enough for threads.
void prepare_hierarchies(const Scene& scene) {
  constexpr std::size_t WORTH_A_THREAD = 2048;  // triangles
  const auto large = [](const FixedBody& body) {
    return body->surface().mesh.triangles.size() >= WORTH_A_THREAD;
  };
  if (!large(scene.moving) || std::none_of(scene.fixed.begin(), scene.fixed.end(), large)) return;
  parallel_for(scene.fixed.size() + 1,
               [&](std::size_t i) { (i == 0 ? scene.moving : scene.fixed[i - 1])->prepared<Hierarchy>(); });
}

/// The mesh of an entry; one that the moving mesh is or an earlier entry has is read and prepared once.
std::shared_ptr<const Body> fixed_body(const Experiment& experiment, std::size_t entry, const Scene& scene,
                                       std::vector<MeshNote>& notes) {
  const MeshChoice& choice = experiment.fixed[entry];
  const std::string role = fmt::format("fixed_{}", entry);
  const bool in_own_frame = stands_in_own_frame(experiment, entry);
  if (allowed(experiment.rules, Rule::SHARED_MESH)) {
    const auto share = [&](const std::shared_ptr<const Body>& body, MeshNote note) {
      note.role = role;
      note.instances.clear();
      notes.push_back(std::move(note));
      return body;
    };
    if (const std::optional<std::size_t> earlier = earlier_body(experiment, entry)) {
      const MeshNote& note = notes[1 + *earlier];
      return share(scene.fixed[static_cast<std::size_t>(note.first_fixed_body)].body, note);
    }
    if (same_body(experiment, entry) || (in_own_frame && same_mesh(experiment.moving, choice)))
      return share(scene.moving, notes.front());
  }
  return load_body(choice, role, experiment, in_own_frame ? std::nullopt : std::optional(choice.pose), notes);
}

}  // namespace

Scene load_scene(const Experiment& experiment, std::vector<MeshNote>& notes) {
  Scene scene;
  scene.moving = load_body(experiment.moving, "moving", experiment, std::nullopt, notes);
  for (std::size_t i = 0; i < experiment.fixed.size(); ++i) {
    const MeshChoice& choice = experiment.fixed[i];
    const std::shared_ptr<const Body> body = fixed_body(experiment, i, scene, notes);
    notes.back().first_fixed_body = static_cast<std::int64_t>(scene.fixed.size());
    if (!choice.instances) {
      scene.fixed.emplace_back(body, stands_in_own_frame(experiment, i) ? choice.pose : Pose{});
      continue;
    }
    for (const Pose& pose : instance_poses(*choice.instances, body->prepared<MeshBounds>())) {
      notes.back().instances.push_back(choice.pose * pose);
      scene.fixed.emplace_back(body, notes.back().instances.back());
    }
  }
  return scene;
}

namespace {

/// What deforming does to triangles, and what follows meshes that deform.
void warn_of_deformation(PreparedRun& prepared) {
  if (!prepared.input.motion.deformation) return;
  for (const MeshNote& note : prepared.meshes) {
    if (!note.vertices) continue;
    const std::vector<DeformationStep>& steps =
        prepared.input.motion.deformation->find(note.body.get())->steps;
    const auto warn = [&](const char* what, std::int64_t DeformationStep::*count,
                          std::int32_t DeformationStep::*first) {
      std::int64_t all = 0, frames = 0;
      std::string where;
      for (std::size_t frame = 0; frame < steps.size(); ++frame) {
        if (steps[frame].*count == 0) continue;
        if (frames++ == 0) where = fmt::format("triangle {} in frame {}", steps[frame].*first, frame);
        all += steps[frame].*count;
      }
      if (all > 0)
        prepared.warnings.emplace_back(fmt::format(
            "{} mesh {}: as it deforms, triangles {} {} times, in {} of {} frames, first {}; the mesh "
            "is taken as its vertices say",
            note.role, note.name, what, all, frames, steps.size(), where));
    };
    warn("turn over", &DeformationStep::turned_over, &DeformationStep::first_turned_over);
    warn("lose their area", &DeformationStep::lost_area, &DeformationStep::first_lost_area);
  }
  if (prepared.made_path)
    prepared.warnings.emplace_back(
        "the path is made for the meshes at rest: as they deform they may intersect, or not meet");
}

/// What an aggregation other than the sum cannot keep to.
void warn_of_aggregation(const Experiment& experiment, PreparedRun& prepared) {
  bool asks_indices = false;
  for (const MethodChoice& method : experiment.methods) {
    const Aggregation& wanted = *experiment.profiles[method.profile].aggregation;
    asks_indices = asks_indices || method.aggregation->needs != AggregationNeeds::MINIMA;
    if (method.aggregation != &wanted)
      prepared.warnings.push_back(
          fmt::format("method {} finds no saddles, which the aggregation \"{}\" needs: its LMDs are summed, "
                      "and its force errors "
                      "are against the force that was asked for",
                      method.label, wanted.name));
  }
  for (const MeshNote& note : prepared.meshes)
    if (asks_indices && !(note.report.closed && note.report.manifold))
      prepared.warnings.push_back(
          fmt::format("{} mesh {}: LMDs at its {} boundary edges and {} edges and vertices that are not "
                      "manifold have no index: "
                      "where one is born or dies the force may jump",
                      note.role, note.name, note.report.boundary_edges,
                      note.report.non_manifold_edges + note.report.non_manifold_vertices));
}

/// Of the methods from outside that the experiment names.
std::set<std::filesystem::path> plugin_files(const Experiment& experiment) {
  std::set<std::filesystem::path> files;
  for (const MethodChoice& choice : experiment.methods) files.insert(method_description(choice.name).plugin);
  files.erase(std::filesystem::path());
  return files;
}

}  // namespace

std::shared_ptr<const SceneDeformation> deformation_of(const std::vector<MeshNote>& notes,
                                                       std::int64_t frames) {
  std::vector<DeformingBody> bodies;
  for (const MeshNote& note : notes)
    if (note.vertices) bodies.push_back({note.body, note.vertices});
  if (bodies.empty()) return nullptr;
  return std::make_shared<const SceneDeformation>(std::move(bodies), frames);
}

PreparedRun prepare(const Experiment& experiment, const Progress& progress, Deforming deforming) {
  if (deforming == Deforming::REFUSED) {
    refuse_deformation(experiment);
    refuse_movers(experiment);
  }
  const Device& device = device_named(experiment.device, experiment.file.string(), "/device");
  std::vector<InputFile> files;
  Path frames;
  std::vector<RecordingGap> gaps;
  if (!experiment.path_file.empty()) frames = load_frames(experiment, files, gaps);

  for (const std::filesystem::path& plugin : plugin_files(experiment))
    files.push_back({"plugin:" + plugin.filename().string(), plugin, sha256_of_file(plugin),
                     static_cast<std::int64_t>(std::filesystem::file_size(plugin))});

  std::vector<MeshNote> notes;
  const Scene scene = load_scene(experiment, notes);
  const LoadedMovers movers = load_movers(experiment, scene, notes);
  std::vector<PreparedProfile> profiles;
  std::vector<DefaultNote> defaults = experiment.defaults;
  std::optional<double> open_cutoff;  // of profiles that give none
  for (std::size_t i = 0; i < experiment.profiles.size(); ++i) {
    const ForceChoice& choice = experiment.profiles[i];
    const std::string place = choice.name.empty() ? "/force" : fmt::format("/force/{}", i);
    std::optional<double> cutoff = choice.cutoff(notes.front().report.diagonal);
    if (!cutoff) {
      if (!open_cutoff) open_cutoff = default_cutoff(with_movers(scene, movers), defaults);
      cutoff = open_cutoff;
    }
    profiles.push_back(
        {choice.name, profile_for(choice, *cutoff, place, experiment), scene, choice.aggregation});
    profiles.back().scene.cutoff = profiles.back().force.cutoff;
  }
  std::optional<GrazingPath> made_path;
  if (frames.empty()) {
    // Near enough for every profile.
    const auto hardest = std::min_element(
        profiles.begin(), profiles.end(),
        [](const PreparedProfile& a, const PreparedProfile& b) { return a.force.cutoff < b.force.cutoff; });
    made_path = make_path(experiment, hardest->scene, progress);
    frames = frames_of(*made_path, experiment, files);
    defaults.push_back(note_of(*made_path, hardest->force.cutoff));
  }

  std::vector<Pose> poses;
  std::vector<double> times;
  for (const TimedPose& frame : frames) {
    poses.push_back(frame.pose);
    times.push_back(frame.time);
  }
  if (experiment.realtime && experiment.realtime->seconds)
    lengthen(poses, times, experiment.frame_rate_hz, *experiment.realtime->seconds);
  std::vector<std::string> warnings;
  const SceneMotion motion{play_of(experiment, movers, poses, frames.size(), files, warnings),
                           deformation_of(notes, static_cast<std::int64_t>(poses.size()))};
  for (PreparedProfile& profile : profiles)
    if (motion.movers) profile.scene = motion.movers->with_movers(profile.scene);
  PreparedRun prepared{.profiles = std::move(profiles),
                       .input = {.poses = std::move(poses),
                                 .frame_rate_hz = experiment.frame_rate_hz,
                                 .loop = experiment.loop,
                                 .make_poses = {},
                                 .frames = std::nullopt,
                                 .reference_M = Vec3::Zero(),
                                 .device = VirtualPhantom(device),
                                 .keep_lmds = {},
                                 .motion = motion},
                       .times = std::move(times),
                       .meshes = std::move(notes),
                       .files = std::move(files),
                       .starts_touching = false,
                       .warnings = std::move(warnings),
                       .path_gaps = std::move(gaps),
                       .made_path = std::move(made_path),
                       .defaults = std::move(defaults)};
  prepared.input.reference_M = bounding_box_centre(prepared.scene().moving->surface().mesh);
  warn_of_deformation(prepared);
  for (const MeshNote& note : prepared.meshes) {
    const bool listed = std::any_of(prepared.files.begin(), prepared.files.end(), [&](const InputFile& file) {
      return file.role == "mesh:" + note.name && file.sha256 == note.sha256;
    });
    if (note.file && !listed)
      prepared.files.push_back({"mesh:" + note.name, *note.file, note.sha256, note.size});
    if (note.vertices && !note.vertices->sha256().empty())
      prepared.files.push_back({"vertices:" + note.role, vertex_files(note.vertices->deformation()).front(),
                                note.vertices->sha256(), note.vertices->file_bytes()});
    if (const std::size_t coincident = count_coincident(note.instances); coincident > 0)
      prepared.warnings.emplace_back(fmt::format(
          "{} mesh {}: {} of {} instances are just where an earlier one is: each of their LMDs is "
          "there once an instance",
          note.role, note.name, coincident, note.instances.size()));
    // What there is to say of a mesh is said once.
    if (const auto index = static_cast<std::size_t>(&note - &prepared.meshes.front());
        note.role.starts_with("fixed_") && earlier_body(experiment, index - 1))
      continue;
    if (note.flattening.moved_vertices > 0)
      prepared.warnings.emplace_back(
          fmt::format("{} mesh {}: {}", note.role, note.name, to_text(note.flattening)));
    if (note.orientation.choice == OrientationChoice::OUTWARD)
      prepared.warnings.emplace_back(
          fmt::format("{} mesh {}: {}", note.role, note.name, to_text(note.orientation)));
    for (const std::string& finding : findings(note.report))
      prepared.warnings.emplace_back(fmt::format("{} mesh {}: {}", note.role, note.name, finding));
  }
  warn_of_aggregation(experiment, prepared);
  prepare_hierarchies(prepared.scene());
  prepared.starts_touching =
      SceneDistance(prepared.scene(), motion).at(0, prepared.input.poses.front(), prepared.scene().cutoff) ==
      0.0;
  if (prepared.starts_touching)
    prepared.warnings.emplace_back(
        "the meshes touch in the first frame: LMDs at distance 0 have no direction there and exert no force "
        "until they "
        "have been apart");
  return prepared;
}

void hold_first_frame(PreparedRun& prepared) {
  for (PreparedProfile& profile : prepared.profiles) {
    SceneFrames first(profile.scene, prepared.input.motion);
    first.to_frame(0);
    profile.scene = first.scene();
  }
  prepared.input.motion = {};
}

std::vector<std::filesystem::path> input_files(const Experiment& experiment) {
  const std::filesystem::path folder = experiment.file.parent_path();
  std::vector<std::filesystem::path> files{experiment.file, experiment.mesh_folder / "manifest.json"};
  if (!experiment.path_file.empty()) files.push_back(experiment.path_file);
  for (const std::filesystem::path& plugin : plugin_files(experiment)) files.push_back(plugin);
  const auto add = [&](const MeshChoice& choice) {
    if (choice.instances && !choice.instances->file.empty()) files.push_back(choice.instances->file);
    files.push_back(is_mesh_name(choice.mesh) ? built_mesh_file(experiment.mesh_folder, choice.mesh)
                                              : folder / choice.mesh);
    if (!choice.deformation) return;
    std::error_code none;  // A folder that is not there has no file; loading it says so.
    if (!choice.deformation->folder.empty() &&
        !std::filesystem::is_directory(choice.deformation->folder, none))
      return;
    for (const std::filesystem::path& file : vertex_files(*choice.deformation)) files.push_back(file);
  };
  add(experiment.moving);
  for (const MeshChoice& choice : experiment.fixed) add(choice);
  for (const MoverChoice& mover : experiment.movers) {
    add(mover.mesh);
    if (!mover.path_file.empty()) files.push_back(mover.path_file);
  }
  return files;
}

std::vector<DrivenMethod> driven_methods(const Experiment& experiment, const PreparedRun& prepared) {
  std::vector<DrivenMethod> methods;
  for (const MethodChoice& choice : experiment.methods) {
    const PreparedProfile& profile = prepared.profiles[choice.profile];
    ForceProfile force = profile.force;
    force.law = choice.force_law;
    const auto make_on = [name = choice.name, options = choice.options](const Scene& scene) {
      return make_method(name, scene, options);
    };
    methods.push_back({choice.label, [make_on, scene = profile.scene] { return make_on(scene); }, force,
                       choice.aggregation, profile.scene, make_on});
  }
  return methods;
}

}  // namespace lmdbench
