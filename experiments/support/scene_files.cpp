// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/off_file.h>

#include <fmt/format.h>
#include <support/scene_files.h>

#include <fstream>

namespace lmdbench::experiments {

std::string write_scene(const Scene& scene, const Pose& X_WM, const std::string& method,
                        const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_off(folder / "moving.off", scene.moving->surface().mesh);
  write_off(folder / "fixed.off", scene.fixed.at(0)->surface().mesh);
  const Vec3& p = X_WM.translation;
  const Eigen::Quaterniond& q = X_WM.rotation;
  std::ofstream(folder / "pose.tum") << fmt::format(
      "0 {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", p.x(), p.y(), p.z(), q.x(), q.y(), q.z(),
      q.w());
  return fmt::format(
      "cd {} && lmdbench query --moving moving.off --fixed fixed.off --poses pose.tum --cutoff {:.17g} "
      "--method {}",
      folder.string(), scene.cutoff, method);
}

}  // namespace lmdbench::experiments
