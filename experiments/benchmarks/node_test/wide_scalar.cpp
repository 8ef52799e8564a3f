// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/traverse/wide_node_test.h>

#include <benchmarks/node_test/wide_recording.h>

namespace lmdbench::experiments {

/// Eight children lane by lane: plain C++, the reference of the vector form.
NodeTestImplementation wide_scalar_test() {
  const auto test = [](const WideTest& t) { return test_lanes_scalar(*t.node, t.probe, t.limits); };
  return wide_node_test("wide-scalar", test, test);
}

}  // namespace lmdbench::experiments
