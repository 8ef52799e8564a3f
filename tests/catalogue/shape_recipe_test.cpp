// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shape_recipe.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/mesh/flaws.h>

#include "support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace lmdbench {
namespace {

using testing::message_of;

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

TriangleMesh make(const std::string& recipe) {
  return make_shape(json::parse(recipe), "m.json", "/meshes/x/shape");
}

void expect_same(const std::string& recipe, const TriangleMesh& wanted) {
  const TriangleMesh made = make(recipe);
  EXPECT_EQ(made.vertices, wanted.vertices) << recipe;
  EXPECT_EQ(made.triangles, wanted.triangles) << recipe;
}

TEST(ShapeRecipeTest, PassesItsParametersOn) {
  expect_same(R"({"kind":"sphere","radius":0.5,"subdivisions":2})", make_sphere(0.5, 2));
  expect_same(R"({"kind":"box","size":[1,2,3],"cells":2})", make_box({1, 2, 3}, 2));
  expect_same(R"({"kind":"torus","ring_radius":0.4,"tube_radius":0.1,"ring_cells":8,"tube_cells":5})",
              make_torus(0.4, 0.1, 8, 5));
  expect_same(R"({"kind":"blob","radius":1,"bump_height":0.2,"subdivisions":1})", make_blob(1, 0.2, 1));
  expect_same(R"({"kind":"unequal","radius":1,"cells":5,"ratio":50})", make_unequal(1, 5, 50));
  expect_same(R"({"kind":"needles","radius":1,"height":3,"count":7,"groove":0.2})",
              make_needles(1, 3, 7, 0.2));
  expect_same(R"({"kind":"patch","size":2,"cells":3,"wave_height":0.1})", make_patch(2, 3, 0.1));
  expect_same(R"({"kind":"wedge","width":1,"length":2,"height":3})", make_wedge(1, 2, 3));
  expect_same(R"({"kind":"l-block","size":2})", make_l_block(2));
  expect_same(R"({"kind":"two-boxes","size":[1,2,3],"gap":0.5})", make_two_boxes({1, 2, 3}, 0.5));
  expect_same(R"({"kind":"caps","radius":1,"height":2,"count":12})", make_caps(1, 2, 12));
  expect_same(
      R"({"kind":"floats","rotation_xyzw":[0.6,0,0,0.8],"of":{"kind":"box","size":[1,2,3],"cells":2}})",
      turned_to_floats(make_box({1, 2, 3}, 2), Eigen::Quaterniond(0.8, 0.6, 0.0, 0.0)));
  const SleeveChoice sleeve{.height = 2, .around = 48, .layers = 3, .rings = 2};
  const std::string rest = R"(,"height":2,"around":48,"layers":3,"rings":2})";
  expect_same(
      R"({"kind":"sleeve","outline":{"kind":"polygon","sides":6,"inradius":2},"bore":{"kind":"circle","radius":1})" +
          rest,
      make_sleeve(polygon_outline(6, 2), circle_outline(1), sleeve));
  expect_same(R"({"kind":"sleeve","outline":{"kind":"gear","teeth":12,"module":0.5,"backlash":0.01})" + rest,
              make_sleeve(gear_outline(12, 0.5, 0.01), nullptr, sleeve));
  expect_same(R"({"kind":"sleeve","outline":{"kind":"thread","radius":1,"depth":0.2,"pitch":0.5})" + rest,
              make_sleeve(thread_outline(1, 0.2, 0.5), nullptr, sleeve));
}

TEST(ShapeRecipeTest, MakesFlawsInOtherShapes) {
  const std::string of = R"("of":{"kind":"l-block","size":1}})";
  expect_same(R"({"kind":"holes","every":3,)" + of, with_holes(make_l_block(1), 3));
  expect_same(R"({"kind":"duplicates","every":4,)" + of, with_duplicates(make_l_block(1), 4));
  expect_same(R"({"kind":"flips","every":5,)" + of, with_flips(make_l_block(1), 5));
  expect_same(R"({"kind":"fins","every":6,"height":0.5,)" + of, with_fins(make_l_block(1), 6, 0.5));
  expect_same(R"({"kind":"zero-areas","every":7,)" + of, with_zero_areas(make_l_block(1), 7));
}

struct BadRecipe {
  std::string name, recipe, place, says;
};

class BadRecipeTest : public ::testing::TestWithParam<BadRecipe> {};

TEST_P(BadRecipeTest, IsRefusedWithItsKey) {
  EXPECT_THAT(
      message_of<InputError>([] { make(GetParam().recipe); }),
      AllOf(HasSubstr("m.json: /meshes/x/shape/" + GetParam().place + ":"), HasSubstr(GetParam().says)));
}

INSTANTIATE_TEST_SUITE_P(
    Recipes, BadRecipeTest,
    ::testing::Values(
        BadRecipe{"unknown", R"({"kind":"teapot"})", "kind", "choose one of"},
        BadRecipe{"no_kind", R"({"radius":1})", "kind", "choose one of"},
        BadRecipe{"kind_is_a_number", R"({"kind":3})", "kind", "choose one of"},
        BadRecipe{"missing", R"({"kind":"sphere","radius":1})", "subdivisions", "is missing"},
        BadRecipe{"extra", R"({"kind":"l-block","size":1,"color":"red"})", "color", "not a parameter"},
        BadRecipe{"zero", R"({"kind":"l-block","size":0})", "size", "not positive"},
        BadRecipe{"text", R"({"kind":"l-block","size":"1"})", "size", "not a number"},
        BadRecipe{"too_many", R"({"kind":"sphere","radius":1,"subdivisions":30})", "subdivisions",
                  "from 0 to 9"},
        BadRecipe{"fraction", R"({"kind":"sphere","radius":1,"subdivisions":1.5})", "subdivisions", "1.5"},
        BadRecipe{"within", R"({"kind":"holes","every":2,"of":{"kind":"l-block","size":0}})", "of/size",
                  "not positive"},
        BadRecipe{"flat", R"({"kind":"box","size":[1,1,0],"cells":1})", "size", "three positive"},
        BadRecipe{"planar", R"({"kind":"box","size":[1,1],"cells":1})", "size", "three positive"},
        BadRecipe{"outline",
                  R"({"kind":"sleeve","height":1,"around":8,"layers":1,"rings":1,"outline":{"kind":"egg"}})",
                  "outline/kind", "circle, gear, polygon, thread"},
        BadRecipe{
            "outline_key",
            R"({"kind":"sleeve","height":1,"around":8,"layers":1,"rings":1,"outline":{"kind":"circle","size":1}})",
            "outline/radius", "is missing"},
        BadRecipe{
            "around",
            R"({"kind":"sleeve","height":1,"around":9,"layers":1,"rings":1,"outline":{"kind":"polygon","sides":4,"inradius":1}})",
            "around", "multiple of 4"},
        BadRecipe{
            "thin_teeth",
            R"({"kind":"sleeve","height":1,"around":16,"layers":1,"rings":1,"outline":{"kind":"gear","teeth":8,"module":1,"backlash":0}})",
            "around", "at least 32"},
        BadRecipe{
            "squares",
            R"({"kind":"sleeve","height":1,"around":1000,"layers":5000,"rings":1,"outline":{"kind":"circle","radius":1}})",
            "around", "at most"},
        BadRecipe{"rotation",
                  R"({"kind":"floats","rotation_xyzw":[0,0,0,0],"of":{"kind":"l-block","size":1}})",
                  "rotation_xyzw", "unit quaternion"},
        BadRecipe{"fat_torus",
                  R"({"kind":"torus","ring_radius":1,"tube_radius":2,"ring_cells":9,"tube_cells":9})",
                  "tube_radius", "is 2"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(ShapeRecipeTest, CopiesOfCopiesAndHugeLengthsEndAtALimit) {
  std::string copies = R"({"kind":"sphere","radius":1,"subdivisions":2})";
  for (int i = 0; i < 30; ++i) copies = R"({"kind":"duplicates","every":1,"of":)" + copies + "}";
  EXPECT_THAT(message_of<InputError>([&] { make(copies); }), HasSubstr("--limit edge-triangles="));
  EXPECT_THAT(message_of<InputError>([] { make(R"({"kind":"sphere","radius":1e308,"subdivisions":1})"); }),
              HasSubstr("overflow"));
}

}  // namespace
}  // namespace lmdbench
