// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/message_of.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const char* const MINIMAL = R"({
  "name": "small",
  "moving": {"mesh": "a"},
  "fixed": [{"mesh": "b"}],
  "path": {"file": "paths/p.tum"},
  "force": {"cutoff_m": 0.01, "maximum_force_n": 2},
  "methods": [{"name": "original", "force_law": "linear"}, {"name": "improved", "force_law": "exponential"}]
})";

Experiment parse(const std::string& text, const std::vector<Override>& overrides = {}) {
  return parse_experiment(text, "/data/e.json", overrides);
}

/// Message of the usage error of loading.
std::string message(const std::vector<Override>& overrides, const std::string& text = MINIMAL) {
  return testing::message_of<UsageError>([&] { parse(text, overrides); });
}

TEST(LoadExperiment, FillsDefaultsFromTheSchema) {
  const Experiment experiment = parse(MINIMAL);
  EXPECT_EQ(experiment.name, "small");
  EXPECT_EQ(experiment.frame_rate_hz, 1000.0);
  EXPECT_FALSE(experiment.frames.has_value());
  EXPECT_EQ(experiment.device, "phantom-desktop");
  EXPECT_EQ(experiment.profiles[0].sharpness, 4.0);
  EXPECT_EQ(experiment.driver.repetitions, 5);
  EXPECT_EQ(experiment.driver.block_frames, 200);
  EXPECT_EQ(experiment.probe_stride("truth"), 100);
  EXPECT_EQ(experiment.probe_stride("fcl"), 0);
  EXPECT_EQ(experiment.probes.at("fcl").options["tolerance_relative"], 1e-6);
  EXPECT_FALSE(experiment.record_lmds);
  EXPECT_TRUE(experiment.objects[1].pose.translation.isZero(0.0));
  ASSERT_EQ(experiment.methods.size(), 2u);
  EXPECT_EQ(experiment.methods[0].label, "original");
  EXPECT_EQ(experiment.methods[0].force_law, ForceLaw::LINEAR);
  EXPECT_EQ(experiment.methods[1].options["visibility"], "vertex-normal");
}

TEST(LoadExperiment, ResolvedJsonHasTheDefaultsAndResolvesToItself) {
  const Experiment experiment = parse(MINIMAL);
  const auto resolved = nlohmann::json::parse(experiment.resolved_json);
  EXPECT_EQ(resolved["driver"]["block_frames"], 200);
  EXPECT_EQ(resolved["methods"][0]["line_cone"], "one-sided");
  EXPECT_FALSE(resolved["methods"][1].contains("line_cone")) << "an option of the original only";
  EXPECT_EQ(parse(experiment.resolved_json).resolved_json, experiment.resolved_json);
}

TEST(LoadExperiment, PathIsRelativeToTheExperimentFile) {
  EXPECT_EQ(parse(MINIMAL).held().motion.path_file, std::filesystem::path("/data/paths/p.tum"));
  EXPECT_EQ(parse(MINIMAL, {R"(/path/file="/elsewhere/q.tum")"}).held().motion.path_file,
            std::filesystem::path("/elsewhere/q.tum"));
}

TEST(LoadExperiment, OverridesTakeJsonOrStrings) {
  const Experiment experiment = parse(
      MINIMAL, {"/driver/repetitions=3", "/name=other", "/methods/0/line_cone=two-sided",
                R"(/methods/-={"name":"exhaustive","force_law":"linear","label":"truth"})", "/title=a=b"});
  EXPECT_EQ(experiment.driver.repetitions, 3);
  EXPECT_EQ(experiment.name, "other");
  EXPECT_EQ(experiment.methods[0].options["line_cone"], "two-sided");
  EXPECT_EQ(experiment.methods.at(2).label, "truth");
  EXPECT_EQ(experiment.title, "a=b") << "only the first = separates";
  EXPECT_THAT(message({"driver/repetitions=3"}), HasSubstr("--set driver/repetitions=3: not of the form"));
}

TEST(LoadExperiment, EveryMethodOptionIsRead) {
  const Experiment experiment = parse(
      MINIMAL,
      {"/methods/0/literal_g3=true", "/methods/1/visibility=orthogonal", "/methods/1/reduction=loss-free",
       "/methods/1/tracking_order=triangle-index", "/methods/1/literal_g3=true",
       "/methods/1/search_threads=2",
       R"(/methods/-={"name":"certified","force_law":"linear","frame_coherence":false,"kernel":"sse4"})"});
  EXPECT_EQ(experiment.methods[0].options["literal_g3"], true);
  // What the file leaves out has its default.
  EXPECT_EQ(experiment.methods[1].options, nlohmann::json({{"visibility", "orthogonal"},
                                                           {"reduction", "loss-free"},
                                                           {"tracking_order", "triangle-index"},
                                                           {"literal_g3", true},
                                                           {"leaf_cones", "one-ring"},
                                                           {"clamped_sigma", false},
                                                           {"plain_cache", false},
                                                           {"search_threads", 2},
                                                           {"second_tracking", true}}));
  EXPECT_EQ(experiment.methods[2].options, nlohmann::json({{"frame_coherence", false}, {"kernel", "sse4"}}));
}

/// The schema has every method of the registry, with the defaults of its description and no others.
TEST(LoadExperiment, OptionsOfMethodsAreThoseOfTheirDescriptions) {
  for (const MethodDescription& method : method_descriptions()) {
    const MethodChoice choice =
        parse(MINIMAL, {"/methods/0/name=" + method.name, "/methods/0/label=it"}).methods[0];
    EXPECT_EQ(choice.options, complete_options(method, {}, "")) << method.name;
    EXPECT_EQ(choice.options.size(), method.options.size()) << method.name;
    EXPECT_EQ(nlohmann::json::parse(choice.options_json).size(), method.options.size() + 3)
        << "name, label and force_law besides";
    EXPECT_THAT(message({"/methods/0/name=" + method.name, "/methods/0/no_such_option=1"}),
                HasSubstr("/methods/0/no_such_option: unknown key"));
  }
}

TEST(LoadExperiment, UnknownKeysNameTheirPointerAndTheNearestKey) {
  EXPECT_THAT(message({"/driver/repetition=3"}),
              AllOf(HasSubstr("/data/e.json: /driver/repetition: unknown key"),
                    HasSubstr("did you mean \"repetitions\"?")));
  EXPECT_THAT(message({"/methods/1/visibilty=off"}), AllOf(HasSubstr("/methods/1/visibilty: unknown key"),
                                                           HasSubstr("did you mean \"visibility\"?")));
  EXPECT_THAT(message({"/zzz=1"}), AllOf(HasSubstr("/zzz: unknown key"), HasSubstr("known keys here: ")));
  EXPECT_THAT(message({"/fixed/0/pose={\"rotation_wxyz\": [1,0,0,0]}"}),
              AllOf(HasSubstr("/fixed/0/pose/rotation_wxyz: unknown key"), HasSubstr("rotation_xyzw")));
}

TEST(LoadExperiment, OptionsOfAnotherMethodAreRefused) {
  EXPECT_THAT(message({"/methods/1/g5_tolerance_deg=10"}),
              AllOf(HasSubstr("/methods/1/g5_tolerance_deg"),
                    HasSubstr("only where \"name\" is one of [\"original\"]")));
}

TEST(LoadExperiment, SchemaViolationsNamePointerValueAndExpectation) {
  EXPECT_THAT(message({"/driver/repetitions=0"}),
              AllOf(HasSubstr("/driver/repetitions: "), HasSubstr("found 0"), HasSubstr("integer >= 1")));
  EXPECT_THAT(message({"/driver/repetitions=2.5"}), HasSubstr("/driver/repetitions: "));
  EXPECT_THAT(message({"/force/cutoff_m=0"}), AllOf(HasSubstr("/force/cutoff_m: "), HasSubstr("number > 0")));
  EXPECT_THAT(message({"/force/cutoff_m=-0.1"}), HasSubstr("/force/cutoff_m: "));
  EXPECT_THAT(message({"/force/cutoff_m=\"wide\""}), HasSubstr("/force/cutoff_m: "));
  EXPECT_THAT(message({"/methods/0/force_law=cubic"}),
              AllOf(HasSubstr("/methods/0/force_law: "), HasSubstr("[\"linear\",\"exponential\"]")));
  EXPECT_THAT(message({"/methods=[]"}), HasSubstr("/methods: "));
  EXPECT_THAT(message({"/fixed=[]"}), HasSubstr("/fixed: "));
  EXPECT_THAT(message({"/driver/kind=sundial"}),
              AllOf(HasSubstr("/driver/kind: "), HasSubstr("lockstep"), HasSubstr("realtime")));
  EXPECT_THAT(message({"/name=has blank"}), HasSubstr("/name: "));
  EXPECT_THAT(message({"/methods/0/label=a/b"}), HasSubstr("/methods/0/label: "));
  EXPECT_THAT(message({}, R"({"name": "x"})"),
              AllOf(HasSubstr("Missing required property"), HasSubstr("remedy: ")));
  EXPECT_THAT(message({}, "[1, 2]"), HasSubstr("/data/e.json: / (line 1): "));
}

TEST(LoadExperiment, SyntaxErrorsNameLineAndColumn) {
  EXPECT_THAT(message({}, "{\n  \"name\": \"x\",\n  oops\n}"),
              HasSubstr("/data/e.json: line 3, column 3: not JSON"));
  EXPECT_THAT(message({}, ""), HasSubstr("line 1"));
  EXPECT_THAT(message({}, R"({"frame_rate_hz": 1e999})"), HasSubstr("out of range"));
  EXPECT_THAT(message({}, R"({"name": "x", "title": {"a": 1}, "name": "y"})"),
              HasSubstr("e.json: /name (line 1): key \"name\" appears twice"));
}

TEST(LoadExperiment, ForceConstantsMustFitTogether) {
  EXPECT_FALSE(parse(MINIMAL, {R"(/force={"maximum_force_n": 1})"}).profiles[0].cutoff(1.0).has_value())
      << "the scene decides";
  EXPECT_THAT(message({"/force/saturation_m=0.01"}), HasSubstr("/force/saturation_m: saturation at 0.01 m"));
  EXPECT_THAT(message({"/force/saturation_m=0.001", "/force/saturation_cutoff=0.5"}),
              HasSubstr("/force: \"saturation_cutoff\" and \"saturation_m\" exclude each other"));
  EXPECT_THAT(message({"/force/saturation_cutoff=1"}), HasSubstr("/force/saturation_cutoff: "));
}

TEST(LoadExperiment, AnOverrideTakesThePlaceOfWhatTheSchemaSaysItExcludes) {
  const Experiment experiment = parse(MINIMAL, {"/force/cutoff_diagonal=0.1"});
  EXPECT_EQ(experiment.profiles[0].cutoff_diagonal, 0.1);
  EXPECT_FALSE(experiment.profiles[0].cutoff_m.has_value());
  EXPECT_THAT(experiment.notes,
              ElementsAre("/force/cutoff_diagonal takes the place of /force/cutoff_m, which is "
                          "0.01 in the file"));
  EXPECT_THAT(experiment.resolved_json, Not(HasSubstr("cutoff_m")));
  EXPECT_THAT(parse(MINIMAL, {"/force/cutoff_m=0.1"}).notes, IsEmpty());
  const std::string listed = R"({"moving": {"mesh": "a", "scale": 2}, "fixed": [{"mesh": "b"}],
      "force": [{"name": "x", "saturation_cutoff": 0.5}],
      "movers": [{"mesh": "c", "path": {"turn_rad": 1, "seed": 3}}]})";
  const Experiment several = parse(listed, {"/force/0/saturation_m=0.001", "/force/0/cutoff_m=0.1",
                                            "/moving/diagonal_m=1", "/movers/0/path/file=p.tum"});
  EXPECT_EQ(several.profiles[0].saturation_m, 0.001);
  EXPECT_EQ(several.notes.size(), 4u) << "a saturation, a scale, and two of how it sways";
}

TEST(LoadExperiment, KeysThatExcludeEachOtherAreRefused) {
  EXPECT_THAT(message({"/force/cutoff_m=0.1", "/force/cutoff_diagonal=0.1"}),
              AllOf(HasSubstr("/force: \"cutoff_diagonal\" and \"cutoff_m\" exclude each other"),
                    HasSubstr("at most one")))
      << "of two overrides neither is meant to go";
  for (
      const char* entry :
      {R"("moving": {"mesh": "a", "scale": 2, "diagonal_m": 3}, "fixed": [{"mesh": "b"}])",
       R"("moving": {"mesh": "a"}, "fixed": [{"mesh": "b", "scale": 2, "diagonal_m": 3}])",
       R"("moving": {"mesh": "a"}, "fixed": [{"mesh": "b"}], "movers": [{"mesh": "c", "path": {"file": "p", "seed": 1}}])",
       R"("moving": {"mesh": "a", "deformation": {"files": ["b"], "folder": "c"}}, "fixed": [{"mesh": "b"}])"})
    EXPECT_THAT(message({}, fmt::format("{{{}}}", entry)), HasSubstr(" exclude each other")) << entry;
}

TEST(LoadExperiment, ForceDistancesScaleWithTheDiagonal) {
  const Experiment experiment = parse(
      MINIMAL, {R"(/force={"cutoff_diagonal": 0.05, "saturation_cutoff": 0.25, "maximum_force_n": 1})"});
  EXPECT_DOUBLE_EQ(experiment.profiles[0].cutoff(2.0).value(), 0.1);
  EXPECT_DOUBLE_EQ(experiment.profiles[0].saturation(0.1), 0.025);
  EXPECT_DOUBLE_EQ(parse(MINIMAL).profiles[0].cutoff(2.0).value(), 0.01);
  EXPECT_EQ(parse(MINIMAL).profiles[0].saturation(2.0), 0.0);
}

TEST(LoadExperiment, UnknownMethodsAndRepeatedLabelsAreRefused) {
  EXPECT_THAT(message({"/methods/1/name=improvd"}),
              AllOf(HasSubstr("/methods/1/name: unknown method"), HasSubstr("did you mean \"improved\"?")));
  EXPECT_THAT(message({"/methods/1/label=original"}), HasSubstr("/methods/1/label: two methods are called"));
}

TEST(LoadExperiment, OneMethodMayAppearTwiceUnderTwoLabels) {
  const Experiment experiment = parse(
      MINIMAL, {"/methods/1/name=original", "/methods/1/label=strict", "/methods/1/g5_tolerance_deg=180"});
  EXPECT_EQ(experiment.methods[1].name, "original");
  EXPECT_EQ(experiment.methods[1].label, "strict");
  EXPECT_EQ(experiment.methods[1].options["g5_tolerance_deg"], 180);
}

TEST(LoadExperiment, LatencyIsAtMostTheSearchPeriod) {
  EXPECT_THAT(message({"/driver/search_every_frames=5", "/driver/search_latency_frames=6"}),
              HasSubstr("/driver/search_latency_frames: a search takes 6 frames"));
  EXPECT_EQ(parse(MINIMAL, {"/driver/search_every_frames=5", "/driver/search_latency_frames=5"})
                .driver.search_latency_frames,
            5);
}

TEST(LoadExperiment, FixedPoseIsAUnitQuaternion) {
  EXPECT_THAT(message({"/fixed/0/pose/rotation_xyzw=[0,0,0,2]"}),
              HasSubstr("/fixed/0/pose/rotation_xyzw: quaternion of length 2"));
  EXPECT_THAT(message({"/fixed/0/pose/rotation_xyzw=[0,0,0,0]"}), HasSubstr("quaternion of length 0"));
  EXPECT_THAT(message({"/fixed/0/pose/translation_m=[0,0]"}), HasSubstr("/fixed/0/pose/translation_m: "));
  const Experiment experiment =
      parse(MINIMAL, {"/fixed/0/pose/rotation_xyzw=[0,0,1,0]", "/fixed/0/pose/translation_m=[1,2,3]"});
  EXPECT_EQ(experiment.objects[1].pose.rotation.z(), 1.0);
  EXPECT_EQ(experiment.objects[1].pose.translation, Vec3(1, 2, 3));
}

TEST(LoadExperiment, PlanarTolerancesAreOfEachMesh) {
  using Kind = PlanarTolerance::Kind;
  const Experiment untouched = parse(MINIMAL);
  EXPECT_EQ(untouched.held().planar_tolerance.kind, Kind::AUTO);
  const Experiment experiment =
      parse(MINIMAL, {"/moving/planar_tolerance=1e-6", "/fixed/0/planar_tolerance=off"});
  EXPECT_EQ(experiment.held().planar_tolerance, (PlanarTolerance{Kind::LENGTH, 1e-6}));
  EXPECT_EQ(experiment.objects[1].planar_tolerance, (PlanarTolerance{Kind::LENGTH, 0.0}));
  EXPECT_EQ(parse(MINIMAL, {"/moving/planar_tolerance=0.01%"}).held().planar_tolerance.kind, Kind::DIAGONAL);
  EXPECT_THAT(message({"/fixed/0/planar_tolerance=wide"}),
              HasSubstr("/fixed/0/planar_tolerance: 'wide' is no planar tolerance"));
  EXPECT_THAT(message({"/moving/planar_tolerance=-1"}), HasSubstr("/moving/planar_tolerance"));
  EXPECT_THAT(message({"/moving/planar_tolerance=[1]"}), HasSubstr("/moving/planar_tolerance"));
}

TEST(LoadExperiment, MissingFileIsAUsageError) {
  EXPECT_THAT(testing::message_of<UsageError>([] { load_experiment("/nowhere/at/all.json"); }),
              HasSubstr("/nowhere/at/all.json: cannot read"));
}

}  // namespace
}  // namespace lmdbench
