// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/motion/mesh_scene.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/prepare/scene_path.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace lmdbench {
namespace {

/// A vertex this little in front of a face is in its plane (rounding), in diagonals.
constexpr double CONVEX_TOLERANCE = 1e-7;
constexpr std::size_t MOST_CONVEX_TRIANGLES = 2000;
/// Every so many poses of a made path are searched for contacts.
constexpr std::size_t CONTACT_STRIDE = 5;

/// Of a mover's first time against the held object's, in frames: rounding of times in files.
constexpr double MOST_SHIFT = 0.01;
/// Movers times frames: bounds memory and result.
constexpr std::size_t MOST_MOVER_POSES = 10000000;

/// @param role of the file in the provenance
FramePath read_path(const ObjectMotion& motion, const std::string& role, double rate,
                    std::optional<std::size_t> wanted) {
  const FileContent content = read_input_file(motion.path_file, {.what = "path"});
  const PathInterpolator path(parse_tum(content.bytes, motion.path_file.string()), motion.interpolation,
                              motion.gap_intervals);
  // A path cut by "frames" may be longer than any run.
  refuse_too_many_frames(path, rate, wanted, motion.path_file.string());
  return {resample(path, rate, wanted),
          {role, motion.path_file, content.sha256, static_cast<std::int64_t>(content.bytes.size())},
          path.gaps(),
          std::nullopt};
}

std::optional<std::size_t> wanted_frames(const Experiment& experiment) {
  return experiment.frames ? std::optional(static_cast<std::size_t>(*experiment.frames)) : std::nullopt;
}

/// Repeats the frames there and back until there are so many.
template <typename Frame>
void there_and_back(std::vector<Frame>& frames, std::size_t wanted) {
  const std::size_t way = frames.size() - 1;
  frames.reserve(wanted);
  for (std::size_t i = frames.size(); i < wanted; ++i) {
    const std::size_t turn = way == 0 ? 0 : i % (2 * way);
    frames.push_back(frames[turn <= way ? turn : 2 * way - turn]);
  }
  frames.resize(wanted);
}

/// Diagonal of the smallest mesh [m].
double least_diagonal(const Scene& scene) {
  double least = scene.moving->diagonal();
  for (const auto& fixed : scene.fixed) least = std::min(least, fixed->diagonal());
  return least;
}

/// Whether every vertex lies behind every face. Such a pair has at most one LMD. Large meshes: no.
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

/// Median number of LMDs of the frames in contact.
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

GrazingPath grazing_path_of(const Experiment& experiment, const Scene& scene, const Progress& progress) {
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
  TriangleMesh fixed;  // all as one
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
      [&](std::size_t done, std::size_t all) { tell_progress(progress, done, all); },
      experiment.file.string());
}

}  // namespace

FramePath read_held_path(const Experiment& experiment) {
  return read_path(experiment.held().motion, "path", experiment.frame_rate_hz, wanted_frames(experiment));
}

FramePath make_path(const Experiment& experiment, const Scene& scene, const Progress& progress) {
  GrazingPath made = grazing_path_of(experiment, scene, progress);
  const std::string text = tum_text(made.path);
  const PathInterpolator path(made.path, experiment.held().motion.interpolation);
  refuse_too_many_frames(path, experiment.frame_rate_hz, wanted_frames(experiment), experiment.file.string());
  Path frames = resample(path, experiment.frame_rate_hz, wanted_frames(experiment));
  return {std::move(frames),
          {"path", "", sha256_of_text(text), static_cast<std::int64_t>(text.size())},
          {},
          std::move(made)};
}

DefaultNote note_of(const GrazingPath& made, double cutoff) {
  return {"/path/file",
          fmt::format("a path of {:g} s that is made (seed {}, smallest gap {:.3g} m)", made.spec.duration(),
                      made.spec.seed, made.smallest_gap),
          fmt::format(
              "slides and turns at {:g} to {:g} cutoffs of {:g} m; `lmdbench init` writes one for editing",
              GRAZING_GAPS_IN_CUTOFFS[1].gap, GRAZING_GAPS_IN_CUTOFFS[2].gap, cutoff)};
}

void lengthen(std::vector<Pose>& poses, std::vector<double>& times, double frame_rate_hz, double seconds,
              const std::string& file) {
  const double frames = seconds * frame_rate_hz;
  if (!(frames < static_cast<double>(limit_of(Limit::FRAMES))))
    throw UsageError(file, "/driver/realtime/seconds",
                     fmt::format("{:.15g} frames at {:g} Hz, above the limit of {}", std::round(frames) + 1.0,
                                 frame_rate_hz, limit_of(Limit::FRAMES)),
                     "ask for less time, or " + raise_remedy(Limit::FRAMES));
  const auto wanted = static_cast<std::size_t>(std::llround(frames)) + 1;
  there_and_back(poses, wanted);
  const double start = times.front();
  times.resize(poses.size());
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = start + static_cast<double>(i) / frame_rate_hz;
}

MoverPoses mover_poses(const Experiment& experiment, const std::vector<Mover>& movers,
                       const std::vector<Pose>& held, const Path& path) {
  MoverPoses result;
  if (movers.size() > MOST_MOVER_POSES / held.size())
    throw UsageError(experiment.file.string(), experiment.objects[movers.back().object].place,
                     fmt::format("{} movers in {} frames: more than {} poses", movers.size(), held.size(),
                                 MOST_MOVER_POSES),
                     "ask for fewer movers or frames");
  std::vector<Pose> read;  // of the current object
  for (const Mover& mover : movers) {
    std::vector<Pose>& own = result.of_mover.emplace_back();
    const ObjectChoice& object = experiment.objects[mover.object];
    if (object.motion.kind == MotionKind::HELD) {
      own = held;
    } else if (object.motion.kind == MotionKind::PATH) {
      if (mover.which == 0) {
        const FramePath its =
            read_path(object.motion, "path:" + object.place.substr(1), experiment.frame_rate_hz, path.size());
        const double start = path.front().time, its_start = its.frames.front().time;
        if (std::abs(its_start - start) * experiment.frame_rate_hz > MOST_SHIFT)
          throw InputError(experiment.file.string(), object.motion.path_place,
                           fmt::format("begins at {:.15g} s, but the path of the held object at {:.15g} s",
                                       its_start, start),
                           "let both begin at one time: cut them or shift their times");
        if (its.frames.size() < path.size())
          throw InputError(
              experiment.file.string(), object.motion.path_place,
              fmt::format("ends after {} frames of the {} that the run has", its.frames.size(), path.size()),
              fmt::format("take a longer path, or run fewer frames (--set /frames={})", its.frames.size()));
        read.clear();
        for (const TimedPose& timed : its.frames) read.push_back(timed.pose);
        there_and_back(read, held.size());
        result.files.push_back(its.file);
        if (!its.gaps.empty())
          result.warnings.push_back(fmt::format("{}: its path has {} gaps, in which the mesh is held",
                                                object.place, its.gaps.size()));
      }
      own = read;
    } else {
      const TriangleMesh& mesh = mover.body->surface().mesh;
      const SwayMotion motion(object.motion.sway, mover.which, bounding_box_centre(mesh),
                              bounding_box_diagonal(mesh));
      for (std::size_t frame = 0; frame < held.size(); ++frame)
        own.push_back(motion.at(static_cast<double>(frame) / experiment.frame_rate_hz));
    }
    // A product with the identity would round.
    if (!same_pose(mover.place, Pose{}))
      for (Pose& pose : own) pose = mover.place * pose;
  }
  return result;
}

}  // namespace lmdbench
