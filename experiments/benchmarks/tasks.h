// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The tasks of lmdbench-benchmark. Each function registers a task's benchmarks with Google
/// Benchmark; their meshes and truth are made at once and live until the program ends.
namespace lmdbench::experiments {

/// triangle_distance/<implementation>/<family>: items are pairs. An implementation that disagrees
/// with the reference is skipped; the reason names the pair's number.
void add_triangle_distances();

/// node_test/<implementation>/<cutoff>: items are node pairs, "per_pair" is the time of one. The
/// share "survivors" of kept pairs shows the test's quality: none may reject one with an LMD.
void add_node_tests();

/// global_search/<implementation>/<cutoff>: two bunnies at unrelated poses 0.2 % of the diagonal
/// apart. Implementations are first checked against the truth, and skipped if they break a promise.
void add_global_searches();

/// local_tracking/<implementation>/<path>: the counter "per_frame" is the time of one frame.
void add_local_trackings();

/// whole_frame/<implementation>/<path>: counter "per_frame", the time of a frame with its searches.
void add_whole_frames();

/// hierarchy_build/<implementation>/<mesh>: items are triangles. Wall clock counts, because some
/// builders use all cores; processor time of all threads stands beside it. Each build first answers
/// some distances. Missing meshes are left out.
void add_hierarchy_builds();

}  // namespace lmdbench::experiments
