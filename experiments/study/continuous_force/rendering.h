// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/critical/merges.h>
#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The forces that the laws of force/aggregation.h make of the same critical pairs.
namespace lmdbench::continuous_force {

/// Laws, in the order of `aggregations()`.
inline constexpr std::size_t SUM = 0, SIGNED = 1, SHARED = 2, LAYERED = 3, LAWS = 4;
using Forces = std::array<Vec3, LAWS>;
/// Zero for each law, the start of a sum; NaN for `layered` where it is not measured.
std::array<double, LAWS> zeros(bool layered);

struct Rendered {
  Forces force;          ///< In units of one LMD's largest force; NaN where not computed.
  CriticalSet critical;  ///< Within the cutoff.
  std::size_t merges = 0;

  bool in_contact() const { return !critical.empty(); }
  /// No saddle within the cutoff, so that every law is the plain sum.
  bool is_separated() const;
};

/// Forces of a scene's poses under all laws; `layered`, which is far slower, only on request.
class Renderer {
 public:
  Renderer(const Scene& scene, const ForceProfile& profile,
           std::optional<LayeredChoice> layered = std::nullopt);

  Rendered at(const Pose& X_WM);
  const ForceProfile& profile() const { return profile_; }

 private:
  ForceProfile profile_;
  std::unique_ptr<Method> method_;
  MergeFinder merges_;
  std::vector<Merge> found_;
  std::optional<ContactFinder> layered_;
};

/// A scene with a path.
struct PathScene {
  std::string name;
  Scene scene;
  ForceProfile profile;  ///< With a largest force of 1.
  std::vector<Pose> poses;
};

/// Recorded hard and soft contact or generated contact, like the experiment of that name.
/// @param stride  every stride-th frame of 1 kHz is used
PathScene load_path_scene(const std::string& name, const std::filesystem::path& meshes,
                          const std::filesystem::path& paths, std::size_t frames, std::size_t stride = 1,
                          const std::string& soft_mesh = "bunny-16k");

/// Exponential with sharpness 4, saturated below a tenth of the cutoff.
ForceProfile profile_of(double cutoff);

/// Pose between two others: along the line and the shortest turn.
Pose between(const Pose& a, const Pose& b, double share);

}  // namespace lmdbench::continuous_force
