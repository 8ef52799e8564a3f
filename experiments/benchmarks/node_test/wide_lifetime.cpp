// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/node_test/wide_recording.h>

namespace lmdbench::experiments {

/// Eight children at once, and for how many frames their rejections are valid: the cost of a test
/// that frame coherence keeps. At rest, without a forecast.
NodeTestImplementation wide_lifetime_test() {
  const auto at_rest = [](const WideTest& t) { return WideLifetimeTest{false, {}, t.touch_lanes}; };
  return wide_node_test(
      "wide-lifetime",
      [=](const WideTest& t) { return test_lanes_lifetime(*t.node, t.probe, t.limits, {}, at_rest(t)); },
      [=](const WideTest& t) {
        return test_lanes_lifetime_scalar(*t.node, t.probe, t.limits, {}, at_rest(t));
      });
}

}  // namespace lmdbench::experiments
