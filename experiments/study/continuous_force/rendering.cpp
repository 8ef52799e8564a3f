// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>

#include <study/continuous_force/rendering.h>
#include <support/bodies.h>
#include <support/poses.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace lmdbench::continuous_force {

std::array<double, LAWS> zeros(bool layered) {
  return {0.0, 0.0, 0.0, layered ? 0.0 : std::numeric_limits<double>::quiet_NaN()};
}

bool Rendered::is_separated() const {
  return std::ranges::all_of(critical, [](const CriticalPair& c) { return c.is_minimum && c.index == 1; });
}

Renderer::Renderer(const Scene& scene, const ForceProfile& profile, std::optional<LayeredChoice> layered)
    : profile_(profile), method_(make_method("certified", scene)), merges_(scene) {
  if (layered) layered_.emplace(layered_law(), scene, *layered);
}

Rendered Renderer::at(const Pose& X_WM) {
  Rendered rendered;
  rendered.critical = critical_at(*method_, X_WM);
  merges_.find(X_WM, rendered.critical, found_);
  rendered.merges = found_.size();
  const ForceInput input{rendered.critical, found_};
  for (std::size_t law = 0; law < LAYERED; ++law)
    rendered.force[law] =
        aggregations()[law].combine(input, profile_, X_WM.translation).force / profile_.maximum_force;
  rendered.force[LAYERED] = layered_
                                ? Vec3(layered_->wrench_at(*method_, X_WM, profile_, X_WM.translation).force /
                                       profile_.maximum_force)
                                : Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  return rendered;
}

ForceProfile profile_of(double cutoff) {
  return {.law = ForceLaw::EXPONENTIAL,
          .cutoff = cutoff,
          .saturation_distance = 0.1 * cutoff,
          .maximum_force = 1.0,
          .sharpness = 4.0};
}

PathScene load_path_scene(const std::string& name, const std::filesystem::path& meshes,
                          const std::filesystem::path& paths, std::size_t frames, std::size_t stride,
                          const std::string& soft_mesh) {
  PathScene result;
  result.name = name;
  double cutoff = 0.0;
  if (name == "bunny-hard" || name == "bunny-soft") {
    const std::string mesh = name == "bunny-hard" ? "bunny-16k" : soft_mesh;
    result.scene = experiments::load_scene({.moving = mesh, .fixed = mesh, .meshes = meshes});
    cutoff = (name == "bunny-hard" ? 0.005 : 0.05) * 0.15;
  } else if (name == "shapes") {
    result.scene.moving = experiments::load_body("blob", meshes, 0.1);
    result.scene.fixed = {experiments::load_body("torus", meshes, 0.15)};
    cutoff = 0.02 * 0.1;
  } else {
    throw std::runtime_error("no path scene " + name);
  }
  result.scene.cutoff = cutoff;
  result.profile = profile_of(cutoff);
  if (name == "shapes") result.profile.law = ForceLaw::LINEAR;
  const std::vector<Pose> all = experiments::path_poses(paths / (name + ".tum"), 0, frames * stride);
  for (std::size_t i = 0; i < all.size(); i += stride) result.poses.push_back(all[i]);
  return result;
}

Pose between(const Pose& a, const Pose& b, double share) {
  return {a.translation + share * (b.translation - a.translation), a.rotation.slerp(share, b.rotation)};
}

}  // namespace lmdbench::continuous_force
