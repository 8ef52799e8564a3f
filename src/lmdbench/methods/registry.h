// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/build_info.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/scene.h>

#include <nlohmann/json.hpp>

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// The methods of this build. Drivers, tests, benchmarks and reports take all from here and their
/// descriptions.
namespace lmdbench {

/// In the order of reports. References stay valid when methods are added.
const std::deque<MethodDescription>& method_descriptions();

/// Adds a method from outside (plugin/plugin.h), last in reports. For the start of a program.
void add_method(MethodDescription method);

/// A method that this build was made without, and the part of it that is missing.
struct MissingMethod {
  std::string_view name;
  OptionalPart part;
};
const std::vector<MissingMethod>& missing_methods();

/// Names of the methods that there are, for messages.
std::vector<std::string> method_names();

/// @throws UsageError for an unknown name, with the nearest or known ones; EnvironmentError for one
/// that this build lacks
/// @param file,place where the name stands, for the message
const MethodDescription& method_description(std::string_view name, const std::string& file = "",
                                            const std::string& place = "method");

/// Place in the order of reports, and of colours: a method looks the same in all figures.
std::size_t method_order(std::string_view name);

/// Checks options against the method's schema and fills in the defaults.
/// @param file for the message
/// @throws UsageError naming the option at fault
nlohmann::json complete_options(const MethodDescription& description, nlohmann::json options,
                                const std::string& file);

/// Makes a method on a scene (scene/scene_search.h).
/// @param options need not name those that keep their defaults
/// @throws UsageError for a name or option; InputError for hubs that may meet (VERTEX_PAIRS)
std::unique_ptr<Method> make_method(std::string_view name, const Scene& scene,
                                    const nlohmann::json& options = nlohmann::json::object());

/// For `--help`: a paragraph a method, with its options, their values and defaults.
std::string methods_help();

}  // namespace lmdbench
