// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/mesh_limits.h>
#include <lmdbench/catalogue/shape_recipe.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/mesh/flaws.h>
#include <lmdbench/mesh/placement.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace lmdbench {

namespace {

// Reads a recipe's keys, each within its range, and remembers the unused ones.
class Recipe {
 public:
  Recipe(const nlohmann::json& json, const std::string& file, const std::string& pointer)
      : json_(json), file_(file), pointer_(pointer) {}

  double number(const char* key, double least, double below = std::numeric_limits<double>::infinity()) {
    const nlohmann::json& value = at(key);
    if (!value.is_number()) fail(key, "is not a number", "write a number");
    const double result = value.get<double>();
    if (!(result >= least && result < below))
      fail(key, fmt::format("is {}", result), fmt::format("give at least {} and less than {}", least, below));
    return result;
  }
  double length(const char* key) {
    const double result = number(key, 0.0);
    if (!(result > 0.0)) fail(key, "is not positive", "give a length in metres");
    return result;
  }
  int integer(const char* key, int least, int most) {
    const nlohmann::json& value = at(key);
    const bool in_range =
        value.is_number_integer() && value.get<std::int64_t>() >= least && value.get<std::int64_t>() <= most;
    if (!in_range)
      fail(key, fmt::format("is {}", value.dump()),
           fmt::format("give an integer from {} to {}", least, most));
    return value.get<int>();
  }
  Vec3 lengths(const char* key) {
    const nlohmann::json& value = at(key);
    Vec3 result = Vec3::Zero();
    const bool sound = value.is_array() && value.size() == 3;
    for (int i = 0; sound && i < 3; ++i)
      result[i] = value[static_cast<std::size_t>(i)].is_number()
                      ? value[static_cast<std::size_t>(i)].get<double>()
                      : 0.0;
    if (!sound || !(result.minCoeff() > 0.0))
      fail(key, "is not three positive lengths", "write [x, y, z] in metres");
    return result;
  }
  Eigen::Quaterniond rotation(const char* key) {
    const nlohmann::json& value = at(key);
    std::array<double, 4> xyzw{};
    bool sound = value.is_array() && value.size() == 4;
    for (std::size_t i = 0; sound && i < 4; ++i) {
      sound = value[i].is_number();
      if (sound) xyzw[i] = value[i].get<double>();
    }
    Eigen::Quaterniond result(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    if (!sound || !(result.norm() > 0.5 && result.norm() < 2.0))
      fail(key, "is not a rotation", "write a unit quaternion [x, y, z, w]");
    return result;
  }
  /// Outline from a recipe at the key.
  Outline outline(const char* key, int around);
  bool has(const char* key) const { return json_.contains(key); }
  /// A recipe within this one.
  TriangleMesh shape(const char* key) { return make_shape(at(key), file_, pointer_ + "/" + key); }
  void finish() const {
    for (const auto& [key, value] : json_.items())
      if (key != "kind" && !used_.contains(key))
        fail(key, "is not a parameter of this shape", fmt::format("it has {}", fmt::join(used_, ", ")));
  }

  [[noreturn]] void fail(const std::string& key, const std::string& problem,
                         const std::string& remedy) const {
    throw InputError(file_, pointer_ + "/" + key, problem, remedy);
  }

 private:
  const nlohmann::json& at(const char* key) {
    used_.insert(key);
    if (!json_.contains(key)) fail(key, "is missing", "the shape needs it");
    return json_.at(key);
  }
  const nlohmann::json& json_;
  std::string file_, pointer_;
  std::set<std::string> used_;
};

Outline Recipe::outline(const char* key, int around) {
  const nlohmann::json& json = at(key);
  const std::string kind = json.is_object() ? json.value("kind", std::string{}) : std::string{};
  Recipe own(json, file_, pointer_ + "/" + key);
  const auto must_divide = [&](int divisor) {
    if (around % divisor != 0)
      fail("around", fmt::format("is {}", around),
           fmt::format("the {} needs a multiple of {}", key, divisor));
  };
  Outline result;
  if (kind == "circle") {
    const double radius = own.length("radius");
    result = circle_outline(radius, json.contains("under") ? own.outline("under", around) : Outline());
  } else if (kind == "polygon") {
    const int sides = own.integer("sides", 3, 1000);
    must_divide(sides);
    result = polygon_outline(sides, own.length("inradius"));
  } else if (kind == "gear") {
    const int teeth = own.integer("teeth", 8, 1000);
    must_divide(2 * teeth);
    if (around < 4 * teeth)
      fail("around", fmt::format("is {}", around), fmt::format("the {} needs at least {}", key, 4 * teeth));
    const double module = own.length("module");
    result = gear_outline(teeth, module, own.number("backlash", 0.0, 0.2 * module));
  } else if (kind == "thread") {
    const double radius = own.length("radius");
    result = thread_outline(radius, own.number("depth", 0.0, radius), own.length("pitch"));
  } else {
    own.fail("kind", fmt::format("there is no outline '{}'", kind),
             "choose one of circle, gear, polygon, thread");
  }
  own.finish();
  return result;
}

using Maker = std::function<TriangleMesh(Recipe&)>;

// Upper limits keep a typing error from filling the memory: about five million triangles.
const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table{
      {"sphere", [](Recipe& r) { return make_sphere(r.length("radius"), r.integer("subdivisions", 0, 9)); }},
      {"box", [](Recipe& r) { return make_box(r.lengths("size"), r.integer("cells", 1, 600)); }},
      {"torus",
       [](Recipe& r) {
         const double ring_radius = r.length("ring_radius");
         return make_torus(ring_radius,
                           r.number("tube_radius", std::numeric_limits<double>::min(), ring_radius),
                           r.integer("ring_cells", 3, 2000), r.integer("tube_cells", 3, 1000));
       }},
      {"blob",
       [](Recipe& r) {
         const double radius = r.length("radius");
         return make_blob(radius, r.number("bump_height", 0.0, radius), r.integer("subdivisions", 0, 9));
       }},
      {"unequal",
       [](Recipe& r) {
         return make_unequal(r.length("radius"), r.integer("cells", 2, 600), r.number("ratio", 1.001, 1e6));
       }},
      {"needles",
       [](Recipe& r) {
         return make_needles(r.length("radius"), r.length("height"), r.integer("count", 3, 100000),
                             r.number("groove", 0.0, 1.0));
       }},
      {"caps",
       [](Recipe& r) {
         return make_caps(r.length("radius"), r.length("height"), r.integer("count", 3, 100000));
       }},
      {"patch",
       [](Recipe& r) {
         return make_patch(r.length("size"), r.integer("cells", 1, 1500), r.number("wave_height", 0.0));
       }},
      {"wedge",
       [](Recipe& r) { return make_wedge(r.length("width"), r.length("length"), r.length("height")); }},
      {"l-block", [](Recipe& r) { return make_l_block(r.length("size")); }},
      {"sleeve",
       [](Recipe& r) {
         SleeveChoice choice;
         choice.height = r.length("height");
         choice.around = r.integer("around", 3, 100000);
         choice.layers = r.integer("layers", 1, 10000);
         choice.rings = r.integer("rings", 1, 1000);
         if (static_cast<std::int64_t>(choice.around) * (choice.layers + choice.rings) > 1250000)
           r.fail("around",
                  fmt::format("and layers make {} squares",
                              choice.around * static_cast<std::int64_t>(choice.layers + choice.rings)),
                  "give at most 1,250,000");
         const Outline outline = r.outline("outline", choice.around);
         return make_sleeve(outline, r.has("bore") ? r.outline("bore", choice.around) : Outline(), choice);
       }},
      {"floats", [](Recipe& r) { return turned_to_floats(r.shape("of"), r.rotation("rotation_xyzw")); }},
      {"two-boxes", [](Recipe& r) { return make_two_boxes(r.lengths("size"), r.length("gap")); }},
      {"holes", [](Recipe& r) { return with_holes(r.shape("of"), r.integer("every", 2, 1000000)); }},
      {"duplicates",
       [](Recipe& r) { return with_duplicates(r.shape("of"), r.integer("every", 1, 1000000)); }},
      {"flips", [](Recipe& r) { return with_flips(r.shape("of"), r.integer("every", 1, 1000000)); }},
      {"fins",
       [](Recipe& r) {
         return with_fins(r.shape("of"), r.integer("every", 1, 1000000), r.length("height"));
       }},
      {"zero-areas",
       [](Recipe& r) { return with_zero_areas(r.shape("of"), r.integer("every", 1, 1000000)); }}};
  return table;
}

}  // namespace

TriangleMesh make_shape(const nlohmann::json& recipe, const std::string& file, const std::string& pointer) {
  const bool names_kind = recipe.is_object() && recipe.contains("kind") && recipe["kind"].is_string();
  const std::string kind = names_kind ? recipe["kind"].get<std::string>() : std::string{};
  const auto maker = makers().find(kind);
  if (maker == makers().end()) {
    std::vector<std::string> kinds;
    for (const auto& [name, unused] : makers()) kinds.push_back(name);
    throw InputError(file, pointer + "/kind", fmt::format("there is no shape '{}'", kind),
                     fmt::format("choose one of {}", fmt::join(kinds, ", ")));
  }
  Recipe reader(recipe, file, pointer);
  // C++ may evaluate a call's arguments in any order, so the error may name any of the bad keys.
  TriangleMesh mesh = maker->second(reader);
  reader.finish();
  // Copies of copies double at every step; lengths may be any positive numbers.
  check_mesh_limits(mesh, file);
  refuse_extreme_size(mesh, file);
  return mesh;
}

}  // namespace lmdbench
