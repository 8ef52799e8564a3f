// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/node_test/binary.h>

namespace lmdbench::experiments {

/// The original's dual solution line cone read as a line (decision E4).
NodeTestImplementation binary_line_test() {
  return {"binary-line", [](const Setting& setting) {
            return std::make_unique<BinaryNodeTest<DirectionTest::LINE>>(setting);
          }};
}

}  // namespace lmdbench::experiments
