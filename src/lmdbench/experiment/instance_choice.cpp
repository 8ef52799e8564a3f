// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/experiment/instance_choice.h>
#include <lmdbench/motion/tum_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace lmdbench {

namespace {

/// A larger number is likely a mistake.
constexpr std::int64_t MOST_INSTANCES = 1000000;

}  // namespace

InstanceChoice read_instance_choice(const nlohmann::json& entry, const std::string& place,
                                    const std::filesystem::path& file) {
  const std::string rule = entry["rule"].get<std::string>();
  /// The one of `file`, `counts` and `count` that says how many there are.
  const auto needs = [&](const std::string& key, const char* example) {
    if (!entry.contains(key))
      throw UsageError(file.string(), place, fmt::format("the rule \"{}\" needs \"{}\"", rule, key), example);
    for (const char* other : {"file", "counts", "count"})
      if (key != other && entry.contains(other))
        throw UsageError(file.string(), place,
                         fmt::format("the rule \"{}\" has no \"{}\", only \"{}\"", rule, other, key),
                         "leave it out, or choose another rule");
  };
  InstanceChoice choice;
  if (rule == "list") {
    needs("file", "name a file of poses, one a line: x y z qx qy qz qw");
    choice.file = shortened(file.parent_path() / entry["file"].get<std::string>());
    return choice;
  }
  choice.rule.spacing = entry["spacing_diagonals"].get<double>();
  choice.rule.turned = entry["turned"].get<bool>();
  choice.rule.seed = entry["seed"].get<std::uint64_t>();
  if (rule == "grid") {
    needs("counts", R"(say how many along x, y and z, as in "counts": [10, 10, 1])");
    choice.rule.rule = Scatter::Rule::GRID;
    choice.rule.counts = entry["counts"].get<std::array<std::int64_t, 3>>();
    choice.rule.count = choice.rule.counts[0] * choice.rule.counts[1] * choice.rule.counts[2];
  } else {
    needs("count", R"(say how many, as in "count": 100)");
    choice.rule.rule = rule == "random" ? Scatter::Rule::RANDOM : Scatter::Rule::PILE;
    choice.rule.count = entry["count"].get<std::int64_t>();
  }
  if (choice.rule.count > MOST_INSTANCES)
    throw UsageError(file.string(), place,
                     fmt::format("{} instances, above the limit of {}", choice.rule.count, MOST_INSTANCES),
                     "ask for fewer");
  return choice;
}

std::vector<Pose> parse_pose_list(const std::string& text, const std::string& name) {
  std::vector<Pose> poses;
  std::size_t columns = 0;
  for_each_number_line(
      text, name, "write x y z qx qy qz qw, in metres and as a unit quaternion",
      [&](const std::string& place, std::span<const double> n) {
        const std::size_t count = n.size();
        if (!poses.empty() && count != columns)
          throw InputError(name, place, fmt::format("{} numbers, {} in the lines above", count, columns),
                           "give every line as many: a time in all, or in none");
        columns = count;
        if (count == 8) n = n.subspan(1);
        if (n.size() != 7)
          throw InputError(name, place, fmt::format("{} numbers", count),
                           "write x y z qx qy qz qw, or a time before them");
        Pose pose{Vec3(n[0], n[1], n[2]), Eigen::Quaterniond(n[6], n[3], n[4], n[5])};
        if (!(std::abs(pose.rotation.norm() - 1.0) <= QUATERNION_LENGTH_TOLERANCE))
          throw InputError(
              name, place,
              fmt::format("quaternion of length {:.6g}: an instance has no scale of its own",
                          pose.rotation.norm()),
              "give a unit quaternion in the order x, y, z, w; scale the mesh (\"scale\", \"diagonal_m\")");
        pose.rotation.normalize();
        poses.push_back(pose);
      });
  if (poses.empty()) throw InputError(name, "", "has no pose", "write one a line: x y z qx qy qz qw");
  return poses;
}

std::vector<Pose> instance_poses(const InstanceChoice& choice, const MeshBounds& bounds) {
  if (choice.file.empty()) return scatter(choice.rule, bounds);
  return parse_pose_list(read_input_file(choice.file, {.what = "list of poses"}).bytes, choice.file.string());
}

}  // namespace lmdbench
