// SPDX-License-Identifier: 0BSD
// From a class to the functions of lmdbench_method.h: catches exceptions, fits the host's room.
#pragma once

#include "lmdbench_method.h"

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace plugin {

/// Method: a constructor (const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const
/// std::string& options) that copies what it keeps and may throw; void search(const double* X_BA,
/// std::vector<lmdbench_contact>&). Own force, of the last search: void force(double wrench[6]).
template <class Method>
struct Functions {
  struct Instance {
    Method method;
    std::vector<lmdbench_contact> contacts;
  };

  static int32_t create(const lmdbench_mesh* a, const lmdbench_mesh* b, double cutoff, const char* options,
                        void** instance, char* message, uint64_t message_size) {
    const char* why = "unknown failure";
    std::string text;
    try {
      *instance = new Instance{Method(*a, *b, cutoff, options), {}};
      return 0;
    } catch (const std::exception& error) {
      text = error.what();
      why = text.c_str();
    } catch (...) {
    }
    if (message_size > 0) message[std::string(why).copy(message, message_size - 1)] = '\0';
    return 1;
  }
  static int32_t search(void* instance, const double* X_BA, lmdbench_contact* contacts, uint64_t capacity,
                        uint64_t* needed) {
    try {
      auto& self = *static_cast<Instance*>(instance);
      self.contacts.clear();
      self.method.search(X_BA, self.contacts);
      *needed = self.contacts.size();
      std::copy_n(self.contacts.begin(), std::min<uint64_t>(capacity, *needed), contacts);
      return 0;
    } catch (...) {
      return 1;
    }
  }
  static void destroy(void* instance) { delete static_cast<Instance*>(instance); }

  /// A method without extensions or memory of earlier frames.
  static constexpr lmdbench_method described(const char* name, const char* version, const char* text,
                                             int32_t promise, const char* options = nullptr) {
    return {
        sizeof(lmdbench_method), name, version, text, promise, 0, options, create, search, destroy, nullptr};
  }
  static constexpr lmdbench_method with_force(lmdbench_method method) {
    method.extension = [](const char* id) -> const void* {
      static constexpr lmdbench_force FORCE = {sizeof(lmdbench_force), read_force};
      return std::string_view(id) == LMDBENCH_EXTENSION_FORCE ? &FORCE : nullptr;
    };
    return method;
  }
  static int32_t read_force(void* instance, double* wrench) {
    try {
      static_cast<Instance*>(instance)->method.force(wrench);
      return 0;
    } catch (...) {
      return 1;
    }
  }
};

/// The entry of a plugin of one method.
template <const lmdbench_method& METHOD>
constexpr lmdbench_method_entry_type entry_of() {
  return {LMDBENCH_METHOD_ABI_MAJOR, LMDBENCH_METHOD_ABI_MINOR, sizeof(lmdbench_method_entry_type),
          [](uint32_t index) -> const lmdbench_method* { return index == 0 ? &METHOD : nullptr; }};
}

}  // namespace plugin
