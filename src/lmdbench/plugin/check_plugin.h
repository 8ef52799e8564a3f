// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// One question to a method from outside.
struct PluginFinding {
  enum class Verdict { PASSED, NOTED, FAILED };
  std::string method;
  std::string question;
  Verdict verdict = Verdict::PASSED;
  std::string answer;
};

/// Puts a plugin's methods, in processes of their own, to scenes that this program makes (shapes round, dented and flat; apart, near and
/// through each other), in less than a minute:
///
/// 1. does it answer every pose, with points that are on the meshes, no pair twice, nearest first, with a force where
///    it has its own;
/// 2. does it leave rounding and flush-to-zero as they were;
/// 3. are its contacts, and its own force, the same when the poses come again, backwards and shuffled, and from a new instance;
/// 4. are they when vertices, triangles and corners are counted in another order, and when the moving mesh has another frame;
/// 5. does it keep its promise against exhaustive truth, and what does it miss where it makes none;
/// 6. how long does a pose take in the plugin, and the way to its process and back.
/// @throws InputError where it cannot be loaded
std::vector<PluginFinding> check_plugin(const std::filesystem::path& file);

}  // namespace lmdbench
