// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>

#include <memory>
#include <vector>

namespace lmdbench {

/// What a method works on: one moving body and the fixed ones, whose vertices are already in the world frame.
struct Scene {
  std::shared_ptr<const Body> moving;
  std::vector<std::shared_ptr<const Body>> fixed;
  double cutoff = 0.0;  ///< Distance beyond which a pair exerts no force [m]; G1's limit.
};

}  // namespace lmdbench
