// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/run/motion_bound.h>
#include <lmdbench/run/scene_deformation.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace lmdbench {

/// The exact distance of meshes that deform, frame by frame: of a frame that was not looked at, what follows from one that was and
/// bounds on motion and deformation since.
class DeformingDistance {
 public:
  DeformingDistance(const Scene& rest, std::shared_ptr<const SceneDeformation> deformation);

  /// The distance, however far; 0 where triangles touch or intersect [m].
  double look(std::int64_t frame, const Pose& X_WM);

  /// Between these it is.
  struct Interval {
    double least = 0.0, most = std::numeric_limits<double>::infinity();
  };
  Interval known(std::int64_t frame, const Pose& X_WM) const;

 private:
  DeformingScene bodies_;
  std::shared_ptr<const SceneDeformation> deformation_;
  MotionBound motion_;  ///< Of the moving mesh in all of its shapes.
  std::optional<Pose> looked_at_;
  std::int64_t frame_ = 0;  ///< That was looked at.
  double distance_ = 0.0;   ///< There [m].
};

/// As contact.h, each frame at the shape that it has.
/// @param forecast  whether frames whose contact is known are left out of the search: the answer is the same
std::vector<bool> frames_in_contact(const Scene& rest,
                                    const std::shared_ptr<const SceneDeformation>& deformation,
                                    const std::vector<Pose>& poses, bool forecast = true);

}  // namespace lmdbench
