// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// One question to a plugin's method, and the answer.
struct PluginFinding {
  enum class Verdict { PASSED, NOTED, FAILED };
  std::string method;
  std::string question;
  Verdict verdict = Verdict::PASSED;
  std::string answer;
};

/// Runs a plugin's methods, each in its own process, on made scenes (round, dented and flat shapes;
/// apart, near and intersecting), in less than a minute. The questions:
///
/// 1. does it answer every pose: points on the meshes, no pair twice, nearest first, and a force
///    where it has its own;
/// 2. does it leave rounding and flush-to-zero unchanged;
/// 3. are contacts and force the same for repeated, reversed, shuffled poses and a new instance;
/// 4. and for renumbered vertices, triangles, corners, and another frame of the moving mesh;
/// 5. does it keep its promise against exhaustive truth, and what does it miss without one;
/// 6. how long does a pose take in the plugin, and the exchange with its process.
/// @param seconds for all searches; a slower method gets fewer poses, and questions are left out
/// @throws InputError where the plugin cannot be loaded
std::vector<PluginFinding> check_plugin(const std::filesystem::path& file, double seconds = 40.0);

}  // namespace lmdbench
