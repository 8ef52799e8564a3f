// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/frame_vertices.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/run.h>
#include <lmdbench/view/export_frames.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result/deterministic_datasets.h>
#include <result_file/result_reading.h>
#include <support/committed.h>
#include <support/files.h>
#include <support/message_of.h>
#include <support/same_lmds.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using testing::deterministic_datasets;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using ::testing::Not;
using testing::OpenResult;
using testing::ScratchDirectory;
using testing::SHAPES_FILE;

const char* const DEFORMING_FILE = LMDBENCH_SOURCE_DIR "/experiments/deforming.json";
constexpr const char* BEND =
    R"({"generator":"bend","amplitude":0.6,"share":0.3,"direction":[0.3,-1,0.2],"period_s":0.11})";
constexpr const char* BREATHE = R"({"generator":"breathe","amplitude":0.012,"period_s":0.16})";

/// A small blob that bends along a turned torus that breathes.
Experiment small_run(std::vector<Override> overrides = {}, const std::string& moving = BEND,
                     const std::string& fixed = BREATHE) {
  const auto key = [](const std::string& text) { return text.empty() ? "" : R"(,"deformation":)" + text; };
  overrides.insert(
      overrides.begin(),
      {"/frames=50", "/force/cutoff_diagonal=0.1", "/driver/repetitions=2", "/driver/block_frames=16",
       "/driver/search_every_frames=10", "/driver/search_latency_frames=5", "/record/lmds=true",
       R"(/methods=[{"name":"improved"},{"name":"certified"}])", "/probes/truth/stride_frames=7",
       "/probes/fcl/stride_frames=9", R"(/moving={"mesh":"small-blob","diagonal_m":0.1)" + key(moving) + "}",
       R"(/fixed=[{"mesh":"torus","diagonal_m":0.15,"pose":{"rotation_xyzw":[0,0,0.6,0.8]})" + key(fixed) +
           "}]"});
  return load_experiment(SHAPES_FILE, overrides);
}

RunResult run_to(const Experiment& experiment, const std::filesystem::path& file) {
  return run_experiment_to_file(experiment, file, {"lmdbench", "run"});
}

/// The scene of a frame, with meshes built from scratch.
Scene fresh_scene(const PreparedRun& run, std::int64_t frame) {
  Scene scene = run.scene();
  for (const DeformingBody& body : run.input.motion.deformation->bodies()) {
    TriangleMesh mesh = body.rest->surface().mesh;
    body.vertices->at(frame, mesh.vertices);
    auto fresh = std::make_shared<const Body>("fresh", build_surface(std::move(mesh)));
    if (scene.moving == body.rest) scene.moving = fresh;
    for (FixedBody& fixed : scene.fixed)
      if (fixed.body == body.rest) fixed.body = fresh;
  }
  return scene;
}

TEST(Deforming, TheSetsOfARunAreThoseOfEachFramesMeshes) {
  const ScratchDirectory scratch;
  const Experiment experiment = small_run();
  const RunResult run = run_to(experiment, scratch / "r.h5");
  const MethodRecord& certified = run.records.at(1);
  ASSERT_EQ(certified.label, "certified");
  std::size_t found = 0, differ_from_rest = 0;
  for (std::int64_t frame = 0; frame < 50; ++frame) {
    const Scene scene = fresh_scene(run.prepared, frame);
    const Pose& pose = run.prepared.input.poses[static_cast<std::size_t>(frame)];
    const LmdSet fresh = lmds_at(*make_method("certified", scene), pose);
    const LmdSet rest = lmds_at(*make_method("certified", run.prepared.scene()), pose);
    const LmdSet& kept = certified.lmds.at(frame);
    testing::expect_same_lmds(kept, fresh, "frame " + std::to_string(frame));
    found += fresh.size();
    differ_from_rest +=
        fresh.size() != rest.size() || (!fresh.empty() && fresh[0].distance != rest[0].distance);
    EXPECT_EQ(run.in_contact[static_cast<std::size_t>(frame)], !fresh.empty()) << "frame " << frame;
  }
  EXPECT_GT(found, 60u) << "or this says nothing";
  EXPECT_GT(differ_from_rest, 40u) << "or the meshes hardly deform";
}

TEST(Deforming, TruthAndFclSeeEachFramesMeshes) {
  const ScratchDirectory scratch;
  const RunResult run = run_to(small_run(), scratch / "r.h5");
  const OpenResult result(scratch / "r.h5");
  EXPECT_THAT(result.doubles("/methods/certified/truth/recall"), Each(1.0));
  EXPECT_THAT(result.doubles("/methods/certified/truth/precision"), Each(1.0));
  EXPECT_EQ(run.tracks.front().truth()->frames.size(),
            result.doubles("/methods/certified/truth/recall").size());
  EXPECT_GT(run.tracks.front().truth()->frames.size(), 5u);
  for (const TruthFrame& truth : run.tracks.front().truth()->frames) {
    const LmdSet lmds = lmds_at(*make_method("exhaustive", fresh_scene(run.prepared, truth.frame)),
                                run.prepared.input.poses[static_cast<std::size_t>(truth.frame)]);
    ASSERT_EQ(truth.lmds.size(), lmds.size()) << "frame " << truth.frame;
    for (std::size_t i = 0; i < lmds.size(); ++i) EXPECT_EQ(truth.lmds[i].distance, lmds[i].distance);
  }
  ASSERT_TRUE(run.tracks.front().fcl() != nullptr);
  EXPECT_GT(run.tracks.front().fcl()->frames.size(), 4u);
  for (const FclFrame& frame : run.tracks.front().fcl()->frames) {
    EXPECT_TRUE(frame.agrees) << "frame " << frame.frame << ", " << frame.relative_difference;
    EXPECT_LT(std::abs(frame.method_difference.at(1)), 1e-6) << "certified, frame " << frame.frame;
  }
}

TEST(Deforming, TheResultSaysWhatMovedAndWhatFollowingTook) {
  const ScratchDirectory scratch;
  const RunResult run = run_to(small_run(), scratch / "r.h5");
  const OpenResult result(scratch / "r.h5");
  const auto moved = result.integers("/scene/moving/deformation/moved_vertices");
  ASSERT_EQ(moved.size(), 50u);
  EXPECT_EQ(moved[0], 0) << "the mesh begins at rest";
  EXPECT_GT(moved[1], 20);
  EXPECT_LT(moved[1], 80) << "three tenths of 162";
  EXPECT_EQ(result.integers("/scene/fixed_0/deformation/moved_vertices")[1], 2048);
  EXPECT_GT(result.doubles("/scene/fixed_0/deformation/largest_move")[1], 0.0);
  EXPECT_NEAR(result.real_attribute("/scene/fixed_0", "farthest_m"), 0.012 * 0.0521, 1e-5);
  const auto following = result.doubles("/methods/certified/following_time");
  const auto all = result.doubles("/methods/certified/local_update_time");
  ASSERT_EQ(following.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_GT(following[i], 0.0);
    EXPECT_LT(following[i], all[i]);
  }
  EXPECT_THAT(result.strings("/provenance/plan").at(0),
              AllOf(HasSubstr("meshes that deform"), HasSubstr("improved: made anew in every frame"),
                    HasSubstr("certified: what is prepared follows")));

  run_to(small_run({}, "", ""), scratch / "rigid.h5");
  const OpenResult rigid(scratch / "rigid.h5");
  EXPECT_FALSE(rigid.has("/methods/certified/following_time"));
  EXPECT_FALSE(rigid.has("/scene/moving/deformation/moved_vertices"));
  EXPECT_NE(result.doubles("/methods/certified/force"), rigid.doubles("/methods/certified/force"));
}

TEST(Deforming, ContactOfFramesThatAreNotLookedAtIsKnown) {
  const Experiment experiment = small_run({"/frames=300"}, BEND, "");
  const PreparedRun run = prepare(experiment, {}, Deforming::FOLLOWED);
  const auto& deformation = run.input.motion.deformation;
  Scene scene = run.scene();
  scene.cutoff = 2e-3;
  const std::vector<bool> known = frames_in_contact(scene, run.input.motion, run.input.poses);
  EXPECT_EQ(known, frames_in_contact(scene, run.input.motion, run.input.poses, false));
  EXPECT_GT(std::count(known.begin(), known.end(), true), 20);
  EXPECT_GT(std::count(known.begin(), known.end(), false), 20);
  DeformingDistance distance(run.scene(), run.input.motion);
  for (std::int64_t frame = 0; frame < 300; frame += 3) {
    // The pose is constant; only the deformation brings the meshes nearer.
    const Pose& pose = run.input.poses[static_cast<std::size_t>(frame / 60)];
    const DeformingDistance::Interval interval = distance.known(frame, pose);
    const double exact = distance.look(frame, pose);
    EXPECT_LE(interval.least, exact);
    EXPECT_GE(interval.most, exact);
  }
  EXPECT_GT(deformation->way(0, 30), 0.0);
  EXPECT_EQ(deformation->way(30, 30), 0.0);
  EXPECT_LE(deformation->way(0, 299), 2.0 * deformation->farthest(run.scene().moving.get()));
  EXPECT_EQ(deformation->farthest(run.scene().fixed[0].body.get()), 0.0);
}

TEST(Deforming, AnInterruptedRunIsTakenUpAgain) {
  const ScratchDirectory scratch;
  const Experiment experiment = small_run();
  run_to(experiment, scratch / "whole.h5");
  EXPECT_THROW(
      run_experiment_to_file(experiment, scratch / "r.h5", {},
                             [](const std::string&, std::int64_t done, std::int64_t) { return done < 150; }),
      Interrupted);
  const RunResult result = run_experiment_to_file(experiment, scratch / "r.h5", {}, {}, Leftover::RESUME);
  EXPECT_GE(result.resumed_frames, 150);
  EXPECT_TRUE(deterministic_datasets(scratch / "r.h5") == deterministic_datasets(scratch / "whole.h5"));
  for (const double seconds : OpenResult(scratch / "r.h5").doubles("/methods/certified/following_time"))
    EXPECT_GT(seconds, 0.0);
}

TEST(Deforming, AClosedLoopMeetsTheMeshesAsTheyAre) {
  const ScratchDirectory scratch;
  run_to(small_run({R"(/loop={"kind":"closed","hand":"postural-arm"})", "/frames=40",
                    R"(/methods=[{"name":"certified"}])"}),
         scratch / "r.h5");
  EXPECT_THAT(OpenResult(scratch / "r.h5").doubles("/methods/certified/truth/recall"),
              AllOf(Not(IsEmpty()), Each(1.0)));
}

TEST(Deforming, AnExportHasEachFramesShape) {
  const ScratchDirectory scratch;
  const RunResult run = run_to(small_run({"/frames=40"}), scratch / "r.h5");
  const ResultReader result(scratch / "r.h5");
  export_frames(result, scratch / "vtk", 4);
  const auto text = [&](const std::string& name) { return testing::read_text(scratch / name); };
  EXPECT_TRUE(std::filesystem::exists(scratch / "vtk/fixed_0.pvd"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "vtk/fixed_0.vtu"));
  EXPECT_GT(text("vtk/fixed_0/000010.vtu").size(), 1000u);
  EXPECT_NE(text("vtk/fixed_0/000010.vtu"), text("vtk/fixed_0/000020.vtu"));
}

TEST(Export, SeriesOfOneNameAreKeptApart) {
  const ScratchDirectory scratch;
  run_to(small_run({"/frames=20", "/record/lmds=true",
                    R"(/methods=[{"name":"improved","label":"exact"},{"name":"certified"}])"}),
         scratch / "r.h5");
  const auto written = export_frames(ResultReader(scratch / "r.h5"), scratch / "vtk", 4);
  EXPECT_EQ(std::set<std::filesystem::path>(written.begin(), written.end()).size(), written.size());
  for (const char* name : {"lmds-exact.pvd", "lmds-of-exact.pvd", "lmds-certified.pvd"})
    EXPECT_THAT(written, ::testing::Contains(scratch / "vtk" / name));
}

TEST(Export, ReplacesAnEarlierOneAsAWhole) {
  const ScratchDirectory scratch;
  run_to(small_run({"/frames=20", "/record/lmds=true"}), scratch / "many.h5");
  run_to(small_run({"/frames=20", "/record/lmds=false", R"(/methods=[{"name":"certified"}])"}),
         scratch / "few.h5");
  const auto files = [&] {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch / "vtk"))
      names.insert(entry.path().lexically_relative(scratch / "vtk").string());
    return names;
  };
  export_frames(ResultReader(scratch / "few.h5"), scratch / "vtk", 4);
  const std::set<std::string> alone = files();
  export_frames(ResultReader(scratch / "many.h5"), scratch / "vtk", 20);
  EXPECT_GT(files().size(), alone.size() + 20);
  const std::set<std::string> mine{"forces-mine.pvd", "lmds-improved/notes.txt", "moving.vtu"};
  for (const std::string& name : mine)
    scratch.write("vtk/" + name, name.ends_with("vtu") ? "<?xml version=\"1.0\"?>\n<VTKFile " : "mine");
  export_frames(ResultReader(scratch / "few.h5"), scratch / "vtk", 4);
  std::set<std::string> expected = alone;
  expected.insert(mine.begin(), mine.end());
  expected.insert("lmds-improved");
  EXPECT_EQ(files(), expected);
}

TEST(Export, WithoutValuesOfFramesNothingIsWritten) {
  const ScratchDirectory scratch;
  run_to(small_run({"/frames=20", "/record/frames=false", R"(/methods=[{"name":"certified"}])"}),
         scratch / "r.h5");
  EXPECT_THAT(
      message_of<InputError>([&] { export_frames(ResultReader(scratch / "r.h5"), scratch / "vtk", 4); }),
      AllOf(HasSubstr("/methods/certified/force"), HasSubstr("--set /record/frames=true")));
  EXPECT_FALSE(std::filesystem::exists(scratch / "vtk"));
}

TEST(Export, CurvesUnderSeveralProfilesAreThoseOfTheirPoses) {
  const ScratchDirectory scratch;
  run_to(small_run({"/frames=40", "/record/polylines/stride_frames=10", R"(/methods=[{"name":"certified"}])",
                    R"(/force=[{"name":"hard","cutoff_m":0.002},{"name":"soft","cutoff_m":0.004}])"}),
         scratch / "r.h5");
  const ResultReader result(scratch / "r.h5");
  ASSERT_FALSE(result.has("/polylines"));
  EXPECT_THAT(export_frames(result, scratch / "vtk", 4), ::testing::Contains(scratch / "vtk/polylines.pvd"));
}

TEST(Export, FarFromTheOriginMeshesKeepTheirShape) {
  const ScratchDirectory scratch;
  run_to(small_run({"/frames=4", R"(/methods=[{"name":"certified"}])",
                    R"(/fixed=[{"mesh":"ball","diagonal_m":0.02,"pose":{"translation_m":[1e6,0,0]}}])"}),
         scratch / "r.h5");
  export_frames(ResultReader(scratch / "r.h5"), scratch / "vtk", 1);
  const std::string text = testing::read_text(scratch / "vtk/fixed_0.vtu");
  EXPECT_THAT(text, HasSubstr("1000000.00"));
}

/// Message of the usage error for a deformation of the moving mesh.
std::string refusal(const std::string& deformation, const std::vector<Override>& overrides = {}) {
  return message_of<UsageError>([&] { small_run(overrides, deformation); });
}

TEST(Deforming, WhatCannotBeIsRefusedWithItsPlace) {
  EXPECT_THAT(refusal(R"({"generator":"bent","amplitude":1})"),
              AllOf(HasSubstr("/moving/deformation/generator"), HasSubstr("crumple")));
  EXPECT_THAT(refusal(R"({"generator":"bend"})"),
              AllOf(HasSubstr("/moving/deformation"), HasSubstr("amplitude")));
  EXPECT_THAT(refusal(R"({"amplitude":1})"), HasSubstr("neither a generator nor vertex files"));
  EXPECT_THAT(refusal(R"({"generator":"bend","amplitude":1,"files":["a.off"]})"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(refusal(R"({"generator":"bend","amplitude":1,"interval_s":1})"),
              HasSubstr("\"generator\" and \"interval_s\" exclude each other"));
  EXPECT_THAT(refusal(R"({"amplitude":1,"folder":"a"})"), HasSubstr("exclude each other"));
  EXPECT_THAT(refusal(R"({"generator":"bend","amplitude":1,"end":"repeat"})"),
              HasSubstr("\"end\" and \"generator\" exclude each other"));
  for (const std::string key : {R"("seed":2)", R"("period_s":2)", R"("share":0.5)", R"("direction":[1,0,0])"})
    for (const std::string from : {R"("files":["a.off"])", R"("folder":"a")"})
      EXPECT_THAT(refusal("{" + from + "," + key + "}"), HasSubstr("exclude each other")) << key;
  EXPECT_THAT(refusal(R"({"generator":"bend","amplitude":1,"direction":[0,0,0]})"),
              HasSubstr("/moving/deformation/direction"));
  EXPECT_THAT(refusal(R"({"generator":"bend","amplitude":1,"share":0})"),
              HasSubstr("/moving/deformation/share"));
  EXPECT_THAT(refusal(R"({"generator":"bend","amplitude":1,"speed":2})"), HasSubstr("speed"));
  EXPECT_THAT(message_of<UsageError>([] { prepare(small_run({}, "")); }),
              AllOf(HasSubstr("/fixed/0/deformation"), HasSubstr("at rest")));
  // After a quarter of the period all vertices are in one place.
  EXPECT_THAT(
      message_of<InputError>([] {
        prepare(small_run({}, R"({"generator":"breathe","amplitude":-1,"period_s":0.04})"), {},
                Deforming::FOLLOWED);
      }),
      AllOf(HasSubstr("shapes.json"), HasSubstr("/moving/deformation, frame 10"), HasSubstr("amplitude")));
}

TEST(Deforming, TwoMeshesOfOneFileAreOneBodyOnlyWhereBothAreRigid) {
  const auto body_count = [](const std::string& deformation) {
    const Experiment experiment = load_experiment(
        SHAPES_FILE,
        {R"(/moving={"mesh":"small-blob"})", R"(/fixed=[{"mesh":"small-blob")" + deformation + "}]"});
    const Scene scene = load_scene(experiment).scene;
    return scene.moving == scene.fixed[0].body ? 1 : 2;
  };
  EXPECT_EQ(body_count(""), 1);
  EXPECT_EQ(body_count(R"(,"deformation":)" + std::string(BREATHE)), 2);
}

/// A tetrahedron; in shape 2 twice as large, in shape 3 with its tip through the base.
struct Tetrahedra {
  ScratchDirectory scratch;
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  MeshDeformation choice;

  Tetrahedra() {
    choice.experiment = "e.json";
    choice.place = "/moving/deformation";
    choice.folder = scratch.path();
    TriangleMesh next = mesh;
    scratch.write("1.off", to_off_text(mesh));
    for (Vec3& vertex : next.vertices) vertex *= 2.0;
    scratch.write("2.off", to_off_text(next));
    scratch.write("3.xyz", "# x y z\n0 0 0\n1, 0, 0\n0 1 0\n\n0 0 -1\n");
  }
  FrameVertices vertices(double rate = 100.0, const Placement& placement = {}) const {
    return {choice, {mesh, placement, mesh, std::nullopt}, rate};
  }
  static Vec3 tip(const FrameVertices& vertices, std::int64_t frame) {
    std::vector<Vec3> all;
    vertices.at(frame, all);
    return all.at(3);
  }
};

TEST(FrameVertices, FilesFollowOneAnotherInTheOrderOfTheirNames) {
  Tetrahedra scene;
  const auto heights = [&](SequenceEnd end) {
    scene.choice.end = end;
    const FrameVertices vertices = scene.vertices();
    std::vector<double> found;
    for (std::int64_t frame = 0; frame < 8; ++frame) found.push_back(Tetrahedra::tip(vertices, frame).z());
    return found;
  };
  EXPECT_EQ(heights(SequenceEnd::HOLD), (std::vector<double>{1, 2, -1, -1, -1, -1, -1, -1}));
  EXPECT_EQ(heights(SequenceEnd::REPEAT), (std::vector<double>{1, 2, -1, 1, 2, -1, 1, 2}));
  EXPECT_EQ(heights(SequenceEnd::BACK), (std::vector<double>{1, 2, -1, 2, 1, 2, -1, 2}));
  scene.choice.interval_s = 0.04;
  EXPECT_EQ(heights(SequenceEnd::HOLD), (std::vector<double>{1, 1.25, 1.5, 1.75, 2, 1.25, 0.5, -0.25}));
  EXPECT_EQ(Tetrahedra::tip(scene.vertices(100.0, {.scale = 0.5}), 4).z(), 1.0);
  EXPECT_NE(scene.vertices().sha256(), "");
  const std::string before = scene.vertices().sha256();
  scene.scratch.write("2.off", to_off_text(scene.mesh));
  EXPECT_NE(scene.vertices().sha256(), before);
}

TEST(FrameVertices, VerticesThatComeTogetherStayApart) {
  Tetrahedra scene;
  TriangleMesh shape = scene.mesh;
  shape.vertices[3] = shape.vertices[2];
  scene.scratch.write("2.off", to_off_text(shape));
  EXPECT_EQ(Tetrahedra::tip(scene.vertices(), 1), shape.vertices[2]);
  // Each triangle with corners of its own, as in STL, and a vertex that none has.
  TriangleMesh corners;
  corners.vertices = {{9, 9, 9}};
  for (const auto& triangle : shape.triangles) {
    for (const std::int32_t corner : triangle)
      corners.vertices.push_back(shape.vertices[static_cast<std::size_t>(corner)]);
    const auto count = static_cast<std::int32_t>(corners.vertices.size());
    corners.triangles.push_back({count - 3, count - 2, count - 1});
  }
  scene.scratch.write("2.off", to_off_text(corners));
  std::vector<Vec3> found;
  scene.vertices().at(1, found);
  EXPECT_EQ(found, shape.vertices);
}

TEST(FrameVertices, AGeneratorWorksInTheMeshsOwnFrame) {
  const TriangleMesh mesh = make_box(Vec3(1, 2, 3), 4);
  MeshDeformation choice;
  choice.generator = DeformationChoice{DeformationKind::DENT, 0.1, 0.3, Vec3::UnitX(), 0};
  choice.period_s = 0.04;
  const Pose X_WF{Vec3(5, 6, 7), Eigen::Quaterniond(0.8, 0.0, 0.0, 0.6)};
  const FrameVertices vertices(choice, {mesh, {}, mesh, X_WF}, 1000.0);
  std::vector<Vec3> found, expected;
  vertices.at(10, found);
  Deformation(mesh, *choice.generator).at(0.25, expected);
  const RigidTransform to_world(X_WF);
  double moved = 0.0;
  for (std::size_t v = 0; v < found.size(); ++v) {
    EXPECT_EQ(found[v], to_world.point(expected[v]));
    moved = std::max(moved, (expected[v] - mesh.vertices[v]).norm());
  }
  EXPECT_GT(moved, 0.1);
}

TEST(FrameVertices, BadFilesAreNamed) {
  Tetrahedra scene;
  const auto refused = [&] { return message_of<InputError>([&] { scene.vertices(); }); };
  scene.scratch.write("4.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_THAT(refused(), AllOf(HasSubstr("4.xyz"), HasSubstr("3 vertices for a mesh of 4")));
  scene.scratch.write("4.xyz", "0 0 0\n1 0 0\n0 nan 0\n0 0 1\n");
  EXPECT_THAT(refused(), AllOf(HasSubstr("4.xyz"), HasSubstr("line 3"), HasSubstr("nan")));
  scene.scratch.write("4.xyz", "0 0 0\n1 0\n0 1 0\n0 0 1\n");
  EXPECT_THAT(refused(), AllOf(HasSubstr("4.xyz"), HasSubstr("line 2"), HasSubstr("2 numbers")));
  scene.scratch.write("4.xyz", "1 1 1\n1 1 1\n1 1 1\n1 1 1\n");
  EXPECT_THAT(refused(), AllOf(HasSubstr("4.xyz"), HasSubstr("one place")));
  scene.scratch.write("4.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  TriangleMesh other = scene.mesh;
  std::swap(other.triangles[1], other.triangles[2]);
  scene.scratch.write("5.off", to_off_text(other));
  EXPECT_THAT(refused(), AllOf(HasSubstr("5.off"), HasSubstr("triangle 1"), HasSubstr("topology")));
  other.triangles.pop_back();
  scene.scratch.write("5.off", to_off_text(other));
  EXPECT_THAT(refused(), AllOf(HasSubstr("5.off"), HasSubstr("3 triangles for a mesh of 4")));
  scene.choice.folder = scene.scratch / "none";
  EXPECT_THAT(refused(), AllOf(HasSubstr("none"), HasSubstr("folder")));
  scene.choice.folder.clear();
  scene.choice.files = {scene.scratch / "missing.off"};
  EXPECT_THAT(refused(), HasSubstr("missing.off"));
}

TEST(SceneDeformation, TrianglesThatTurnOverOrVanishAreFacts) {
  Tetrahedra tetrahedra;
  tetrahedra.scratch.write("4.xyz", "0 0 0\n1 0 0\n0 0 0\n0 0 -1\n");
  const auto body = std::make_shared<const Body>("tetrahedron", build_surface(tetrahedra.mesh));
  const SceneDeformation deformation({{body, std::make_shared<const FrameVertices>(tetrahedra.vertices())}},
                                     5);
  const std::vector<DeformationStep>& steps = deformation.bodies()[0].steps;
  ASSERT_EQ(steps.size(), 5u);
  EXPECT_EQ(steps[0].moved_vertices, 0);
  EXPECT_EQ(steps[1].moved_vertices, 3);
  EXPECT_DOUBLE_EQ(steps[1].largest_move, 1.0);
  EXPECT_EQ(steps[1].turned_over, 0);
  EXPECT_DOUBLE_EQ(steps[2].largest_move, 3.0);
  EXPECT_EQ(steps[2].turned_over, 3) << "all but the base";
  EXPECT_EQ(steps[2].first_turned_over, 1);
  EXPECT_EQ(steps[3].lost_area, 2);
  EXPECT_EQ(steps[3].first_lost_area, 0);
  EXPECT_EQ(steps[4].moved_vertices, 0);
  EXPECT_DOUBLE_EQ(deformation.farthest(body.get()), 2.0);
  EXPECT_EQ(deformation.farthest(nullptr), 0.0);
  EXPECT_DOUBLE_EQ(deformation.way(0, 1), 1.0);
  EXPECT_DOUBLE_EQ(deformation.way(2, 0), 4.0);
  EXPECT_EQ(deformation.find(nullptr), nullptr);
}

TEST(Deforming, ARunSaysWhichTrianglesTurnOver) {
  const RunResult run =
      run_experiment(small_run({"/frames=60", "/probes/truth/stride_frames=0", "/probes/fcl/stride_frames=0",
                                "/driver/repetitions=1", R"(/methods=[{"name":"certified"}])"},
                               R"({"generator":"crumple","amplitude":0.3,"period_s":0.05})"));
  EXPECT_THAT(run.warnings, ::testing::Contains(AllOf(HasSubstr("moving mesh small-blob"),
                                                      HasSubstr("turn over"), HasSubstr("first triangle"))));
}

TEST(Deforming, TheCommittedExperimentIsRight) {
  const RunResult run = run_experiment(
      load_experiment(DEFORMING_FILE, {"/frames=125", "/driver/repetitions=1",
                                       "/driver/search_latency_frames=5", "/probes/truth/stride_frames=30"}));
  ASSERT_GE(run.comparisons(1).size(), 3u);
  std::size_t found = 0;
  for (const TruthComparison& row : run.comparisons(1)) {
    EXPECT_TRUE(row.same.exact());
    found += row.same.found;
  }
  EXPECT_GT(found, 0u);
  EXPECT_EQ(run.prepared.input.motion.deformation->bodies().size(), 2u);
}

}  // namespace
}  // namespace lmdbench
