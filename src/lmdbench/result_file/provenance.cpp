// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/result_file/machine_info.h>
#include <lmdbench/result_file/provenance.h>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <ctime>

namespace lmdbench {

namespace {

/// "2026-11-20T04:15:00Z": ISO 8601, whole seconds.
std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

void write_inputs(ResultWriter& writer, const std::vector<InputFile>& inputs) {
  std::vector<std::string> roles;
  std::vector<std::string> files;
  std::vector<std::string> hashes;
  std::vector<std::int64_t> sizes;
  for (const InputFile& input : inputs) {
    roles.push_back(input.role);
    files.push_back(input.file.generic_string());
    hashes.push_back(input.sha256);
    sizes.push_back(input.size);
  }
  writer.write({"/provenance/inputs/role", "1", "what the file is to the experiment"}, roles);
  writer.write({"/provenance/inputs/file", "1", "path of the file as the run named it"}, files);
  writer.write({"/provenance/inputs/sha256", "1", "SHA-256 of the bytes that were read"}, hashes);
  writer.write({"/provenance/inputs/size", "byte", "length of the file"}, sizes, {sizes.size()});
}

}  // namespace

void write_provenance(ResultWriter& writer, const std::vector<std::string>& argv,
                      const std::string& experiment_json, const std::string& plan_json,
                      const std::vector<InputFile>& inputs) {
  const BuildInfo& build = build_info();
  writer.attribute("/", "format", RESULT_FORMAT);
  writer.attribute("/", "format_version", std::int64_t{RESULT_FORMAT_VERSION});
  writer.attribute("/", "creator", "lmdbench " + build.version);
  writer.attribute("/", "created_utc", utc_now());

  const std::string group = "/provenance";
  writer.attribute(group, "program_version", build.version);
  writer.attribute(group, "git_commit", build.git_commit);
  writer.attribute(group, "git_dirty", build.git_dirty);
  writer.attribute(group, "compiler", build.compiler);
  writer.attribute(group, "compiler_flags", build.compiler_flags);
  writer.attribute(group, "build_type", build.build_type);
  writer.attribute(group, "target", build.target);
  for (const auto& [name, version] : build.libraries) writer.attribute(group + "/libraries", name, version);
  for (const auto& [name, value] : machine_info()) writer.attribute(group + "/machine", name, value);

  writer.write({group + "/argv", "1", "command line of the run, argument by argument"}, argv);
  writer.write({group + "/experiment", "1", "the experiment with every default filled in, JSON"},
               {experiment_json});
  writer.write({group + "/plan", "1", "what the run did and left out, JSON"}, {plan_json});
  write_inputs(writer, inputs);
}

}  // namespace lmdbench
