// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/run/mover_play.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace lmdbench {
namespace {

std::array<double, 7> numbers_of(const Pose& pose) {
  const Vec3& p = pose.translation;
  const auto& q = pose.rotation.coeffs();
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

}  // namespace

std::size_t MoverPlay::moving() const {
  return static_cast<std::size_t>(std::ranges::find(number, std::size_t{0}) - number.begin());
}

MoverPlay make_play(const std::vector<std::shared_ptr<const Body>>& bodies,
                    const std::vector<std::string>& names, std::vector<FixedBody> standing,
                    const std::vector<std::vector<Pose>>& poses) {
  MoverPlay play;
  LMDBENCH_EXPECTS(bodies.size() == names.size() && bodies.size() == poses.size() && !poses.empty(),
                   "parallel arrays of unlike lengths");
  play.number.resize(bodies.size());
  std::iota(play.number.begin(), play.number.end(), std::size_t{0});
  // Movers that are the same in all of this are one for whoever looks at them.
  std::ranges::stable_sort(play.number, [&](std::size_t a, std::size_t b) {
    if (names[a] != names[b]) return names[a] < names[b];
    for (std::size_t frame = 0; frame < poses[a].size(); ++frame) {
      const auto of_a = numbers_of(poses[a][frame]), of_b = numbers_of(poses[b][frame]);
      if (of_a != of_b) return of_a < of_b;
    }
    return false;
  });
  for (const std::size_t number : play.number) {
    play.bodies.push_back(bodies[number]);
    play.references_M.push_back(bounding_box_centre(bodies[number]->surface().mesh));
  }
  play.standing = std::move(standing);
  play.poses.resize(poses.front().size());
  LMDBENCH_EXPECTS(
      std::ranges::all_of(poses, [&](const auto& of) { return of.size() == poses.front().size(); }),
      "movers whose paths were not cut to the same frames");
  for (std::size_t frame = 0; frame < play.poses.size(); ++frame)
    for (const std::size_t number : play.number) play.poses[frame].push_back(poses[number][frame]);
  return play;
}

Lmd turned_round(const Lmd& lmd) {
  Lmd turned = lmd;
  std::swap(turned.point_moving, turned.point_fixed);
  std::swap(turned.feature_moving, turned.feature_fixed);
  std::swap(turned.triangle_moving, turned.triangle_fixed);
  turned.direction = -lmd.direction;
  return turned;
}

void split_by_mover(const LmdSet& lmds, const MoverPlay& play, std::vector<LmdSet>& sets) {
  sets.resize(play.count());
  for (LmdSet& set : sets) set.clear();
  for (const Lmd& lmd : lmds) {
    const ObjectPair pair = ObjectPair::of(lmd.fixed_body, play.object_count());
    LMDBENCH_EXPECTS(pair.mover < play.count() && pair.other < play.object_count(),
                     "an LMD of another scene");
    sets[pair.mover].push_back(lmd);
    if (pair.other < play.count()) sets[pair.other].push_back(turned_round(lmd));
  }
}

FiledLmd as_filed(const Lmd& lmd, const MoverPlay& play) {
  const ObjectPair pair = ObjectPair::of(lmd.fixed_body, play.object_count());
  std::size_t moving = play.number[pair.mover];
  FiledLmd filed{lmd, 0};
  std::size_t other = pair.other - play.count();
  if (pair.other < play.count()) {
    other = play.number[pair.other];
    if (other < moving) {
      std::swap(moving, other);
      filed.lmd = turned_round(lmd);
    }
    other += play.standing.size();
  }
  filed.moving_body = static_cast<std::int64_t>(moving);
  filed.lmd.fixed_body = static_cast<std::int32_t>(other);
  return filed;
}

std::vector<MoverFrame> render_movers(const std::vector<LmdSet>& sets, const MoverPlay& play,
                                      const std::vector<Pose>& poses, const ForceProfile& profile,
                                      const VirtualPhantom& device) {
  std::vector<MoverFrame> frames(play.count());
  LMDBENCH_EXPECTS(sets.size() == play.count() && poses.size() == play.count(),
                   "parallel arrays of unlike lengths");
  for (std::size_t i = 0; i < play.count(); ++i) {
    const Wrench wrench = sum_forces(sets[i], profile, RigidTransform(poses[i]).point(play.references_M[i]));
    const RenderedForce rendered = device.render(wrench, profile.largest_sum);
    frames[play.number[i]] = {rendered.force, wrench.torque, rendered.clipped,
                              static_cast<std::int64_t>(sets[i].size()), minimum_distance(sets[i])};
  }
  return frames;
}

}  // namespace lmdbench
