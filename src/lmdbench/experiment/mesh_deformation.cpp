// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/experiment/mesh_deformation.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>

namespace lmdbench {

std::string_view to_string(SequenceEnd end) {
  switch (end) {
    case SequenceEnd::HOLD:
      return "hold";
    case SequenceEnd::REPEAT:
      return "repeat";
    case SequenceEnd::BACK:
      break;
  }
  return "back";
}

MeshDeformation read_mesh_deformation(const nlohmann::json& entry, const std::string& place,
                                      const std::filesystem::path& file) {
  if (!entry.contains("generator") && !entry.contains("files") && !entry.contains("folder"))
    throw UsageError(file.string(), place, "neither a generator nor vertex files",
                     R"(give one, as in "generator": "bend", "amplitude": 0.5)");
  MeshDeformation deformation;
  deformation.experiment = file;
  deformation.place = place;
  if (!entry.contains("generator")) {
    const auto resolved = [&](const std::string& name) { return shortened(file.parent_path() / name); };
    if (entry.contains("folder")) deformation.folder = resolved(entry["folder"].get<std::string>());
    if (entry.contains("files"))
      for (const nlohmann::json& name : entry["files"])
        deformation.files.push_back(resolved(name.get<std::string>()));
    if (entry.contains("interval_s")) deformation.interval_s = entry["interval_s"].get<double>();
    for (const SequenceEnd end : {SequenceEnd::HOLD, SequenceEnd::REPEAT, SequenceEnd::BACK})
      if (entry["end"] == to_string(end)) deformation.end = end;
    return deformation;
  }
  if (!entry.contains("amplitude"))
    throw UsageError(file.string(), place, "a generator without an amplitude",
                     "say how far: radians of bend and twist, diagonals of dent and crumple, a share of the "
                     "size of breathe");
  DeformationChoice& generator = deformation.generator.emplace();
  for (const DeformationKind kind : deformation_kinds())
    if (entry["generator"] == to_string(kind)) generator.kind = kind;
  generator.amplitude = entry["amplitude"].get<double>();
  generator.share = entry["share"].get<double>();
  const nlohmann::json& direction = entry["direction"];
  generator.direction =
      Vec3(direction[0].get<double>(), direction[1].get<double>(), direction[2].get<double>());
  const double length = generator.direction.norm();
  if (!(length > 0.0) || !std::isfinite(length))
    throw UsageError(file.string(), place + "/direction", "a direction without a length",
                     "give one in the mesh's frame, as in [0, 0, 1]");
  generator.seed = entry["seed"].get<std::uint64_t>();
  deformation.period_s = entry["period_s"].get<double>();
  return deformation;
}

std::string to_text(const MeshDeformation& deformation) {
  if (deformation.generator) {
    const DeformationChoice& generator = *deformation.generator;
    return fmt::format("{}, amplitude {:g}, {:g} % of the vertices, period {:g} s", to_string(generator.kind),
                       generator.amplitude, 100.0 * generator.share, deformation.period_s);
  }
  return fmt::format("{}, {} from one to the next, then {}",
                     deformation.folder.empty() ? fmt::format("{} vertex files", deformation.files.size())
                                                : std::string("the vertex files of a folder"),
                     deformation.interval_s ? fmt::format("{:g} s", *deformation.interval_s) : "a frame",
                     to_string(deformation.end));
}

std::vector<std::filesystem::path> vertex_files(const MeshDeformation& deformation) {
  if (deformation.folder.empty()) return deformation.files;
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(deformation.folder, error))
    if (entry.is_regular_file()) files.push_back(entry.path());
  if (error)
    throw InputError(deformation.folder.string(), "", "is no folder that can be read: " + error.message(),
                     "check the name of \"folder\", which is relative to the experiment file");
  if (files.empty())
    throw InputError(deformation.folder.string(), "", "has no file", "put the vertex files there");
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace lmdbench
