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

/// A method of a plugin and its two meshes.
struct PluginTask {
  std::filesystem::path file;
  std::uint32_t method = 0;
  bool trusted = false;  ///< In this process.
  std::shared_ptr<const Body> a, b;
  double cutoff = 0.0;  ///< [m]
  std::string options;  ///< JSON object
};

/// A plugin's answer, not yet checked.
struct PluginAnswer {
  /// Unset: no answer. It crashed, took too long, threw or reported failure: see `lost`.
  std::optional<PluginReply> reply;
  std::string lost;
  std::span<const lmdbench_contact> contacts;  ///< Valid until the next call; none if too_many.
  bool too_many = false;
};

/// Turns a reply into an answer.
/// @param contacts where the plugin wrote them
void judge_reply(const PluginReply& reply, const lmdbench_contact* contacts, PluginAnswer& answer);

/// Where a plugin runs.
class PluginCaller {
 public:
  virtual ~PluginCaller() = default;
  /// @param X_BA twelve numbers, as in lmdbench_method.h
  virtual PluginAnswer search(const double* X_BA) = 0;
  /// In `create`, of the last start.
  virtual double seconds_to_make() const = 0;
};

/// Runs it in a process of its own, started at the first call (or by `make_child_caller`, so that
/// no frame pays for it) and ended where a call takes longer than `Limit::PLUGIN_SECONDS`. A lost
/// call restarts it for the next one, RESTARTS times; then every call is lost.
/// `Limit::PLUGIN_BYTES` bounds its memory. No sandbox against malice: the process is this user's.
///
/// posix_spawn and not Boost.Process: a child forked from a program with threads could not use what
/// these had locked (oneTBB of Embree); it sets limits, files and shared memory itself.
std::unique_ptr<PluginCaller> make_child_caller(const PluginTask& task);

/// In this process, for trusted plugins: it can crash the program. Short overruns are noticed.
/// @throws InputError where the plugin cannot be loaded
std::unique_ptr<PluginCaller> make_direct_caller(PluginTask task);

/// A plugin's description of itself, asked in its own process: {"methods": [{"name", "version",
/// "summary", "promise", "flags", "own_force", "options" (text), "counters"}]}.
/// @throws InputError where it cannot be loaded, crashes, takes too long or answers unreadably;
///         EnvironmentError where the child program is missing
std::string describe_plugin(const std::filesystem::path& file);

}  // namespace lmdbench
