// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result/write_polylines.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace lmdbench {

void write_polylines(ResultWriter& writer, const std::string& group,
                     const std::vector<PolylineFrame>& frames) {
  std::vector<std::int64_t> frame, line_offset{0}, point_offset{0}, body;
  std::vector<std::uint8_t> closed;
  std::vector<double> seconds, length, points;
  for (const PolylineFrame& here : frames) {
    frame.push_back(here.frame);
    seconds.push_back(here.seconds);
    for (const IntersectionPolyline& line : here.polylines) {
      body.push_back(line.fixed_body);
      closed.push_back(line.closed ? 1 : 0);
      length.push_back(line.length());
      for (const Vec3& point : line.points) points.insert(points.end(), point.data(), point.data() + 3);
      point_offset.push_back(static_cast<std::int64_t>(points.size() / 3));
    }
    line_offset.push_back(static_cast<std::int64_t>(body.size()));
  }
  const auto column = [&](const std::string& name, const std::string& units, const std::string& long_name,
                          const auto& values) {
    writer.write({group + "/" + name, units, long_name}, std::span(values), {values.size()});
  };
  column("frame", "1", "frame", frame);
  column("trace_time", "s", "time of finding the crossing triangles and chaining them", seconds);
  column("frame_offset", "1", "entry f of `frame` owns polylines frame_offset[f] to frame_offset[f + 1] - 1",
         line_offset);
  column("fixed_body", "1", "which of the fixed meshes is cut", body);
  column("closed", "1", "1 where the last point is joined to the first", closed);
  column("length", "m", "length of the polyline", length);
  column("point_offset", "1", "polyline l owns points point_offset[l] to point_offset[l + 1] - 1",
         point_offset);
  writer.write({group + "/point", "m", "points of the polylines, world frame"},
               std::span<const double>(points), {points.size() / 3, 3});
}

}  // namespace lmdbench
