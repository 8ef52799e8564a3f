// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace lmdbench {

/// Hierarchies of a mesh among coordinates that are far larger than its own. There rounding turns a
/// direction against short wings and lines by more than POLAR_SLACK, though LEAST_WING counts them:
/// caps leave more of them out (PROOF.md, lemma 3). Nearly no mesh has any that short.
/// @tparam WithCritical  over the features of a SignedHierarchy
template <bool WithCritical>
class HierarchiesAmong {
 public:
  static HierarchiesAmong of(const Body& body);
  /// Builds them anew, each in its place.
  void follow(const Body& body, const SurfaceChange& change);

  /// Safe to call from several threads; the hierarchy stays where it is.
  /// @param coordinates  largest of both meshes in the world where pairs are searched [m]
  /// @return the one that is prepared for all scenes where no wing is too short for them
  const WideHierarchy& at(const Body& body, double coordinates) const;

 private:
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
  /// Or line, of those that LEAST_WING counts; infinity without one, nothing before a call [m].
  mutable std::optional<double> shortest_wing_;
  /// By the power of two that bounds the coordinates.
  mutable std::map<int, std::unique_ptr<WideHierarchy>> made_;
};

}  // namespace lmdbench
