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

/// What one implementation did at every pose, and the error that its time bought.
struct Series {
  std::string name;
  std::vector<double> seconds;         ///< One a pose: median of the repetitions, processor time.
  std::vector<WorkCounters> counters;  ///< One a pose; only of `certified`.
  Agreement same;         ///< With `certified` from scratch, each pair once; empty for a nearest pair only.
  Agreement neighbours;   ///< The same, neighbouring features count.
  std::string objection;  ///< Why its times do not count; empty when it does what it promises.
};

struct Measurement {
  std::vector<Series> series;
  std::vector<std::size_t> lmd_counts;  ///< True LMDs, one a pose.
};

struct MeasureChoice {
  std::size_t repetitions = 5;
  std::size_t lead_in_frames = 20;
  std::uint64_t seed = 1;
  double gap = 0.0;  ///< Minimum distance at every pose [m].
};

/// Times, interleaved pose by pose:
/// - "certified": from scratch at unrelated poses, between the other implementations, so with cold caches;
/// - "certified sliding": from scratch, but after a slide to the pose (slide.h), as in a haptic loop;
/// - "certified coherent": the same slide with frame coherence;
/// - the other methods, but for those that look at every pair of triangles, and "fcl-cold".
/// Each is checked first: the minimum distance of `certified` (where the nearest pair is an LMD) and FCL must
/// be the gap, and all three sets of `certified` the same.
Measurement measure(const Scene& scene, const std::vector<Pose>& poses, const MeasureChoice& choice);

/// What certified needs of a mesh, and what its making takes.
struct BuildCost {
  double surface_seconds = 0.0;             ///< Adjacency and normals; wall time, least of three.
  double surface_cpu_seconds = 0.0;         ///< Processor time of all threads, least of three.
  double wide_hierarchy_seconds = 0.0;      ///< Polar caps and tree; wall time, least of three.
  double wide_hierarchy_cpu_seconds = 0.0;  ///< Processor time of all threads, least of three.
  std::size_t surface_bytes = 0;            ///< Mesh, adjacency and normals.
  std::size_t wide_hierarchy_bytes = 0;
  std::size_t features = 0;  ///< That can carry an LMD.
};

BuildCost measure_build(const TriangleMesh& mesh);

}  // namespace lmdbench::scaling
