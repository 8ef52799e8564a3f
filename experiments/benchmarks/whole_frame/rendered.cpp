// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregation.h>

#include <benchmarks/whole_frame/implementation.h>
#include <benchmarks/whole_frame/rendered.h>

#include <algorithm>
#include <utility>

namespace lmdbench::experiments {

Rendered::Rendered(std::unique_ptr<FrameLoop> loop, const ForceProfile& profile, const RecordedPath& path)
    : path_(path), profile_(profile), loop_(std::move(loop)), memory_(profile.cutoff) {}

void Rendered::step(std::size_t frame) {
  loop_->step(frame);
  const LmdSet* found = loop_->lmds();
  if (found == nullptr) return;
  lmds_ = *found;
  std::stable_sort(lmds_.begin(), lmds_.end(), lmd_less);
  memory_.complete(lmds_);
  const Vec3 reference_W = RigidTransform(path_.poses()[frame]).point(path_.input.reference_M);
  force_ = path_.input.device.render(sum_forces(lmds_, profile_, reference_W), profile_.largest_sum).force;
}

FrameImplementation rendered_search(const SearchImplementation& search) {
  return {search.name, search.promise, search.slow, [search](const RecordedPath& path) {
            return std::make_unique<Rendered>(make_search_every_frame(search, path), path.profile, path);
          }};
}

}  // namespace lmdbench::experiments
