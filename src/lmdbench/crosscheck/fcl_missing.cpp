// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// In place of fcl_crosscheck.cpp in a build without FCL (LMDBENCH_WITH_FCL).
#include <lmdbench/base/build_info.h>
#include <lmdbench/crosscheck/fcl_crosscheck.h>

namespace lmdbench {

class FclCrosscheck::Implementation {};

bool FclCrosscheck::is_built_in() {
  return false;
}

FclCrosscheck::FclCrosscheck(const Surface& /*moving*/, const std::vector<const Surface*>& /*fixed*/,
                             FclScaling /*scaling*/) {
  throw missing_part(PART_FCL, "", "", "the cross-check");
}
FclCrosscheck::~FclCrosscheck() = default;
FclCrosscheck::FclCrosscheck(FclCrosscheck&& other) noexcept = default;

FclResult FclCrosscheck::distance(const Pose& /*X_WM*/) const {
  return {};
}

}  // namespace lmdbench
