// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/own_time.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/agreement.h>
#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/plugin/check_plugin.h>
#include <lmdbench/plugin/judged_contacts.h>
#include <lmdbench/plugin/plugin.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

namespace lmdbench {
namespace {

using Verdict = PluginFinding::Verdict;
using Clock = std::chrono::steady_clock;

constexpr int POSES = 16;

struct CheckScene {
  TriangleMesh a, b;
  double cutoff = 0.0;
  std::vector<Pose> poses;

  double tolerance() const {
    return 10.0 * POINT_TOLERANCE * (bounding_box_diagonal(a) + bounding_box_diagonal(b));
  }
};

Scene scene_of(const TriangleMesh& a, const TriangleMesh& b, double cutoff) {
  const auto body = [](const char* name, const TriangleMesh& mesh) {
    return std::make_shared<const Body>(name, build_surface(mesh));
  };
  return {body("a", a), {body("b", b)}, cutoff};
}

/// Poses that come nearer from all sides, to half the cutoff; every fourth enters the other mesh.
std::vector<Pose> poses_of(const CheckScene& scene, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double far = bounding_box_diagonal(scene.a) + bounding_box_diagonal(scene.b);
  const auto method = make_method("certified", scene_of(scene.a, scene.b, 2.0 * far));
  WorkCounters ignored;
  LmdSet lmds;
  std::vector<Pose> poses;
  for (int i = 0; i < POSES; ++i) {
    Pose pose;
    pose.rotation =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Vec3 side = Vec3(normal(random), normal(random), normal(random)).normalized();
    pose.translation = far * side;
    for (int step = 0; step < 40; ++step) {
      method->search(pose, lmds, ignored);
      const double gap = minimum_distance(lmds);
      if (!(gap > 0.5 * scene.cutoff)) break;
      pose.translation -= (gap - 0.3 * scene.cutoff) * side;
    }
    if (i % 4 == 3) pose.translation -= scene.cutoff * side;
    poses.push_back(pose);
  }
  return poses;
}

std::vector<CheckScene> check_scenes() {
  std::mt19937 random(48);
  std::vector<CheckScene> scenes(3);
  scenes[0] = {make_sphere(0.03, 3), make_blob(0.04, 0.008, 3), 0.006, {}};
  scenes[1] = {make_blob(0.03, 0.01, 3), make_torus(0.04, 0.012, 32, 16), 0.006, {}};
  scenes[2] = {make_l_block(0.04), make_box(Vec3(0.05, 0.04, 0.03), 4), 0.006, {}};
  for (CheckScene& scene : scenes) scene.poses = poses_of(scene, random);
  return scenes;
}

/// The same surface with another numbering.
TriangleMesh scrambled(const TriangleMesh& mesh, std::mt19937& random) {
  std::vector<std::int32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < order.size(); ++v)
    result.vertices[static_cast<std::size_t>(order[v])] = mesh.vertices[v];
  for (auto& triangle : result.triangles) {
    for (std::int32_t& corner : triangle) corner = order[static_cast<std::size_t>(corner)];
    std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
  }
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  return result;
}

/// The same pairs of points, up to a tolerance [m].
bool same_points(const LmdSet& a, LmdSet b, double tolerance) {
  if (a.size() != b.size()) return false;
  return std::ranges::all_of(a, [&](const Lmd& lmd) {
    const auto partner = std::ranges::find_if(b, [&](const Lmd& other) {
      return (lmd.point_moving - other.point_moving).norm() <= tolerance &&
             (lmd.point_fixed - other.point_fixed).norm() <= tolerance;
    });
    if (partner == b.end()) return false;
    b.erase(partner);
    return true;
  });
}

/// A method's answer for a pose.
struct Answer {
  LmdSet set;
  std::optional<OwnWrench> own;
};

bool same_bits(const Answer& a, const Answer& b) {
  const auto same = [](const Lmd& x, const Lmd& y) {
    return same_feature_pair(x, y) && x.point_moving == y.point_moving && x.point_fixed == y.point_fixed;
  };
  return std::ranges::equal(a.set, b.set, same) &&
         (!a.own || (a.own->force == b.own->force && a.own->torque == b.own->torque));
}

/// Whether two forces agree.
/// @param lever lever of torques [m]
bool same_force(const Answer& a, const Answer& b, double lever) {
  constexpr double SINGLE_PRECISION = 1e-4;  // of the larger force
  if (!a.own) return true;
  const double allowed = SINGLE_PRECISION * std::max(a.own->force.norm(), b.own->force.norm());
  return (a.own->force - b.own->force).norm() <= allowed &&
         (a.own->torque_about(Vec3::Zero()) - b.own->torque_about(Vec3::Zero())).norm() <= lever * allowed;
}

/// What one method did over all scenes.
class MethodCheck {
 public:
  explicit MethodCheck(const MethodDescription& method) : method_(method) {}

  void put_to(const CheckScene& scene, double until) {
    if (lost()) return;
    asked_ += scene.poses.size();
    until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(until));
    const Scene of_scene = scene_of(scene.a, scene.b, scene.cutoff);
    auto instance = make(of_scene);
    std::vector<Answer> sets;
    for (const Pose& pose : scene.poses) {
      if (out_of_time()) break;
      sets.push_back(search(*instance, pose, &marks_));
      if (lost()) return;
    }
    poses_ += sets.size();
    const auto visit = [&](Method& method, const std::vector<std::size_t>& order, Comparison& comparison,
                           const std::function<bool(const Answer&, const Answer&)>& same,
                           const Pose* X_M = nullptr) {
      for (const std::size_t i : order) {
        if (out_of_time() || lost()) return;
        ++comparison.compared;
        if (!same(sets[i], search(method, X_M == nullptr ? scene.poses[i] : scene.poses[i] * *X_M, nullptr)))
          ++comparison.differing;
      }
    };
    std::vector<std::size_t> order(sets.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 random(7);
    visit(*instance, order, again_, same_bits);
    std::reverse(order.begin(), order.end());
    visit(*instance, order, again_, same_bits);
    std::shuffle(order.begin(), order.end(), random);
    visit(*instance, order, again_, same_bits);
    instance = make(of_scene);
    visit(*instance, order, anew_, same_bits);
    const double lever = bounding_box_diagonal(scene.a) + bounding_box_diagonal(scene.b);
    const auto near = [&](const Answer& a, const Answer& b) {
      return same_points(a.set, b.set, scene.tolerance()) && same_force(a, b, lever);
    };
    instance = make(scene_of(scrambled(scene.a, random), scrambled(scene.b, random), scene.cutoff));
    visit(*instance, order, scrambled_, near);
    const Pose X_M{Vec3(0.01, -0.02, 0.015), Eigen::Quaterniond(0.4, -0.3, 0.7, 0.2).normalized()};
    TriangleMesh turned = scene.a;
    const RigidTransform to_turned(X_M.inverse());
    for (Vec3& vertex : turned.vertices) vertex = to_turned.point(vertex);
    instance = make(scene_of(turned, scene.b, scene.cutoff));
    visit(*instance, order, turned_, near, &X_M);

    if (method_.promise == Promise::FORCE_ONLY) return;
    const auto truth = make_method("exhaustive", of_scene);
    WorkCounters ignored;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      LmdSet all;
      truth->search(scene.poses[i], all, ignored);
      const Agreement here =
          agreement(all, within_cutoff(sets[i].set, scene.cutoff), Match::SAME_FEATURES, of_scene);
      agreement_ += here;
      inexact_ += here.exact() ? 0 : 1;
      const double error = std::abs(minimum_distance(sets[i].set) - minimum_distance(all));
      not_nearest_ += sets[i].set.empty() != all.empty() || error > scene.tolerance() ? 1 : 0;
    }
  }

  std::vector<PluginFinding> findings() const {
    std::vector<PluginFinding> all;
    const auto add = [&](const char* question, Verdict verdict, std::string answer) {
      all.push_back({method_.name, question, verdict, std::move(answer)});
    };
    const auto count_of = [&](PluginMark mark) { return marks_.values[static_cast<std::size_t>(mark)]; };
    if (lost()) {
      add("answers every pose", Verdict::FAILED,
          fmt::format("search {}: {}", seconds_.size(), method_.faults->last()));
      return all;
    }
    add("answers every pose",
        poses_ == 0        ? Verdict::FAILED
        : poses_ == asked_ ? Verdict::PASSED
                           : Verdict::NOTED,
        poses_ == asked_ ? fmt::format("{} poses", poses_)
                         : fmt::format("too slow: {} of {} poses in the time that there is", poses_, asked_));
    const std::uint64_t useless = count_of(PluginMark::NOT_FINITE) + count_of(PluginMark::OFF_MESH);
    add("points are on the meshes",
        useless + count_of(PluginMark::TOO_MANY) == 0 ? Verdict::PASSED : Verdict::FAILED,
        fmt::format("{} contacts are not finite, {} off their triangle, {} answers too large",
                    count_of(PluginMark::NOT_FINITE), count_of(PluginMark::OFF_MESH),
                    count_of(PluginMark::TOO_MANY)));
    const std::uint64_t untidy =
        count_of(PluginMark::OTHER_PART) + count_of(PluginMark::DUPLICATES) + count_of(PluginMark::UNSORTED);
    add("contacts are in order", untidy == 0 ? Verdict::PASSED : Verdict::NOTED,
        fmt::format("{} parts wrong, {} pairs twice, {} answers not nearest first",
                    count_of(PluginMark::OTHER_PART), count_of(PluginMark::DUPLICATES),
                    count_of(PluginMark::UNSORTED)));
    if (method_.has_own_force())
      add("gives its force", count_of(PluginMark::FORCE_WRONG) == 0 ? Verdict::PASSED : Verdict::FAILED,
          fmt::format("{} forces not finite or not given", count_of(PluginMark::FORCE_WRONG)));
    const std::uint64_t modes = count_of(PluginMark::FLOAT_MODE);
    add("leaves the float mode", modes == 0 ? Verdict::PASSED : Verdict::FAILED,
        modes == 0 ? "" : "rounding or flush-to-zero changed: link without -ffast-math");
    const auto same = [&](const char* question, const Comparison& answers) {
      if (answers.compared == 0)
        add(question, Verdict::NOTED, "not asked, too slow");
      else if (answers.differing == 0)
        add(question, Verdict::PASSED, "");
      else
        add(question, Verdict::FAILED, fmt::format("{} answers differ", answers.differing));
    };
    same("same again, backwards, shuffled", again_);
    same("same from a new instance", anew_);
    same("same with meshes counted otherwise", scrambled_);
    same("same with a mesh in another frame", turned_);
    const bool breaks = method_.promise == Promise::COMPLETE_SET   ? inexact_ > 0
                        : method_.promise == Promise::NEAREST_PAIR ? not_nearest_ > 0
                                                                   : false;
    add("keeps its promise", breaks ? Verdict::FAILED : Verdict::PASSED,
        method_.promise == Promise::FORCE_ONLY
            ? std::string("force-only: no set is judged")
            : fmt::format(
                  "{}: recall {:.3g}, precision {:.3g} of LMDs; another set in {} poses, another least "
                  "distance in {}",
                  to_string(method_.promise), agreement_.recall(), agreement_.precision(), inexact_,
                  not_nearest_));
    add("time of a pose", Verdict::NOTED,
        fmt::format("{:.3g} us in the plugin, {:.3g} us to its process, back and for judging (medians)",
                    1e6 * median(seconds_), 1e6 * median(way_)));
    return all;
  }

 private:
  std::unique_ptr<Method> make(const Scene& scene) const {
    return method_.make(scene,
                        complete_options(method_, nlohmann::json::object(), "options of " + method_.name));
  }
  bool out_of_time() const { return Clock::now() > until_; }
  bool lost() const { return marks_.values[static_cast<std::size_t>(PluginMark::LOST)] > 0; }

  Answer search(Method& method, const Pose& pose, WorkCounters* marks) {
    Answer answer;
    WorkCounters counters;
    seconds_of_others() = 0.0;
    const auto begin = Clock::now();
    method.search(pose, answer.set, counters);
    answer.own = own_wrench_of(method);
    const double all = std::chrono::duration<double>(Clock::now() - begin).count();
    seconds_.push_back(all - seconds_of_others());
    way_.push_back(seconds_of_others());
    if (marks != nullptr)
      *marks += counters;
    else
      marks_.values[0] += counters.values[0];
    return answer;
  }

  /// Answers to poses that were asked before, in another way.
  struct Comparison {
    std::size_t compared = 0, differing = 0;
  };

  const MethodDescription& method_;
  Clock::time_point until_;
  WorkCounters marks_;
  std::size_t asked_ = 0, poses_ = 0;
  Comparison again_, anew_, scrambled_, turned_;
  std::size_t inexact_ = 0, not_nearest_ = 0;
  Agreement agreement_;
  std::vector<double> seconds_, way_;
};

}  // namespace

std::vector<PluginFinding> check_plugin(const std::filesystem::path& file, double seconds) {
  const std::vector<MethodDescription> methods = plugin_methods(file, PluginTrust::NONE);
  const std::vector<CheckScene> scenes = check_scenes();
  std::vector<PluginFinding> all;
  for (const MethodDescription& method : methods) {
    MethodCheck check(method);
    for (const CheckScene& scene : scenes)
      check.put_to(scene, seconds / static_cast<double>(scenes.size() * methods.size()));
    for (PluginFinding& finding : check.findings()) all.push_back(std::move(finding));
  }
  return all;
}

}  // namespace lmdbench
