// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/lmd/scene.h>

#include <functional>
#include <memory>
#include <vector>

namespace lmdbench {

/// A method that does not follow meshes that deform (MethodDescription::follows_deformation): made anew in the first search or tracking
/// after a body of its scene has deformed. So it is right, and pays for its preparation in each such frame. What FCL holds of a mesh is built
/// again with it: FCL 0.7.0's refit from the leaves up returns wrong distances for RSS and OBBRSS.
class RemadeMethod : public Method, public HasOwnWrench {
 public:
  using Make = std::function<std::unique_ptr<Method>(const Scene& scene)>;

  RemadeMethod(const Scene& scene, Make make);

  const MethodDescription& description() const override { return method_->description(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override;
  std::optional<OwnWrench> own_wrench() const override { return own_wrench_of(*method_); }

 private:
  Method& current();
  std::uint64_t deformations() const;  ///< Of all bodies.

  Scene scene_;
  std::vector<std::shared_ptr<const Body>> bodies_;  ///< Each once, however many instances it has.
  Make make_;
  std::unique_ptr<Method> method_;
  std::uint64_t deformations_ = 0;  ///< When the method was made.
};

}  // namespace lmdbench
