// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/intersection_tracer.h>
#include <lmdbench/run/polyline_probe.h>

#include <chrono>
#include <cstddef>
#include <optional>

namespace lmdbench {

std::vector<PolylineFrame> probe_polylines(const Scene& scene, const LockstepInput& input,
                                           const std::vector<std::int64_t>& frames,
                                           const Progress& progress) {
  DeformingScene bodies(scene, input.deformation);
  std::optional<IntersectionTracer> tracer;
  std::vector<PolylineFrame> result;
  for (const std::int64_t frame : frames) {
    bodies.to_frame(frame);
    if (!tracer || bodies.deforms()) tracer.emplace(bodies.scene());
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<IntersectionPolyline>& lines =
        tracer->trace(input.poses[static_cast<std::size_t>(frame)]);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.push_back({frame, seconds, lines});
    tell_progress(progress, result.size(), frames.size());
  }
  return result;
}

}  // namespace lmdbench
