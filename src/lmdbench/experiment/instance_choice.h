// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/scene/scatter.h>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// `/fixed/.../instances` of an experiment: how many of a mesh stand where.
struct InstanceChoice {
  Scatter rule;
  std::filesystem::path file;  ///< Not empty: poses stand there, one a line, and `rule` says nothing.
};

/// @param entry with its defaults
/// @param place JSON pointer of the entry; `file` is the experiment's, whose folder names are relative to
/// @throws UsageError for a rule that lacks what it needs, or too many instances
InstanceChoice read_instance_choice(const nlohmann::json& entry, const std::string& place,
                                    const std::filesystem::path& file);

/// A list of poses: a line each, `x y z qx qy qz qw`, metres and a unit quaternion, separated by blanks or commas; with eight numbers the
/// first (a time, as in TUM files) says nothing. `#` begins a comment.
/// @param name for messages
/// @throws InputError naming the line: not as many numbers, not finite, a quaternion of another length (a pose has no scale), no pose
std::vector<Pose> parse_pose_list(const std::string& text, const std::string& name);

/// The poses X_WF in the frame of the entry.
/// @throws InputError for a list that cannot be used
std::vector<Pose> instance_poses(const InstanceChoice& choice, const MeshBounds& bounds);

}  // namespace lmdbench
