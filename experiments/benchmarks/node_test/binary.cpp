// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/node_test/binary.h>

namespace lmdbench::experiments {

std::vector<std::vector<std::int32_t>> paths_to_triangles(const Hierarchy& hierarchy) {
  std::vector<std::vector<std::int32_t>> paths((hierarchy.nodes.size() + 1) / 2);
  std::vector<std::vector<std::int32_t>> stack = {{0}};
  while (!stack.empty()) {
    const std::vector<std::int32_t> path = stack.back();
    stack.pop_back();
    const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(path.back())];
    if (node.is_leaf()) {
      paths.at(static_cast<std::size_t>(node.triangle)) = path;
      continue;
    }
    for (std::int32_t child = node.first_child; child <= node.first_child + 1; ++child) {
      stack.push_back(path);
      stack.back().push_back(child);
    }
  }
  return paths;
}

}  // namespace lmdbench::experiments
