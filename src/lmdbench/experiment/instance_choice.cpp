// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/experiment/instance_choice.h>
#include <lmdbench/motion/tum_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace lmdbench {

namespace {

/// More are no world for a test, but a mistake in a count.
constexpr std::int64_t MOST_INSTANCES = 1000000;

std::vector<double> numbers_of_line(std::string line, const std::string& name, std::size_t number) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(value))
      throw InputError(name, fmt::format("line {}", number), fmt::format("\"{}\" is no finite number", word),
                       "write x y z qx qy qz qw, in metres and as a unit quaternion");
    numbers.push_back(value);
  }
  return numbers;
}

}  // namespace

InstanceChoice read_instance_choice(const nlohmann::json& entry, const std::string& place,
                                    const std::filesystem::path& file) {
  const std::string rule = entry["rule"].get<std::string>();
  const auto needs = [&](const char* key, const char* example) {
    if (!entry.contains(key))
      throw UsageError(file.string(), place, fmt::format("the rule \"{}\" needs \"{}\"", rule, key), example);
  };
  InstanceChoice choice;
  if (rule == "list") {
    needs("file", "name a file of poses, one a line: x y z qx qy qz qw");
    choice.file = (file.parent_path() / entry["file"].get<std::string>()).lexically_normal();
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
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line.resize(std::min(line.find('#'), line.size()));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<double> n = numbers_of_line(line, name, number);
    if (n.empty()) continue;
    if (n.size() == 8) n.erase(n.begin());
    if (n.size() != 7)
      throw InputError(name, fmt::format("line {}", number), fmt::format("{} numbers", n.size()),
                       "write x y z qx qy qz qw, or a time before them");
    Pose pose{Vec3(n[0], n[1], n[2]), Eigen::Quaterniond(n[6], n[3], n[4], n[5])};
    if (!(std::abs(pose.rotation.norm() - 1.0) <= QUATERNION_LENGTH_TOLERANCE))
      throw InputError(
          name, fmt::format("line {}", number),
          fmt::format("quaternion of length {:.6g}: an instance has no scale of its own",
                      pose.rotation.norm()),
          "give a unit quaternion in the order x, y, z, w; scale the mesh (\"scale\", \"diagonal_m\")");
    pose.rotation.normalize();
    poses.push_back(pose);
  }
  if (poses.empty()) throw InputError(name, "", "has no pose", "write one a line: x y z qx qy qz qw");
  return poses;
}

std::vector<Pose> instance_poses(const InstanceChoice& choice, const MeshBounds& bounds) {
  if (choice.file.empty()) return scatter(choice.rule, bounds);
  return parse_pose_list(read_input_file(choice.file, {.what = "list of poses"}).bytes, choice.file.string());
}

}  // namespace lmdbench
