// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/methods/registry.h>

#include <CLI/CLI.hpp>
#include <benchmarks/global_search/implementation.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/flat_parts.h>
#include <study/scaling/slide.h>
#include <study/studies.h>
#include <support/bodies.h>
#include <support/context.h>
#include <support/poses.h>
#include <support/program.h>
#include <support/random.h>
#include <support/timing.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

/// Cost of a face that lies on a face, over the number of triangles: `certified` from scratch and
/// coherent, FCL's nearest pair, and a grazing pose of two bunnies from scratch, interleaved pose
/// by pose. Exit code 1 when `certified` does not find one contact at the gap.
namespace lmdbench::flat {
namespace {

struct Choice {
  std::filesystem::path meshes = "meshes";
  std::string bunny = "bunny-16k";
  std::size_t poses = 60, repetitions = 5;
  std::uint64_t seed = 1;
  bool fcl = true;
  std::string json;
};

/// Shares of the diagonal, which is 0.15 m as in the other studies.
constexpr double DIAGONAL = 0.15, GAP = 0.001, CUTOFF = 0.005;
constexpr std::size_t SLIDE_FRAMES = 20;

struct Family {
  const char* name;
  TriangleMesh (*make)(int cells, double scale);
  std::vector<int> cells;
};

const std::vector<Family>& families() {
  static const std::vector<Family> all{{"plate on its copy",
                                        [](int cells, double scale) {
                                          return scaled(make_box({1.0, 1.0, 0.1}, {cells, cells, 1}), scale);
                                        },
                                        {4, 16, 64, 128, 259}},
                                       {"box on its copy",
                                        [](int cells, double scale) {
                                          return scaled(make_box({1.0, 0.8, 0.6}, cells), scale);
                                        },
                                        {1, 3, 8, 38, 150}}};
  return all;
}

/// A slide in the plane of contact with a turn; the search is timed at the last frame.
std::vector<Pose> slide(double height, double size, experiments::Random& random) {
  const double angle = 2.0 * std::numbers::pi * random.uniform(),
               way = 2.0 * std::numbers::pi * random.uniform();
  const Vec3 end(random.uniform(-0.4, 0.4) * size, random.uniform(-0.4, 0.4) * size, height);
  const Vec3 step = scaling::SLIDE_DIAGONALS_PER_FRAME * DIAGONAL * Vec3(std::cos(way), std::sin(way), 0.0);
  std::vector<Pose> poses;
  for (std::size_t left = SLIDE_FRAMES + 1; left-- > 0;) {
    const auto back = static_cast<double>(left);
    poses.push_back({end - back * step, Eigen::Quaterniond(Eigen::AngleAxisd(
                                            angle - back * scaling::TURN_RAD_PER_FRAME, Vec3::UnitZ()))});
  }
  return poses;
}

std::string times(const std::vector<double>& seconds) {
  return fmt::format("{:.1f} | {:.1f} | {:.1f}", 1e6 * median(seconds), 1e6 * quantile(seconds, 0.99),
                     1e6 * *std::max_element(seconds.begin(), seconds.end()));
}

/// Exponent by least squares through the logarithms of the medians.
double slope_of(const std::vector<double>& triangles, const std::vector<std::vector<double>>& seconds,
                const std::vector<std::size_t>& drawn) {
  std::vector<double> medians;
  for (const std::vector<double>& of_mesh : seconds) {
    std::vector<double> sample;
    for (const std::size_t pose : drawn) sample.push_back(of_mesh[pose]);
    medians.push_back(median(sample));
  }
  return experiments::log_slope(triangles, medians);
}

/// With a 95 % interval from 2,000 draws of poses, the same for all numbers of triangles.
nlohmann::json slope(const std::vector<double>& triangles, const std::vector<std::vector<double>>& seconds) {
  std::vector<std::size_t> drawn(seconds.front().size());
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = i;
  const double value = slope_of(triangles, seconds, drawn);
  experiments::Random random(1);
  std::vector<double> samples;
  for (int sample = 0; sample < 2000; ++sample) {
    for (std::size_t& i : drawn)
      i = static_cast<std::size_t>(random.uniform() * static_cast<double>(drawn.size()));
    samples.push_back(slope_of(triangles, seconds, drawn));
  }
  return {{"slope", value}, {"low", quantile(samples, 0.025)}, {"high", quantile(samples, 0.975)}};
}

class Study {
 public:
  explicit Study(const Choice& choice) : choice_(choice) {
    experiments::SceneChoice bunnies;
    bunnies.moving = bunnies.fixed = choice.bunny;
    bunnies.meshes = choice.meshes;
    Scene scene = load_scene(bunnies);
    scene.cutoff = CUTOFF * DIAGONAL;
    grazing_ = experiments::grazing_poses(*scene.moving, *scene.fixed[0], 0.002 * DIAGONAL, choice.poses,
                                          choice.seed);
    bunny_.method = make_method("certified", scene, {{"frame_coherence", false}});
  }

  nlohmann::json run(const Family& family, bool& kept_promises) {
    nlohmann::json result = {{"name", family.name}, {"points", nlohmann::json::array()}};
    std::vector<double> triangles;
    std::vector<std::vector<double>> scratch, coherent;
    for (const int cells : family.cells) {
      const nlohmann::json point = measure(family, cells, kept_promises);
      triangles.push_back(point.at("triangles"));
      scratch.push_back(point.at("certified"));
      coherent.push_back(point.at("certified coherent"));
      result["points"].push_back(point);
    }
    result["slopes"] = {{"certified", slope(triangles, scratch)},
                        {"certified coherent", slope(triangles, coherent)}};
    return result;
  }

 private:
  nlohmann::json measure(const Family& family, int cells, bool& kept_promises) {
    TriangleMesh mesh = family.make(cells, 1.0);
    mesh = scaled(mesh, DIAGONAL / bounding_box_diagonal(mesh));
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    const auto body = std::make_shared<const Body>(family.name, build_surface(std::move(mesh)));
    const Scene scene{body, {body}, CUTOFF * DIAGONAL};
    const std::size_t count = body->surface().mesh.triangles.size();
    fmt::print(stderr, "{}: {} triangles\n", family.name, count);
    experiments::Random random(choice_.seed);
    std::vector<std::vector<Pose>> slides;
    for (std::size_t i = 0; i < choice_.poses; ++i)
      slides.push_back(slide(box.sizes().z() + GAP * DIAGONAL, box.sizes().x(), random));

    scaling::Runner scratch{make_method("certified", scene, {{"frame_coherence", false}})};
    scaling::Runner coherent{make_method("certified", scene)};
    const auto slide_to = [&](std::size_t pose) {
      for (std::size_t frame = 0; frame + 1 < slides[pose].size(); ++frame)
        coherent.search(slides[pose][frame]);
    };
    std::size_t one_contact = 0;
    for (std::size_t i = 0; i < slides.size(); ++i) {
      slide_to(i);
      bool right = true;
      for (scaling::Runner* runner : {&scratch, &coherent}) {
        runner->search(slides[i].back());
        right = right && runner->lmds.size() == 1 &&
                std::abs(runner->lmds[0].distance - GAP * DIAGONAL) <= 1e-9 * DIAGONAL;
      }
      one_contact += right ? 1 : 0;
    }
    if (one_contact != slides.size()) {
      kept_promises = false;
      fmt::print(stderr, "wrong: {} of {} triangles: one contact in {} of {} poses only\n", family.name,
                 count, one_contact, slides.size());
    }
    std::vector<experiments::TimedTask> tasks{
        {"certified", [&](std::size_t pose) { scratch.search(slides[pose].back()); }},
        {"certified coherent", [&](std::size_t pose) { coherent.search(slides[pose].back()); }, slide_to},
        {"bunny", [&](std::size_t pose) { bunny_.search(grazing_[pose]); }}};
    std::unique_ptr<experiments::GlobalSearch> fcl;
    if (choice_.fcl) {
      fcl = experiments::fcl_cold_search().make(scene);
      tasks.push_back({"fcl-cold", [&](std::size_t pose) { fcl->run(slides[pose].back()); }});
    }
    const auto seconds = experiments::time_interleaved(tasks, slides.size(), choice_.repetitions);
    nlohmann::json point = {{"triangles", count}, {"one_contact", one_contact}, {"poses", slides.size()}};
    for (std::size_t t = 0; t < tasks.size(); ++t) point[tasks[t].name] = seconds[t];
    std::size_t late = 0;
    for (const double s : seconds[0]) late += s > 1e-3 ? 1 : 0;
    fmt::print("| {} | {} | {} of {} | {} | {} | {} | {:.1f} ", family.name, count, one_contact,
               slides.size(), times(seconds[0]), times(seconds[1]), late, 1e6 * median(seconds[2]));
    if (choice_.fcl)
      fmt::print("| {} | {:.1f} | {:.1f} |\n", times(seconds[3]), median(seconds[3]) / median(seconds[0]),
                 median(seconds[3]) / median(seconds[1]));
    else
      fmt::print("| - | - | - | - | - |\n");
    std::fflush(stdout);
    return point;
  }

  const Choice& choice_;
  std::vector<Pose> grazing_;
  scaling::Runner bunny_;
};

int run(const Choice& choice) {
  fmt::print(
      "Gap {:g} %, cutoff {:g} % of the diagonal; {} poses, seed {}; median of {} runs a pose, processor "
      "time of one "
      "thread, interleaved [us]\n\n",
      100.0 * GAP, 100.0 * CUTOFF, choice.poses, choice.seed, choice.repetitions);
  fmt::print(
      "| shapes | triangles of each | one contact | from scratch: median | p99 | largest | coherent: median "
      "| p99 | "
      "largest | above 1 ms | grazing {} | FCL, nearest pair: median | p99 | largest | FCL / scratch | FCL / "
      "coherent "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      choice.bunny);
  nlohmann::json report = {{"format", "lmdbench-flat"},
                           {"format_version", 1},
                           {"context", experiments::run_context()},
                           {"gap", GAP},
                           {"cutoff", CUTOFF},
                           {"diagonal_m", DIAGONAL},
                           {"repetitions", choice.repetitions},
                           {"seed", choice.seed},
                           {"families", nlohmann::json::array()}};
  bool kept_promises = true;
  Study study(choice);
  for (const Family& family : families()) report["families"].push_back(study.run(family, kept_promises));
  fmt::print(
      "\n| shapes | way | slope of log time over log triangles | 95 % interval |\n|---|---|---|---|\n");
  for (const auto& family : report["families"])
    for (const auto& [way, slope] : family["slopes"].items())
      fmt::print("| {} | {} | {:.3f} | {:.3f} to {:.3f} |\n", family["name"].get<std::string>(), way,
                 slope["slope"].get<double>(), slope["low"].get<double>(), slope["high"].get<double>());
  experiments::write_report(choice.json, report);
  return kept_promises ? 0 : 1;
}

}  // namespace
}  // namespace lmdbench::flat

void lmdbench::study::add_flat(CLI::App& app, Run& chosen) {
  const auto choice = std::make_shared<flat::Choice>();
  CLI::App* command =
      app.add_subcommand("flat", "What does a face on a face cost, however finely it is cut?");
  const auto no_fcl = std::make_shared<bool>(false), parts = std::make_shared<bool>(false);
  const auto times = std::make_shared<flat_parts::PartsTimes>();
  command->add_option("--meshes", choice->meshes, "Folder of built meshes");
  command->add_option("--bunny", choice->bunny, "Mesh that is grazed for comparison");
  command->add_option("--poses", choice->poses, "Poses a row");
  command->add_option("--repetitions", choice->repetitions, "Timed runs a pose");
  command->add_option("--seed", choice->seed, "Seed of the poses");
  command->add_flag("--no-fcl", *no_fcl, "Leave FCL out");
  command->add_option("--json", choice->json, "Also write every pose's numbers to this file");
  command->add_flag("--parts", *parts, "Time machine parts on and in each other instead");
  command->add_option("--row", times->row, "With --parts: only those with this in their names");
  command->add_option("--paths", times->paths, "With --parts: motions a row")->check(CLI::PositiveNumber);
  command->callback([choice, no_fcl, parts, times, &chosen] {
    choice->fcl = !*no_fcl;
    times->seed = choice->seed;
    times->passes = choice->repetitions;
    times->json = choice->json;
    times->scan = choice->bunny;
    times->meshes = choice->meshes;
    chosen.work = [choice, parts, times] {
      if (!*parts) return flat::run(*choice);
      return flat_parts::time_parts(*times, {{"format", "lmdbench-flat-parts"},
                                             {"format_version", 1},
                                             {"context", experiments::run_context()}});
    };
  });
}
