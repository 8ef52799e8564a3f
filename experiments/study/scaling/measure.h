// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/agreement.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/lmd/work_counters.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::scaling {

/// Results of one implementation at every pose, with the error beside the time.
struct Series {
  std::string name;
  std::vector<double> seconds;         ///< Median of the repetitions, processor time.
  std::vector<WorkCounters> counters;  ///< One per pose; only of `certified`.
  Agreement same;                      ///< With `certified` from scratch; empty for nearest pairs.
  Agreement neighbours;                ///< The same, where neighbouring features count.
  std::string objection;               ///< Why its times do not count, or empty.
};

struct Measurement {
  std::vector<Series> series;
  std::vector<std::size_t> lmd_counts;  ///< True LMDs of each pose.
};

struct MeasureChoice {
  std::size_t repetitions = 5;
  std::size_t lead_in_frames = 20;
  std::uint64_t seed = 1;
  double gap = 0.0;  ///< Minimum distance at every pose [m].
};

/// Times, interleaved pose by pose:
/// - "certified": from scratch at unrelated poses, between the others, so with cold caches;
/// - "certified sliding": from scratch after a slide to the pose (slide.h), as in a haptic loop;
/// - "certified coherent": the same slide with frame coherence;
/// - the other methods, except those that test all pairs of triangles, and "fcl-cold".
/// Checked first: `certified` (where the nearest pair is an LMD) and FCL have the gap as minimum
/// distance; all three sets of `certified` are the same.
Measurement measure(const Scene& scene, const std::vector<Pose>& poses, const MeasureChoice& choice);

/// Memory that certified needs for a mesh, and the time to build it.
struct BuildCost {
  double surface_seconds = 0.0;             ///< Adjacency and normals; wall clock, least of three.
  double surface_cpu_seconds = 0.0;         ///< Processor time of all threads, least of three.
  double wide_hierarchy_seconds = 0.0;      ///< Polar caps and tree; wall clock, least of three.
  double wide_hierarchy_cpu_seconds = 0.0;  ///< Processor time of all threads, least of three.
  std::size_t surface_bytes = 0;            ///< Mesh, adjacency and normals.
  std::size_t wide_hierarchy_bytes = 0;
  std::size_t features = 0;  ///< Features that can carry an LMD.
};

BuildCost measure_build(const TriangleMesh& mesh);

}  // namespace lmdbench::scaling
