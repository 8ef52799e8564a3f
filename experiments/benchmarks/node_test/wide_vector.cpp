// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <benchmarks/node_test/wide_recording.h>

namespace lmdbench::experiments {

/// Eight children at once; each call has the run-time dispatch that a search pays once a query.
NodeTestImplementation wide_vector_test() {
  return wide_node_test(
      "wide-vector", [](const WideTest& t) { return test_lanes_vector(*t.node, t.probe, t.limits); },
      [](const WideTest& t) { return test_lanes_scalar(*t.node, t.probe, t.limits); });
}

}  // namespace lmdbench::experiments
