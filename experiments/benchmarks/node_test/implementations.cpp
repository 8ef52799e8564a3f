// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/node_test/implementation.h>

namespace lmdbench::experiments {

std::vector<NodeTestImplementation> node_test_implementations() {
  return {binary_ray_test(), binary_line_test(), wide_scalar_test(), wide_vector_test(),
          wide_lifetime_test()};
}

}  // namespace lmdbench::experiments
