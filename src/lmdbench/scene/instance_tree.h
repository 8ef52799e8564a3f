// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace lmdbench {

/// Boost.Geometry's R-tree over boxes of instances, packed when made, in single precision rounded
/// outwards: 28 bytes an instance, and nodes. Chosen by measurement (`lmdbench-study worlds
/// --broad-phase`). Answers do not depend on the order of boxes.
class InstanceTree {
 public:
  /// @param boxes one an instance, which is named by its index
  explicit InstanceTree(std::span<const Eigen::AlignedBox3d> boxes);
  ~InstanceTree();
  InstanceTree(InstanceTree&& other) noexcept;
  InstanceTree& operator=(InstanceTree&& other) noexcept;

  /// Gives an instance another box.
  /// @param from the box that it has
  void move(std::uint32_t instance, const Eigen::AlignedBox3d& from, const Eigen::AlignedBox3d& to);

  /// Instances whose boxes touch `box`, ascending, with a few beside it by rounding.
  void touching(const Eigen::AlignedBox3d& box, std::vector<std::uint32_t>& instances) const;

  /// Calls visit(instance, bound) by the distance of boxes from the point, until false; `bound` [m]
  /// is a lower bound of that distance, and of all later ones.
  void by_distance(const Eigen::Vector3d& point,
                   const std::function<bool(std::uint32_t instance, double bound)>& visit) const;

  std::size_t size() const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace lmdbench
