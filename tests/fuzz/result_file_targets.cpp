// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/limits.h>
#include <lmdbench/result_file/result_reader.h>

#include "promise.h"
#include "targets.h"

#include <filesystem>
#include <optional>
#include <string>

namespace lmdbench::testing {
namespace {

void read_object(const ResultReader& reader, const std::string& path) {
  for (const std::string& name : reader.attributes(path)) {
    const auto kind = reader.attribute_kind(path, name);
    if (kind == ElementKind::TEXT) reader.text_attribute(path, name);
    if (kind == ElementKind::INTEGER) reader.integer_attribute(path, name);
    if (kind == ElementKind::REAL) reader.real_attribute(path, name);
  }
}

void read_group(const ResultReader& reader, const std::string& group, int depth) {
  constexpr int DEEPEST = 5;  // a group may hold itself
  read_object(reader, group.empty() ? "/" : group);
  for (const std::string& name : reader.datasets(group.empty() ? "/" : group)) {
    const std::string dataset = group + "/" + name;
    read_object(reader, dataset);
    reader.shape(dataset);
    if (reader.kind(dataset) == ElementKind::TEXT)
      reader.texts(dataset);
    else
      reader.reals(dataset);
  }
  if (depth < DEEPEST)
    for (const std::string& name : reader.groups(group.empty() ? "/" : group))
      read_group(reader, group + "/" + name, depth + 1);
}

}  // namespace

std::optional<std::string> broken_result(std::string_view bytes) {
  static const bool limited = (set_limit("import-seconds=1"), set_limit("import-bytes=1000000000"), true);
  const std::filesystem::path file = written_file(bytes);
  return broken_unless_refused(file.string(), [&]() -> std::string {
    const ResultReader reader(file);
    if (limited) read_group(reader, "", 0);
    return {};
  });
}

}  // namespace lmdbench::testing
