// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/own_time.h>
#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/plugin/check_plugin.h>
#include <lmdbench/plugin/judged_contacts.h>
#include <lmdbench/plugin/plugin.h>
#include <lmdbench/plugin/plugin_caller.h>
#include <lmdbench/scene/scene_search.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/message_of.h>
#include <support/same_lmds.h>
#include <support/scenes.h>
#include <support/scratch_directory.h>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

namespace lmdbench::testing {
namespace {

MethodDescription only_method(const std::string& name, PluginTrust trust) {
  const std::vector<MethodDescription> methods = plugin_methods(PLUGIN_FOLDER "/" + name + ".so", trust);
  EXPECT_EQ(methods.size(), 1U);
  return methods.front();
}

Scene two_spheres() {
  return make_scene(make_sphere(1.0, 1), make_sphere(1.0, 1), 5.0);
}

std::uint64_t lost(Method& method, const Pose& pose) {
  LmdSet lmds;
  WorkCounters counters;
  method.search(pose, lmds, counters);
  return counters[PluginMark::LOST];
}

TEST(Plugin, IsDescribedAsItSays) {
  const MethodDescription good = only_method("good", PluginTrust::NONE);
  EXPECT_EQ(good.name, "good");
  EXPECT_EQ(good.promise, Promise::APPROXIMATION);
  EXPECT_EQ(only_method("wrong_promise", PluginTrust::NONE).promise, Promise::COMPLETE_SET);
  EXPECT_FALSE(good.tracks_locally);
  EXPECT_EQ(good.counters.size(), MethodDescription::MARKS);
  EXPECT_EQ(good.plugin, PLUGIN_FOLDER "/good.so");
}

/// A bare name is a file of the working folder, not a library of the system.
TEST(Plugin, MayBeNamedFromItsFolder) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(PLUGIN_FOLDER);
  EXPECT_EQ(plugin_methods("good.so", PluginTrust::NONE).front().name, "good");
  std::filesystem::current_path(before);
}

TEST(Plugin, OptionsThatAreNoSchemaAreTheFilesFault) {
  EXPECT_THAT(message_of<InputError>([] { only_method("bad_schema", PluginTrust::NONE); }),
              ::testing::HasSubstr("bad_schema.so"));
}

TEST(Plugin, IsDestroyedInItsProcess) {
  for (const PluginTrust trust : {PluginTrust::NONE, PluginTrust::TRUSTED}) {
    const ScratchDirectory scratch;
    const std::filesystem::path file = scratch / "goodbye";
    ::setenv("LMDBENCH_GOODBYE", file.c_str(), 1);
    {
      const MethodDescription method = only_method("says_goodbye", trust);
      const auto made = method.make(two_spheres(), nlohmann::json::object());
      EXPECT_EQ(lost(*made, Pose{Vec3(0.0, 0.0, 3.0)}), 0U);
      EXPECT_FALSE(std::filesystem::exists(file));
    }
    EXPECT_TRUE(std::filesystem::exists(file)) << (trust == PluginTrust::NONE ? "child" : "trusted");
  }
  ::unsetenv("LMDBENCH_GOODBYE");
}

/// A plugin gives the same contacts in a child process and in this one.
TEST(Plugin, AnswersTheSameInBothPlaces) {
  const Scene scene = two_spheres();
  const auto child = only_method("good", PluginTrust::NONE).make(scene, nlohmann::json::object());
  const auto direct = only_method("good", PluginTrust::TRUSTED).make(scene, nlohmann::json::object());
  for (int frame = 0; frame < 20; ++frame) {
    const Pose pose = moved(0.1 * frame, 2.5, 0.3);
    LmdSet a, b;
    WorkCounters marks;
    child->search(pose, a, marks);
    direct->search(pose, b, marks);
    ASSERT_GT(a.size(), 8U);
    EXPECT_TRUE(std::is_sorted(a.begin(), a.end(), lmd_less));
    testing::expect_same_lmds(a, b);
    marks[PluginMark::DUPLICATES] = 0;  // Triangles share corners.
    EXPECT_TRUE(marks == WorkCounters{});
  }
}

/// The force is about the same point near the origin, far away, and with two meshes in the scene.
TEST(Plugin, OwnForceIsAboutTheSamePointInEveryFrame) {
  const MethodDescription pushes = only_method("pushes", PluginTrust::TRUSTED);
  EXPECT_EQ(pushes.promise, Promise::FORCE_ONLY);
  EXPECT_TRUE(pushes.has_own_force());
  const nlohmann::json own = complete_options(pushes, nlohmann::json::object(), "test");
  const auto wrench = [&](const Scene& scene, const Pose& pose, const Vec3& point) {
    SceneSearch method(scene, pushes, [&](const Scene& of) { return pushes.make(of, own); });
    LmdSet lmds;
    WorkCounters marks;
    method.search(pose, lmds, marks);
    EXPECT_TRUE(lmds.empty()) << "promises no set";
    EXPECT_EQ(marks[PluginMark::FORCE_WRONG], 0U);
    EXPECT_TRUE(own_wrench_of(method));
    return OwnWrench{own_wrench_of(method)->force, own_wrench_of(method)->torque_about(point), point};
  };
  const Vec3 point(0.5, -0.25, 1.0), far(1e6, 2e6, -3e6);
  const Pose pose = moved(0.4, 1.9, 0.3);
  // The plugin renders 2 N along z at the other mesh's origin.
  const OwnWrench near = wrench(two_spheres(), pose, point);
  EXPECT_EQ(near.force, Vec3(0, 0, 2));
  EXPECT_LT((near.torque - (-point).cross(Vec3(0, 0, 2))).norm(), 1e-12);
  Scene far_scene = make_scene(make_sphere(1.0, 1), translated(make_sphere(1.0, 1), far), 5.0);
  Pose far_pose = pose;
  far_pose.translation += far;
  const OwnWrench far_wrench = wrench(far_scene, far_pose, point + far);
  EXPECT_LT((far_wrench.torque - near.torque).norm(), 1e-6) << "the plugin sees the near frame";
  Scene world = two_spheres();
  world.fixed.front().X_WF =
      Pose{Vec3(0, 0, 0), Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()))};
  world.fixed.push_back({world.fixed.front().body, Pose{Vec3(3, 0, 0), Eigen::Quaterniond::Identity()}});
  const OwnWrench both = wrench(world, pose, point);
  EXPECT_LT((both.force - Vec3(0, -2, 2)).norm(), 1e-12);
  const Vec3 torque = (-point).cross(Vec3(0, -2, 0)) + (Vec3(3, 0, 0) - point).cross(Vec3(0, 0, 2));
  EXPECT_LT((both.torque - torque).norm(), 1e-12);
  const auto method = pushes.make(two_spheres(), {{"own_force", false}});
  EXPECT_FALSE(own_wrench_of(*method));
}

/// Of two meshes that move each feels the other's, and what stands pushes both.
TEST(Plugin, OwnForcesOfSeveralMoversAreOppositeInPairs) {
  const MethodDescription pushes = only_method("pushes", PluginTrust::TRUSTED);
  const nlohmann::json own = complete_options(pushes, nlohmann::json::object(), "test");
  Scene scene = two_spheres();
  const auto poses = std::make_shared<std::vector<Pose>>(2);
  scene.movers = {scene.fixed.front().body, scene.moving};
  scene.held = 1;
  scene.mover_poses = poses;
  poses->front() =
      Pose{Vec3(2.5, 0, 0), Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()))};
  const Pose held = moved(0.4, 1.9, 0.3);
  SceneSearch method(scene, pushes, [&](const Scene& of) { return pushes.make(of, own); });
  LmdSet lmds;
  WorkCounters marks;
  method.search(held, lmds, marks);
  const std::optional<OwnWrench> of_other = own_wrench_of(method, 0), of_held = own_wrench_of(method, 1);
  ASSERT_TRUE(of_other && of_held);
  // Of their pair the other one is first: 2 N along the held one's z; the fixed mesh: 2 N along z.
  const Vec3 z_held = RigidTransform(held).direction(Vec3(0, 0, 2)), z(0, 0, 2);
  EXPECT_LT((of_other->force - (z + z_held)).norm(), 1e-12);
  EXPECT_LT((of_held->force - (z - z_held)).norm(), 1e-12);
  const Vec3 point(0.5, -0.25, 1.0), at_held = held.translation - point;
  EXPECT_LT((of_other->torque_about(point) - (at_held.cross(z_held) - point.cross(z))).norm(), 1e-12);
  EXPECT_LT((of_held->torque_about(point) + at_held.cross(z_held) + point.cross(z)).norm(), 1e-12);
}

TEST(Plugin, ForcesThatAreNoneAreZeroAndCounted) {
  for (const char* name : {"nan_force", "no_force"}) {
    const MethodDescription description = only_method(name, PluginTrust::NONE);
    const auto method = description.make(two_spheres(), {{"own_force", true}});
    WorkCounters marks;
    LmdSet lmds;
    for (int frame = 0; frame < 3; ++frame) {
      method->search(Pose{}, lmds, marks);
      EXPECT_EQ(own_wrench_of(*method)->force, Vec3(0, 0, frame < 2 ? 2.0 : 0.0)) << name;
    }
    EXPECT_EQ(marks[PluginMark::FORCE_WRONG], 1U) << name;
    EXPECT_EQ(marks[PluginMark::LOST], 0U) << name;
    EXPECT_FALSE(lmds.empty()) << "its contacts are judged all the same";
  }
}

/// Time that a search takes outside the plugin is counted separately, so that drivers subtract it.
TEST(Plugin, TimesOfTheWayAreNotTheMethods) {
  const auto method = only_method("good", PluginTrust::NONE).make(two_spheres(), nlohmann::json::object());
  LmdSet lmds;
  WorkCounters marks;
  seconds_of_others() = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  method->search(Pose{}, lmds, marks);
  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GT(seconds_of_others(), 0.0);
  EXPECT_LT(seconds_of_others(), all);
}

/// Where meshes deform it is made anew in every frame, which is its work.
TEST(Plugin, MakingItIsTheMethodsTime) {
  for (const PluginTrust trust : {PluginTrust::NONE, PluginTrust::TRUSTED}) {
    const MethodDescription slow = only_method("slow", trust);
    seconds_of_others() = 0.0;
    const auto begin = std::chrono::steady_clock::now();
    const auto method = slow.make(two_spheres(), nlohmann::json::object());
    const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_GT(seconds_of_others(), 0.0);
    EXPECT_GE(all - seconds_of_others(), 0.1);
  }
}

/// With room for more contacts it is asked again: once all is well, once it fails.
TEST(Plugin, IsGivenMoreRoomOnce) {
  for (const PluginTrust trust : {PluginTrust::NONE, PluginTrust::TRUSTED}) {
    const MethodDescription description = only_method("grows", trust);
    const auto method = description.make(two_spheres(), nlohmann::json::object());
    WorkCounters marks;
    LmdSet lmds;
    for (int frame = 0; frame < 6; ++frame) method->search(Pose{}, lmds, marks);
    EXPECT_EQ(marks[PluginMark::LOST], 0U);
    EXPECT_EQ(marks[PluginMark::FLOAT_MODE], 1U) << "of the first call, whose answer did not fit";
    EXPECT_EQ(lost(*method, Pose{}), 1U);
    EXPECT_EQ(description.faults->last(), "failed with status 7");
  }
}

TEST(Plugin, ThatIsTooSlowForTheCheckIsNotSaidToPass) {
  const auto verdicts = [](double seconds) {
    std::map<std::string, PluginFinding::Verdict> found;
    for (const PluginFinding& finding : check_plugin(PLUGIN_FOLDER "/slow.so", seconds))
      found[finding.question] = finding.verdict;
    return found;
  };
  using enum PluginFinding::Verdict;
  for (auto found = verdicts(3.0);
       const std::string question :
       {"answers every pose", "same again, backwards, shuffled", "same from a new instance",
        "same with meshes counted otherwise", "same with a mesh in another frame"})
    EXPECT_EQ(found.at(question), NOTED) << question;
  EXPECT_EQ(verdicts(0.0).at("answers every pose"), FAILED);
}

TEST(Plugin, IsStartedAnewThreeTimes) {
  const MethodDescription description = only_method("crash", PluginTrust::NONE);
  const auto method = description.make(two_spheres(), nlohmann::json::object());
  std::string frames;
  for (int frame = 0; frame < 16; ++frame) frames += lost(*method, Pose{}) > 0 ? 'x' : '.';
  EXPECT_EQ(frames, "..x..x..x..xxxxx");
  EXPECT_THAT(description.faults->last(), ::testing::HasSubstr("crashed"));
}

TEST(Plugin, ThatHangsIsWaitedForOnlySoLong) {
  set_limit("plugin-seconds=1");
  const MethodDescription description = only_method("hang", PluginTrust::NONE);
  const auto method = description.make(two_spheres(), nlohmann::json::object());
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(lost(*method, Pose{}) + lost(*method, Pose{}), 0U);
  EXPECT_EQ(lost(*method, Pose{}), 1U);
  EXPECT_EQ(lost(*method, Pose{}), 0U) << "a new process";
  set_limit("plugin-seconds=10");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(8));
}

TEST(Plugin, CannotChangeTheFloatModeOfThisProgram) {
  const unsigned before = _mm_getcsr() & 0xFFC0U;
  const auto method =
      only_method("fast_math", PluginTrust::TRUSTED).make(two_spheres(), nlohmann::json::object());
  EXPECT_EQ(_mm_getcsr() & 0xFFC0U, before);
  WorkCounters marks;
  LmdSet lmds;
  for (int frame = 0; frame < 3; ++frame) method->search(Pose{}, lmds, marks);
  EXPECT_EQ(_mm_getcsr() & 0xFFC0U, before);
  EXPECT_EQ(marks[PluginMark::FLOAT_MODE], 2U) << "its constructor and its third call";
}

TEST(Plugin, ThatIsTrustedAndWritesPastItsEndIsNoticed) {
  const auto method =
      only_method("write_past_end", PluginTrust::TRUSTED).make(two_spheres(), nlohmann::json::object());
  EXPECT_EQ(lost(*method, Pose{}) + lost(*method, Pose{}), 0U);
  EXPECT_THROW(lost(*method, Pose{}), InputError);
}

#ifdef HAS_CERTIFIED_PLUGIN
/// Contacts of `certified` go through the interface unchanged.
TEST(Plugin, CertifiedBehindTheInterfaceIsCertified) {
  const MethodDescription description = only_method("certified-plugin", PluginTrust::NONE);
  EXPECT_TRUE(description.frame_coherent);
  ASSERT_EQ(description.counters.size(), MethodDescription::MARKS + 1);
  const Scene scene = make_scene(make_l_block(1.0), make_blob(1.0, 0.2, 3), 0.3);
  const auto behind = description.make(scene, complete_options(description, {{"kernel", "scalar"}}, "test"));
  const auto certified = make_method("certified", scene);
  std::mt19937_64 random(4);
  for (int i = 0; i < 30; ++i) {
    const Pose pose = grazing_pose(scene, 0.05 * (i % 4), random);
    LmdSet lmds;
    WorkCounters marks;
    behind->search(pose, lmds, marks);
    // Its pose is a matrix, not a quaternion.
    testing::expect_like_lmds(lmds, lmds_at(*certified, pose), 1e-14, std::to_string(i));
    EXPECT_GT(marks.values[MethodDescription::MARKS], 0U);
    marks.values[MethodDescription::MARKS] = 0;
    EXPECT_TRUE(marks == WorkCounters{}) << i;
  }
}
#endif

}  // namespace
}  // namespace lmdbench::testing
