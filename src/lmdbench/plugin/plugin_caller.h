// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>
#include <lmdbench/plugin/loaded_plugin.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace lmdbench {

/// A method of a plugin and the two meshes that it is to see.
struct PluginTask {
  std::filesystem::path file;
  std::uint32_t method = 0;
  bool trusted = false;  ///< In this process.
  std::shared_ptr<const Body> a, b;
  double cutoff = 0.0;  ///< [m]
  std::string options;  ///< JSON object
};

/// What a plugin answered; everything in it may be wrong.
struct PluginAnswer {
  /// Unset: no answer. It crashed, took too long, threw, said that it failed; `lost` says which.
  std::optional<PluginReply> reply;
  std::string lost;
  std::span<const lmdbench_contact> contacts;  ///< Valid until the next call. Empty where there are too many.
  bool too_many = false;
};

/// What to make of a reply of this build's own code.
/// @param contacts the plugin's room
void judge_reply(const PluginReply& reply, const lmdbench_contact* contacts, PluginAnswer& answer);

/// Where a plugin runs.
class PluginCaller {
 public:
  virtual ~PluginCaller() = default;
  /// @param X_BA twelve numbers, as in lmdbench_method.h
  virtual PluginAnswer search(const double* X_BA) = 0;
};

/// In a process of its own. It is started at the first call (or by `make_child_caller`, so that no frame pays for it), ended where a
/// call takes longer than `Limit::PLUGIN_SECONDS`, and started anew for the call after one that was lost: RESTARTS times, then every
/// call is lost. It may take `Limit::PLUGIN_BYTES` of memory. That protects results from faults of the plugin; it is no sandbox for
/// a plugin that means harm: the process is this user's.
///
/// Processes are started by posix_spawn, not Boost.Process: a child forked from a program with threads could not use what those had
/// locked (oneTBB of Embree), and limits, closed files and shared memory are the child's own first steps.
std::unique_ptr<PluginCaller> make_child_caller(PluginTask task);

/// In this process, for plugins that are trusted: a crash is the program's. What it writes past the end is noticed where it is little.
/// @throws InputError where the plugin cannot be loaded
std::unique_ptr<PluginCaller> make_direct_caller(PluginTask task);

/// What a plugin says of itself, asked in a process of its own: {"methods": [{"name", "version", "summary", "promise", "flags",
/// "own_force", "options" (text), "counters"}]}.
/// @throws InputError where it cannot be loaded, crashes, takes too long or says nothing readable; EnvironmentError where the child
///         program is missing
std::string describe_plugin(const std::filesystem::path& file);

}  // namespace lmdbench
