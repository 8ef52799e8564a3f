// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/lmd/intersection_polylines.h>
#include <lmdbench/methods/certified/intersection_tracer.h>
#include <lmdbench/run/probed_track.h>

#include <fmt/format.h>

#include <chrono>
#include <optional>

/// The curves in which the meshes intersect.
namespace lmdbench {
namespace {

struct Polylines : ProbeFindings {
  std::vector<std::int64_t> frames;
  std::vector<double> seconds;  ///< Of the walk and the chaining, on this thread's clock; one a frame.
  std::vector<std::int64_t> line_offsets{0};  ///< Of frames in the lines.
  std::vector<IntersectionPolyline> lines;
  std::vector<std::int64_t> point_offsets{0};  ///< Of lines in the points.
  std::vector<Vec3> points;
};

std::unique_ptr<ProbeFindings> trace_polylines(const ProbedTrack& track) {
  DeformingScene bodies(track.profile.scene, track.input.deformation);
  std::optional<IntersectionTracer> tracer;
  auto found = std::make_unique<Polylines>();
  for (const std::int64_t frame : track.frames) {
    bodies.to_frame(frame);
    if (!tracer || bodies.deforms()) tracer.emplace(bodies.scene());
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<IntersectionPolyline>& lines =
        tracer->trace(track.input.poses[static_cast<std::size_t>(frame)]);
    found->seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    found->frames.push_back(frame);
    for (const IntersectionPolyline& line : lines) {
      found->lines.push_back(line);
      found->points.insert(found->points.end(), line.points.begin(), line.points.end());
      found->point_offsets.push_back(static_cast<std::int64_t>(found->points.size()));
    }
    found->line_offsets.push_back(static_cast<std::int64_t>(found->lines.size()));
    tell_progress(track.progress, found->frames.size(), track.frames.size());
  }
  return found;
}

std::vector<ProbeDataset> polyline_datasets() {
  using P = Polylines;
  using Line = const IntersectionPolyline&;
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
  ProbeTable<P, IntersectionPolyline>(
      group, "L", [](const P& p, std::size_t) -> const auto& { return p.lines; })
      .column("fixed_body", "1", "which of the fixed meshes is cut",
              [](Line l) { return std::int64_t{l.fixed_body}; })
      .column("closed", "1", "1 where the last point is joined to the first", [](Line l) { return l.closed; })
      .column("length", "m", "length of the polyline", [](Line l) { return l.length(); })
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

void refuse_polylines(const Experiment& experiment, const std::string& file, const std::string& place) {
  if (experiment.is_world())
    throw UsageError(file, place, "polylines are not traced among instances",
                     "set it to 0, or list the fixed meshes without \"instances\"");
  if (!experiment.movers.empty())
    throw UsageError(file, place, "polylines are traced of one mesh that moves",
                     "set it to 0, or leave movers out");
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
      .refuse = refuse_polylines,
      .run = trace_polylines};
}

}  // namespace lmdbench
