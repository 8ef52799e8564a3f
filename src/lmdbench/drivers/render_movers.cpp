// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/drivers/render_movers.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench {

std::vector<MoverFrame> render_movers(const ContactFinder& contacts, const Scene& scene, const Pose& X_WM,
                                      const MoverPlay& play, const ForceProfile& profile,
                                      const VirtualPhantom& device, const Method* method) {
  std::vector<MoverFrame> frames(play.count());
  LMDBENCH_EXPECTS(scene.mover_count() == play.count(), "movers of another scene");
  for (std::size_t i = 0; i < play.count(); ++i) {
    const Vec3 reference_W = RigidTransform(scene.pose(i, X_WM)).point(play.references_M[i]);
    const Wrench wrench = contacts.wrench_on(i, profile, reference_W, method);
    const RenderedForce rendered = device.render(wrench, profile.largest_sum);
    const LmdSet& set = contacts.set_of(i);
    frames[play.number[i]] = {rendered.force, wrench.torque, rendered.clipped,
                              static_cast<std::int64_t>(set.size()), minimum_distance(set)};
  }
  return frames;
}

}  // namespace lmdbench
