// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/plugin/lmdbench_method.h>

#include <array>
#include <cstdint>
#include <string>

/// A plugin in this process, behind calls that check what can be checked here. The child process
/// uses it and, for trusted plugins, the program itself. It needs only the header and dlopen, so
/// that the child is as bare as a plugin may expect.
namespace lmdbench {

/// Holds rounding mode, flush-to-zero and denormals-are-zero as of its construction, and restores
/// them. Loading an object linked with -ffast-math sets these two: exact predicates break silently.
class FloatMode {
 public:
  FloatMode();
  /// @return whether one of them had changed
  bool restore() const;

 private:
  unsigned control_;
  int rounding_;
};

/// Result of a search, without its contacts.
struct PluginReply {
  std::int32_t status = 0;               ///< Returned by the plugin, or one of those below.
  std::uint32_t changed_float_mode = 0;  ///< 1 where the plugin changed it.
  std::uint64_t needed = 0;              ///< Number of contacts found.
  double seconds = 0.0;                  ///< In the plugin.
  std::array<std::uint64_t, LMDBENCH_MOST_COUNTERS> counters{};
  std::array<double, 6> wrench{};  ///< Of a method with a force of its own; NaN where it gave none.

  static constexpr std::int32_t THREW = -1000;
  static constexpr std::int32_t UNSTEADY = -1001;  ///< With more room it had more contacts again.
};

/// A shared object that keeps to the interface as far as its tables tell.
class LoadedPlugin {
 public:
  static constexpr std::uint32_t MOST_METHODS = 64;  ///< Against an endless table.

  /// @throws std::runtime_error saying what is wrong, and what to do, without the file's name
  explicit LoadedPlugin(const std::string& file);
  ~LoadedPlugin();
  LoadedPlugin(const LoadedPlugin&) = delete;
  LoadedPlugin& operator=(const LoadedPlugin&) = delete;

  /// @return null beyond the last
  const lmdbench_method* method(std::uint32_t index) const;
  /// @return null where the method counts nothing
  static const lmdbench_counters* counters(const lmdbench_method& method);
  /// @return null where the method has no force of its own
  static const lmdbench_force* force(const lmdbench_method& method);
  /// Whether loading it changed the float mode, which was put back.
  bool changed_float_mode() const { return changed_float_mode_; }

 private:
  void* handle_ = nullptr;
  const lmdbench_method_entry_type* entry_ = nullptr;
  bool changed_float_mode_ = false;
};

/// A method of a plugin, prepared for two meshes.
class LoadedMethod {
 public:
  /// @throws std::runtime_error with the plugin's message
  LoadedMethod(const lmdbench_method& method, const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff,
               const char* options);
  ~LoadedMethod();
  LoadedMethod(const LoadedMethod&) = delete;
  LoadedMethod& operator=(const LoadedMethod&) = delete;

  /// @param contacts room for `capacity` contacts
  PluginReply search(const double* X_BA, lmdbench_contact* contacts, std::uint64_t capacity);
  bool changed_float_mode() const { return changed_float_mode_; }
  double seconds_to_make() const { return seconds_to_make_; }

 private:
  const lmdbench_method& method_;
  const lmdbench_counters* counters_;
  const lmdbench_force* force_;
  void* instance_ = nullptr;
  bool changed_float_mode_ = false;
  double seconds_to_make_ = 0.0;
};

}  // namespace lmdbench
