// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/direction_memory.h>

#include <benchmarks/frame_loop.h>

namespace lmdbench::experiments {

/// Adds the force to a loop's LMD set, as the lockstep driver does.
class Rendered : public FrameLoop {
 public:
  /// @param profile of the force; the path must outlive the loop
  Rendered(std::unique_ptr<FrameLoop> loop, const ForceProfile& profile, const RecordedPath& path);

  void step(std::size_t frame) override;
  double minimum_distance() const override { return loop_->minimum_distance(); }
  const LmdSet* lmds() const override { return loop_->lmds(); }
  const Vec3& force() const { return force_; }  ///< [N], of the last step.

 private:
  const RecordedPath& path_;
  ForceProfile profile_;
  std::unique_ptr<FrameLoop> loop_;
  DirectionMemory memory_;
  LmdSet lmds_;
  Vec3 force_ = Vec3::Zero();
};

}  // namespace lmdbench::experiments
