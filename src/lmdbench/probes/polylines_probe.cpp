// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/methods/certified/intersection_tracer.h>
#include <lmdbench/probes/probed_track.h>
#include <lmdbench/scene/mesh_pair.h>
#include <lmdbench/scene/near_pairs.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <utility>

/// The curves in which the meshes intersect.
namespace lmdbench {
namespace {

struct TracedLine {
  IntersectionPolyline polyline;  ///< `fixed_body` as `Lmd::fixed_body`, in files as FiledLmd.
  std::int64_t moving_body = 0;
};

/// Intersections of the objects of any scene: pair by pair, each in the frame of the second.
class SceneTracer {
 public:
  /// @param scene must outlive this
  explicit SceneTracer(const Scene& scene) : scene_(scene), near_(scene) {}

  const std::vector<TracedLine>& trace(const Pose& X_WM) {
    lines_.clear();
    for (const auto& [bound, pair] : near_.within(0.0, X_WM)) {
      const PlacedPair place = PlacedPair::of(scene_, pair, X_WM);
      for (IntersectionPolyline line : tracer_of(pair).trace(place.X_FM)) {
        line.fixed_body = pair.number(scene_);
        if (!place.is_world)
          for (Vec3& point : line.points) point = place.X_WF.point(point);
        lines_.push_back({std::move(line)});
      }
    }
    std::ranges::stable_sort(lines_, {}, [](const TracedLine& line) { return line.polyline.fixed_body; });
    return lines_;
  }

 private:
  IntersectionTracer& tracer_of(const ObjectPair& pair) {
    auto& tracer = tracers_[{scene_.body(pair.mover).get(), scene_.body(pair.other).get()}];
    if (!tracer) tracer = std::make_unique<IntersectionTracer>(pair.scene_of(scene_));
    return *tracer;
  }

  const Scene& scene_;
  NearPairs near_;
  std::map<std::pair<const Body*, const Body*>, std::unique_ptr<IntersectionTracer>> tracers_;
  std::vector<TracedLine> lines_;
};

struct Polylines : ProbeFindings {
  bool several_move = false;
  std::vector<std::int64_t> frames;
  std::vector<double> seconds;                ///< Of tracing, on this thread's clock; one a frame.
  std::vector<std::int64_t> line_offsets{0};  ///< First line of each frame.
  std::vector<TracedLine> lines;
  std::vector<std::int64_t> point_offsets{0};  ///< First point of each line.
  std::vector<Vec3> points;
};

std::unique_ptr<ProbeFindings> trace_polylines(const ProbedTrack& track) {
  SceneFrames bodies(track.profile.scene, track.input.motion);
  std::optional<SceneTracer> tracer;
  auto found = std::make_unique<Polylines>();
  found->several_move = track.input.motion.movers != nullptr;
  for (const std::int64_t frame : track.frames) {
    bodies.to_frame(frame);
    if (!tracer || bodies.deforms()) tracer.emplace(bodies.scene());
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<TracedLine>& lines = tracer->trace(track.input.poses[static_cast<std::size_t>(frame)]);
    found->seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    found->frames.push_back(frame);
    for (TracedLine line : lines) {
      Lmd named;  // for the numbers of its two objects
      named.fixed_body = line.polyline.fixed_body;
      const FiledLmd filed = as_filed(named, bodies.scene(), track.input.motion.movers.get());
      line.polyline.fixed_body = filed.lmd.fixed_body;
      line.moving_body = filed.moving_body;
      found->points.insert(found->points.end(), line.polyline.points.begin(), line.polyline.points.end());
      found->lines.push_back(std::move(line));
      found->point_offsets.push_back(static_cast<std::int64_t>(found->points.size()));
    }
    found->line_offsets.push_back(static_cast<std::int64_t>(found->lines.size()));
    tell_progress(track.progress, found->frames.size(), track.frames.size());
  }
  return found;
}

std::vector<ProbeDataset> polyline_datasets() {
  using P = Polylines;
  using Line = const TracedLine&;
  const auto same = [](const auto& value) { return value; };
  std::vector<ProbeDataset> all;
  const std::string group = "/polylines";
  ProbeTable<P, std::int64_t>(
      group, "F", [](const P& p, std::size_t) -> const auto& { return p.frames; })
      .column("frame", "1", "frame", same)
      .into(all);
  ProbeTable<P, double>(
      group, "F", [](const P& p, std::size_t) -> const auto& { return p.seconds; })
      .column("trace_time", "s", "time of finding the crossing triangles and chaining them", same)
      .into(all);
  ProbeTable<P, std::int64_t>(
      group, "F + 1", [](const P& p, std::size_t) -> const auto& { return p.line_offsets; })
      .column("frame_offset", "1",
              "entry f of `frame` owns polylines frame_offset[f] to frame_offset[f + 1] - 1", same)
      .into(all);
  const auto lines = [](const P& p, std::size_t) -> const auto& {
    return p.lines;
  };
  ProbeTable<P, TracedLine>(group, "L", lines, [](const P& p) {
    return p.several_move;
  }).column("moving_body", "1", "which of the movers cuts", [](Line l) {
      return l.moving_body;
    }).into(all);
  ProbeTable<P, TracedLine>(group, "L", lines)
      .column("fixed_body", "1", "which of the fixed meshes is cut",
              [](Line l) { return std::int64_t{l.polyline.fixed_body}; })
      .column("closed", "1", "1 where the last point is joined to the first",
              [](Line l) { return l.polyline.closed; })
      .column("length", "m", "length of the polyline", [](Line l) { return l.polyline.length(); })
      .into(all);
  ProbeTable<P, std::int64_t>(
      group, "L + 1", [](const P& p, std::size_t) -> const auto& { return p.point_offsets; })
      .column("point_offset", "1", "polyline l owns points point_offset[l] to point_offset[l + 1] - 1", same)
      .into(all);
  ProbeTable<P, Vec3>(
      group, "P", [](const P& p, std::size_t) -> const auto& { return p.points; })
      .column("point", "m", "points of the polylines, world frame", same)
      .into(all);
  return all;
}

}  // namespace

Probe polylines_probe() {
  return {
      .name = "polylines",
      .title = "intersection polylines",
      .parent = "/record",
      .stride_text = "the curves in which the meshes intersect are written every this many frames; 0: none",
      .datasets = polyline_datasets(),
      .why =
          [](const ProbeChoice& choice) {
            return fmt::format("every {} frames, outside the timed frames", choice.stride_frames);
          },
      .left_out = "record/polylines/stride_frames is 0",
      .run = trace_polylines};
}

}  // namespace lmdbench
