// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <support/setting.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Task "node test": may the surfaces below two nodes hold an LMD? An implementation tests the node
/// pairs that a search of its hierarchies meets at the setting's poses, in the same order, so that
/// outcomes mix in the same way.
class NodeTest {
 public:
  virtual ~NodeTest() = default;
  /// The timed work: all tests, once.
  virtual void run() = 0;
  /// Node pairs that a run tests.
  virtual std::size_t pair_count() const = 0;
  /// Node pairs that the last run kept.
  virtual std::size_t survivor_count() const = 0;
  /// Node pairs that hold a true LMD.
  virtual std::size_t needed_count() const = 0;
  /// Runs and compares: with the scalar form bit for bit, where there is one, and with the truth,
  /// because no pair that holds an LMD may be rejected. Empty when nothing is wrong.
  virtual std::string objection() = 0;
};

struct NodeTestImplementation {
  std::string name;
  std::function<std::unique_ptr<NodeTest>(const Setting&)> make;
};

NodeTestImplementation wide_vector_test();
NodeTestImplementation binary_ray_test();

/// All implementations of this build.
std::vector<NodeTestImplementation> node_test_implementations();

}  // namespace lmdbench::experiments
