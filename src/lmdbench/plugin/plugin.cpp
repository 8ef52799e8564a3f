// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_schema.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/base/own_time.h>
#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/plugin/judged_contacts.h>
#include <lmdbench/plugin/plugin.h>
#include <lmdbench/plugin/plugin_caller.h>
#include <lmdbench/scene/scene_search.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <regex>
#include <utility>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

std::array<double, 12> rows_of(const RigidTransform& X) {
  std::array<double, 12> rows{};
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows.data()) << X.rotation, X.translation;
  return rows;
}

/// Option of every method with a force of its own.
constexpr const char* OWN_FORCE = "own_force";

/// A plugin's method of two bodies.
class PluginMethod : public Method, public HasOwnWrench {
 public:
  /// @param of_pair `Scene::is_pair`
  PluginMethod(std::shared_ptr<const MethodDescription> description, const Scene& of_pair,
               std::uint32_t index, PluginTrust trust, const Json& options)
      : description_(std::move(description)),
        shows_own_force_(description_->has_own_force() && options.at(OWN_FORCE).get<bool>()),
        judge_(of_pair.moving, of_pair.fixed.front().body) {
    Json of_plugin = options;
    of_plugin.erase(OWN_FORCE);
    PluginTask task{.file = description_->plugin,
                    .method = index,
                    .a = of_pair.moving,
                    .b = of_pair.fixed.front().body,
                    .cutoff = of_pair.cutoff,
                    .options = of_plugin.dump()};
    // Meshes that deform have it made anew in every frame: `create` is its work, and loading it or
    // starting a process is none.
    const auto begin = std::chrono::steady_clock::now();
    caller_ = trust == PluginTrust::TRUSTED ? make_direct_caller(std::move(task)) : make_child_caller(task);
    seconds_of_others() += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() -
                           caller_->seconds_to_make();
  }

  const MethodDescription& description() const override { return *description_; }

  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    double in_plugin = std::numeric_limits<double>::quiet_NaN();
    own_ = {.about = X_WM.translation};
    const RigidTransform X(X_WM);
    const std::array<double, 12> X_BA = rows_of(X);
    const PluginAnswer answer = caller_->search(X_BA.data());
    if (answer.reply) {
      in_plugin = answer.reply->seconds;
      counters[PluginMark::TOO_MANY] += answer.too_many ? 1U : 0U;
      counters[PluginMark::FLOAT_MODE] += answer.reply->changed_float_mode;
      constexpr auto FIRST = static_cast<std::size_t>(PluginMark::FIRST_OF_ITS_OWN);
      for (std::size_t c = FIRST; c < description_->counters.size(); ++c)
        counters.values[c] += answer.reply->counters[c - FIRST];
      if (description_->has_own_force()) add_force(answer.reply->wrench, counters);
      lmds.clear();
      if (description_->promise != Promise::FORCE_ONLY) judge_.judge(answer.contacts, X, lmds, counters);
      if (description_->promise == Promise::NEAREST_PAIR && lmds.size() > 1) lmds.resize(1);
    } else {
      lmds.clear();
      ++counters[PluginMark::LOST];
      description_->faults->tell(answer.lost);
    }
    // A frame's time is that in the plugin. Sending poses and judging answers is this program's.
    // Without an answer the frame has no time, however soon a plugin fails.
    const double others = std::chrono::duration<double>(Clock::now() - begin).count() - in_plugin;
    seconds_of_others() += others < 0.0 ? 0.0 : others;
  }

  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }

  std::optional<OwnWrench> own_wrench(std::size_t /*mover*/) const override {
    return shows_own_force_ ? std::optional(own_) : std::nullopt;
  }

 private:
  void add_force(const std::array<double, 6>& wrench, WorkCounters& counters) {
    const Eigen::Map<const Vec3> force(wrench.data()), torque(wrench.data() + 3);
    if (!force.allFinite() || !torque.allFinite()) {
      ++counters[PluginMark::FORCE_WRONG];
      return;
    }
    own_.force += force;
    own_.torque += torque;
  }

  std::shared_ptr<const MethodDescription> description_;
  bool shows_own_force_;
  OwnWrench own_;
  ContactJudge judge_;
  std::unique_ptr<PluginCaller> caller_;
};

/// The checks that a test makes of the registry's own methods.
Json checked_options(const std::string& text, const std::string& file, const std::string& place) {
  const auto fail = [&](const std::string& why) -> void {
    throw InputError(file, place, why,
                     "give \"type\" or \"enum\", \"description\" and \"default\" to each option");
  };
  Json options;
  try {
    options = parse_json(text, file);
  } catch (const UsageError& error) {
    fail(std::string("its options are no JSON: ") + error.what());
  }
  if (!options.is_object()) fail("its options are no JSON object");
  // The validator follows them without end.
  if (options.dump().find("\"$ref\"") != std::string::npos) fail("its options refer to another schema");
  Json defaults = Json::object();
  for (const auto& [name, option] : options.items()) {
    const bool taken = name == "name" || name == "label" || name == "force_law" || name == OWN_FORCE;
    if (taken) fail(fmt::format("option \"{}\": experiments use this name for something else", name));
    if (!option.is_object() || !option.contains("default") ||
        !option.value("description", Json()).is_string() ||
        !(option.contains("enum") || option.value("type", Json()).is_string()))
      fail(fmt::format("option \"{}\" is incomplete", name));
    defaults[name] = option["default"];
  }
  try {
    validate_against_schema(defaults, {{"type", "object"}, {"properties", options}}, file);
  } catch (const std::exception& error) {  // the validator's own, too: options may be no schema
    fail(std::string("its own defaults break its options: ") + error.what());
  }
  return options;
}

MethodDescription description_of(const Json& method, const std::filesystem::path& file, std::uint32_t index,
                                 PluginTrust trust) {
  const std::string place = fmt::format("method {}", index);
  const auto fail = [&](const std::string& why, const std::string& remedy) {
    throw InputError(file.string(), place, why, remedy);
  };
  MethodDescription description;
  description.name = method["name"].get<std::string>();
  static const std::regex NAME("[A-Za-z][A-Za-z0-9_-]{0,40}"), COUNTER("[a-z][a-z0-9_]{0,40}");
  if (!std::regex_match(description.name, NAME))
    fail("its name is not of up to 41 letters, digits, '-' and '_'", "call it otherwise");
  description.summary = method["summary"].get<std::string>();
  const auto promise = method["promise"].get<std::int64_t>();
  if (promise < LMDBENCH_PROMISE_COMPLETE_SET || promise > LMDBENCH_PROMISE_FORCE_ONLY)
    fail(fmt::format("promises {}, which is nothing that this program knows", promise),
         "take one of LMDBENCH_PROMISE_...");
  description.promise = promise == LMDBENCH_PROMISE_COMPLETE_SET    ? Promise::COMPLETE_SET
                        : promise == LMDBENCH_PROMISE_APPROXIMATION ? Promise::APPROXIMATION
                        : promise == LMDBENCH_PROMISE_NEAREST_PAIR  ? Promise::NEAREST_PAIR
                                                                    : Promise::FORCE_ONLY;
  // A process serves a pair of meshes in any pose; state kept from one pose harms no other.
  description.frame_coherent = (method["flags"].get<std::uint32_t>() & LMDBENCH_KEEPS_FRAMES) != 0;
  description.options = checked_options(method["options"].get<std::string>(), file.string(), place);
  if (method["own_force"].get<bool>())
    description.options[OWN_FORCE] = {
        {"type", "boolean"},
        {"description", "render the method's own force, not the experiment's law over its contacts"},
        {"default", true}};
  description.counters = plugin_marks();
  for (const Json& counter : method["counters"]) {
    const std::string name = counter["name"].get<std::string>();
    const auto has_it = [&](const std::vector<CounterDescription>& counters) {
      return std::ranges::find(counters, name, &CounterDescription::name) != counters.end();
    };
    const bool taken = has_it(description.counters) || has_it(over_scene({}).counters);
    if (taken || !std::regex_match(name, COUNTER))
      fail(fmt::format("its counter \"{}\" is not of up to 41 small letters, digits and '_', or taken", name),
           "call it otherwise");
    description.counters.emplace_back(static_cast<PluginMark>(description.counters.size()), name,
                                      counter["summary"].get<std::string>(), CountedBy::SEARCH);
  }
  description.plugin = std::filesystem::absolute(file);
  description.faults = std::make_shared<MethodFaults>();
  // The description holds `make`, which must therefore not hold it.
  const auto shared = std::make_shared<const MethodDescription>(description);
  description.make = [shared, index, trust](const Scene& scene,
                                            const Json& options) -> std::unique_ptr<Method> {
    return std::make_unique<PluginMethod>(shared, scene, index, trust, options);
  };
  return description;
}

}  // namespace

std::vector<MethodDescription> plugin_methods(const std::filesystem::path& file, PluginTrust trust) {
  // A bare name would be looked for among the system's libraries.
  const std::string text = describe_plugin(std::filesystem::absolute(file));
  std::vector<MethodDescription> methods;
  try {
    const Json json = Json::parse(text);
    for (const Json& method : json.at("methods"))
      methods.push_back(description_of(method, file, static_cast<std::uint32_t>(methods.size()), trust));
  } catch (const Json::exception&) {
    throw InputError(file.string(), "", "says of itself what cannot be read", "see lmdbench_method.h");
  }
  std::vector<std::string> names = method_names();
  for (const MethodDescription& method : methods) {
    if (std::ranges::find(names, method.name) != names.end())
      throw InputError(file.string(), "", fmt::format("there is a method \"{}\" already", method.name),
                       "give the plugin's method another name");
    names.push_back(method.name);
  }
  return methods;
}

void add_plugin(const std::filesystem::path& file, PluginTrust trust) {
  for (MethodDescription& method : plugin_methods(file, trust)) add_method(std::move(method));
}

}  // namespace lmdbench
