// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/methods/improved/improved.h>
#include <lmdbench/methods/original/original.h>
#include <lmdbench/methods/registry.h>

#include <algorithm>
#include <array>
#include <string>

namespace lmdbench {

namespace {

struct Registration {
  std::string_view name;
  std::unique_ptr<Method> (*make)(const Scene& scene, const MethodOptions& options);
};

/// A new method is a line here.
constexpr std::array REGISTRY{
    Registration{"original",
                 [](const Scene& scene, const MethodOptions& options) -> std::unique_ptr<Method> {
                   return std::make_unique<Original>(scene, options);
                 }},
    Registration{"improved",
                 [](const Scene& scene, const MethodOptions& options) -> std::unique_ptr<Method> {
                   return std::make_unique<Improved>(scene, options);
                 }},
    Registration{"certified",
                 [](const Scene& scene, const MethodOptions& options) -> std::unique_ptr<Method> {
                   return std::make_unique<Certified>(scene, options);
                 }},
    Registration{"exhaustive",
                 [](const Scene& scene, const MethodOptions&) -> std::unique_ptr<Method> {
                   return std::make_unique<Exhaustive>(scene);
                 }},
};

}  // namespace

const std::vector<std::string_view>& method_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> result;
    for (const Registration& registration : REGISTRY) result.push_back(registration.name);
    return result;
  }();
  return names;
}

std::unique_ptr<Method> make_method(std::string_view name, const Scene& scene, const MethodOptions& options) {
  const auto found = std::find_if(REGISTRY.begin(), REGISTRY.end(), [&](const Registration& registration) {
    return registration.name == name;
  });
  if (found != REGISTRY.end()) return found->make(scene, options);
  std::string known;
  for (const std::string_view other : method_names())
    known += (known.empty() ? "" : ", ") + std::string(other);
  throw UsageError("", "method", "there is no method '" + std::string(name) + "'", "choose one of: " + known);
}

}  // namespace lmdbench
