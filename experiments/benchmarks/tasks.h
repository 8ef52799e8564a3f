// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The tasks of lmdbench-benchmark. Each function registers a task's benchmarks with Google Benchmark; what they
/// need of meshes and truth is made at once and lives until the program ends.
namespace lmdbench::experiments {

/// triangle_distance/<implementation>/<family>, items are pairs. An implementation that disagrees with the reference
/// is skipped, with the pair's number as the reason.
void add_triangle_distances();

/// node_test/<implementation>/<cutoff>, items are node pairs, the counter "per_pair" is the time of one. The share of
/// pairs that survive, "survivors", is what the test's quality shows in: none may reject a pair that holds an LMD.
void add_node_tests();

/// global_search/<implementation>/<cutoff>: two bunnies at unrelated poses 0.2 % of the diagonal apart; each
/// implementation is checked against ground truth first and skipped with the reason when it breaks its promise.
void add_global_searches();

/// local_tracking/<implementation>/<path>, the counter "per_frame" is the time of one frame.
void add_local_trackings();

/// whole_frame/<implementation>/<path>, the counter "per_frame" is the time of one frame, searches included.
void add_whole_frames();

/// hierarchy_build/<implementation>/<mesh>, items are triangles. Wall time is what counts, because some builders use
/// all cores; processor time of all threads stands beside it. Each is asked some distances first. Meshes that are not
/// there are left out.
void add_hierarchy_builds();

}  // namespace lmdbench::experiments
