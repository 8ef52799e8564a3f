// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/wide_slack.h>

#include <micro/node_test/wide_recording.h>

namespace lmdbench::micro {

/// Eight children at once, and how much motion the rejections stand: what frame coherence pays for a test
/// that it keeps.
NodeTestImplementation wide_slack_test() {
  return wide_node_test(
      "wide-slack",
      [](const WideTest& t) { return test_lanes_slack(*t.node, t.probe, t.limits, {}, t.touch_lanes); },
      [](const WideTest& t) {
        return test_lanes_slack_scalar(*t.node, t.probe, t.limits, {}, t.touch_lanes);
      });
}

}  // namespace lmdbench::micro
