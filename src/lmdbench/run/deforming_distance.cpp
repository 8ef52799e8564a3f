// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/run/contact.h>
#include <lmdbench/run/deforming_distance.h>

#include <cstddef>
#include <utility>

namespace lmdbench {

DeformingDistance::DeformingDistance(const Scene& rest, std::shared_ptr<const SceneDeformation> deformation)
    : bodies_(rest, deformation),
      deformation_(std::move(deformation)),
      motion_(rest.moving->surface().mesh, deformation_->farthest(0)) {}

double DeformingDistance::look(std::int64_t frame, const Pose& X_WM) {
  bodies_.to_frame(frame);
  looked_at_ = X_WM;
  frame_ = frame;
  distance_ = nearest_distance(bodies_.scene(), X_WM);
  return distance_;
}

DeformingDistance::Interval DeformingDistance::known(std::int64_t frame, const Pose& X_WM) const {
  if (!looked_at_) return {};
  const double change = motion_.between(*looked_at_, X_WM) + motion_.slack(*looked_at_, X_WM) +
                        deformation_->way(frame_, frame) * (1.0 + MotionBound::ROUNDING);
  return {distance_ * (1.0 - MotionBound::ROUNDING) - change,
          distance_ * (1.0 + MotionBound::ROUNDING) + change};
}

std::vector<bool> frames_in_contact(const Scene& rest,
                                    const std::shared_ptr<const SceneDeformation>& deformation,
                                    const std::vector<Pose>& poses, bool forecast) {
  if (!deformation) return frames_in_contact(rest, poses, forecast);
  DeformingDistance distance(rest, deformation);
  std::vector<bool> in_contact;
  in_contact.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto frame = static_cast<std::int64_t>(i);
    const DeformingDistance::Interval known =
        forecast ? distance.known(frame, poses[i]) : DeformingDistance::Interval();
    if (known.most < rest.cutoff)
      in_contact.push_back(true);
    else if (known.least > rest.cutoff)
      in_contact.push_back(false);
    else
      in_contact.push_back(distance.look(frame, poses[i]) <= rest.cutoff);
  }
  return in_contact;
}

}  // namespace lmdbench
