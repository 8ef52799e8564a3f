// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/node_test/binary.h>

namespace lmdbench::experiments {

/// The tests of the improved algorithm, and of the original one by default (decision E4).
NodeTestImplementation binary_ray_test() {
  return {"binary-ray", [](const Setting& setting) {
            return std::make_unique<BinaryNodeTest<DirectionTest::RAY>>(setting);
          }};
}

}  // namespace lmdbench::experiments
