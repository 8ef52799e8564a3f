// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Tasks that only lmdbench-benchmark has. Each function registers a task's benchmarks with Google
/// Benchmark; their meshes and truth are made at once and live until the program ends.
namespace lmdbench::experiments {

/// triangle_distance/<implementation>/<family>: items are pairs. An implementation that disagrees
/// with the reference is skipped; the reason names the pair's number.
void add_triangle_distances();

/// node_test/<implementation>/<cutoff>: items are node pairs, "per_pair" is the time of one. The
/// share "survivors" of kept pairs shows the test's quality: none may reject one with an LMD.
void add_node_tests();

}  // namespace lmdbench::experiments
