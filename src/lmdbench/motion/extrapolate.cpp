// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/motion/extrapolate.h>
#include <lmdbench/motion/rotation_vector.h>

#include <cmath>

namespace lmdbench {

Pose extrapolated(const Pose& before, const Pose& now, double frames) {
  LMDBENCH_EXPECTS(std::isfinite(frames), "a time that was divided by no time");
  const Vec3 turn_W = rotation_vector_of(now.rotation * before.rotation.conjugate());
  return {now.translation + frames * (now.translation - before.translation),
          (rotation_of(frames * turn_W) * now.rotation).normalized()};
}

}  // namespace lmdbench
