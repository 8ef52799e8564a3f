// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/extrapolate.h>
#include <lmdbench/motion/rotation_vector.h>

namespace lmdbench {

Pose extrapolated(const Pose& before, const Pose& now, double frames) {
  const Vec3 turn_W = rotation_vector_of(now.rotation * before.rotation.conjugate());
  return {now.translation + frames * (now.translation - before.translation),
          (rotation_of(frames * turn_W) * now.rotation).normalized()};
}

}  // namespace lmdbench
