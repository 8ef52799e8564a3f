// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/machine_differences.h>

#include <fmt/format.h>

namespace lmdbench {
namespace {

constexpr const char* MACHINE = "/provenance/machine";

/// What decides how fast the same instructions run. Not the number of usable processors, memory or kernel: they move
/// times by less than the noise.
constexpr const char* DECISIVE[] = {"processor",
                                    "processor_family_model_stepping",
                                    "logical_processors",
                                    "simd",
                                    "virtual_machine",
                                    "l1_data_cache_bytes",
                                    "l2_cache_bytes",
                                    "l3_cache_bytes",
                                    "frequency_governor",
                                    "frequency_boost",
                                    "simultaneous_multithreading"};

void compare_attribute(const ResultReader& a, const ResultReader& b, const std::string& group,
                       const std::string& name, std::vector<std::string>& differences) {
  const std::string first = a.text_attribute(group, name).value_or("unknown");
  const std::string second = b.text_attribute(group, name).value_or("unknown");
  if (first != second) differences.push_back(fmt::format("{}: '{}' and '{}'", name, first, second));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_of(const ResultReader& file) {
  std::vector<std::pair<std::string, std::string>> facts;
  for (const std::string& name : file.attributes(MACHINE))
    facts.emplace_back(name, file.text_attribute(MACHINE, name).value_or("unknown"));
  return facts;
}

std::vector<std::string> machine_differences(const ResultReader& a, const ResultReader& b) {
  std::vector<std::string> differences;
  for (const char* name : DECISIVE) compare_attribute(a, b, MACHINE, name, differences);
  return differences;
}

std::vector<std::string> build_differences(const ResultReader& a, const ResultReader& b) {
  std::vector<std::string> differences;
  for (const char* name : {"compiler", "compiler_flags", "build_type"})
    compare_attribute(a, b, "/provenance", name, differences);
  for (const std::string& library : a.attributes("/provenance/libraries"))
    compare_attribute(a, b, "/provenance/libraries", library, differences);
  for (const char* name : {"kernel", "operating_system"}) compare_attribute(a, b, MACHINE, name, differences);
  return differences;
}

}  // namespace lmdbench
