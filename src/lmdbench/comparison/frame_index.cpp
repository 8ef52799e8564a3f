// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/frame_index.h>

#include <algorithm>
#include <vector>

namespace lmdbench {
namespace {

std::size_t rows_of(const ResultReader& file, const std::string& path) {
  if (!file.has(path)) return 0;
  const std::vector<std::size_t> shape = file.shape(path);
  return shape.empty() ? 0 : shape.front();
}

std::optional<std::int64_t> entry(const ResultReader& file, const std::string& path, std::size_t row) {
  const std::vector<std::int64_t> frames = file.integers(path);
  if (row >= frames.size()) return std::nullopt;
  return frames[row];
}

}  // namespace

std::optional<std::int64_t> frame_of_row(const ResultReader& file, const std::string& group,
                                         const std::string& dataset, std::size_t row) {
  const std::string path = group + "/" + dataset;
  const std::string own_group = path.substr(0, path.rfind('/'));
  const std::string name = path.substr(own_group.size() + 1);
  if (own_group.ends_with("/summary")) return std::nullopt;
  if (name == "frame_offset") return static_cast<std::int64_t>(row) - 1;  // entry f + 1 closes frame f
  if (file.has(own_group + "/frame_offset")) {
    const std::vector<std::int64_t> offsets = file.integers(own_group + "/frame_offset");
    const auto after = std::upper_bound(offsets.begin(), offsets.end(), static_cast<std::int64_t>(row));
    return static_cast<std::int64_t>(after - offsets.begin()) - 1;
  }
  if (file.has(own_group + "/frame")) return entry(file, own_group + "/frame", row);
  const std::size_t rows = rows_of(file, path);
  if (rows == rows_of(file, "/path/time")) return static_cast<std::int64_t>(row);
  if (rows == rows_of(file, group + "/global_frame")) return entry(file, group + "/global_frame", row);
  return std::nullopt;
}

}  // namespace lmdbench
