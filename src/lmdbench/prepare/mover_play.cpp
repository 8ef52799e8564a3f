// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/prepare/mover_play.h>

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

MoverPlay make_play(const std::vector<Mover>& movers, const std::vector<std::vector<Pose>>& poses) {
  MoverPlay play;
  LMDBENCH_EXPECTS(movers.size() == poses.size() && !poses.empty(), "parallel arrays of unlike lengths");
  play.number.resize(movers.size());
  std::iota(play.number.begin(), play.number.end(), std::size_t{0});
  // Movers equal in all of this are interchangeable.
  std::ranges::stable_sort(play.number, [&](std::size_t a, std::size_t b) {
    if (movers[a].name != movers[b].name) return movers[a].name < movers[b].name;
    for (std::size_t frame = 0; frame < poses[a].size(); ++frame) {
      const auto of_a = numbers_of(poses[a][frame]), of_b = numbers_of(poses[b][frame]);
      if (of_a != of_b) return of_a < of_b;
    }
    return false;
  });
  for (const std::size_t number : play.number) {
    play.bodies.push_back(movers[number].body);
    play.references_M.push_back(bounding_box_centre(movers[number].body->surface().mesh));
  }
  play.poses.resize(poses.front().size());
  LMDBENCH_EXPECTS(
      std::ranges::all_of(poses, [&](const auto& of) { return of.size() == poses.front().size(); }),
      "movers whose paths were not cut to the same frames");
  for (std::size_t frame = 0; frame < play.poses.size(); ++frame)
    for (const std::size_t number : play.number) play.poses[frame].push_back(poses[number][frame]);
  return play;
}

Scene MoverPlay::with_movers(Scene scene) const {
  scene.movers = bodies;
  scene.held = moving();
  return scene;
}

FiledLmd as_filed(const Lmd& lmd, const Scene& scene, const MoverPlay* play) {
  if (play == nullptr) return {lmd, 0};
  const ObjectPair pair = ObjectPair::of(lmd.fixed_body, scene);
  std::size_t moving = play->number[pair.mover];
  FiledLmd filed{lmd, 0};
  std::size_t other = pair.other - play->count();
  if (scene.is_mover(pair.other)) {
    other = play->number[pair.other];
    if (other < moving) {
      std::swap(moving, other);
      filed.lmd = turned_round(lmd);
    }
    other += scene.fixed.size();
  }
  filed.moving_body = static_cast<std::int64_t>(moving);
  filed.lmd.fixed_body = static_cast<std::int32_t>(other);
  return filed;
}

}  // namespace lmdbench
