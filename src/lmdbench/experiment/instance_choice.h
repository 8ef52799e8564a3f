// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/scene/scatter.h>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// `/fixed/.../instances` of an experiment: number and poses of a mesh's copies.
struct InstanceChoice {
  Scatter rule;
  std::filesystem::path file;  ///< Not empty: it has the poses, one a line; `rule` is unused.
};

/// @param entry with its defaults
/// @param place JSON pointer of the entry; `file`, the experiment's, is the base of relative names
/// @throws UsageError for a rule without a needed value, or too many instances
InstanceChoice read_instance_choice(const nlohmann::json& entry, const std::string& place,
                                    const std::filesystem::path& file);

/// A list of poses: a line each, `x y z qx qy qz qw`, metres and unit quaternion, separated by
/// blanks or commas; of eight numbers the first (time, as in TUM) is ignored. `#`: comment.
/// @param name for messages
/// @throws InputError naming the line: wrong count, not finite, no unit quaternion, no pose
std::vector<Pose> parse_pose_list(const std::string& text, const std::string& name);

/// The poses X_WF of the entry's frame.
/// @throws InputError for an unusable list
std::vector<Pose> instance_poses(const InstanceChoice& choice, const MeshBounds& bounds);

}  // namespace lmdbench
