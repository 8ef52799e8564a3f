// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/lmd/body.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/methods/registry.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/pieces.h>
#include <study/scaling/measure.h>
#include <study/scaling/subdivide.h>
#include <study/studies.h>
#include <support/context.h>
#include <support/poses.h>
#include <support/program.h>
#include <support/timing.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

/// How run time and work grow with the number of triangles at a fixed contact, and with cutoff and
/// gap on a fixed mesh. Markdown on standard output, every pose's numbers as JSON in a file (drawn
/// by scripts/figures/scaling.py). Exit code 1 when certified breaks a promise.
namespace lmdbench::scaling {
namespace {

constexpr int FORMAT_VERSION = 1;

struct ScalingChoice {
  std::filesystem::path meshes = "meshes";
  double diagonal = 0.15;
  double gap = 0.002;
  double cutoff = 0.005;
  std::size_t poses = 60;
  std::size_t repetitions = 5;
  std::size_t passes = 3;  ///< Over all points: none alone has the machine's slow minute.
  std::uint64_t seed = 1;
  std::vector<std::string> only;
  bool large = false;
  std::string json;
};

/// A mesh of the manifest, subdivided.
struct MeshChoice {
  std::string mesh;
  int subdivisions = 0;
  std::string label() const {
    return subdivisions == 0 ? mesh : fmt::format("{} / {}", mesh, 1 << (2 * subdivisions));
  }
};

/// A measured setting. Lengths are shares of the diagonal.
struct Point {
  MeshChoice moving, fixed;
  double gap = 0.0, cutoff = 0.0;
};

struct Study {
  std::string name;
  std::string about;
  std::vector<Point> points;
  bool same_surface = false;  ///< All points use the poses of the first one.
  bool large = false;         ///< Needs meshes that are built only on request.
};

std::vector<Study> all_studies(const ScalingChoice& choice) {
  std::vector<Study> studies;
  const auto against_itself = [&](const std::string& name, const std::string& about,
                                  const std::vector<MeshChoice>& meshes, bool same_surface) {
    Study study{name, about, {}, same_surface, false};
    for (const MeshChoice& mesh : meshes) study.points.push_back({mesh, mesh, choice.gap, choice.cutoff});
    studies.push_back(study);
  };
  against_itself(
      "bunny", "bunny against itself, decimated",
      {{"bunny-1k"}, {"bunny-2k"}, {"bunny-5k"}, {"bunny-10k"}, {"bunny-16k"}, {"bunny-40k"}, {"bunny-75k"}},
      false);
  against_itself("armadillo", "armadillo against itself, decimated",
                 {{"armadillo-1k"}, {"armadillo-2k"}, {"armadillo-10k"}, {"armadillo-22k"}, {"armadillo"}},
                 false);
  against_itself("bunny-subdivided", "bunny of 1,000 triangles against itself, each cut into 4, 16, ...",
                 {{"bunny-1k"}, {"bunny-1k", 1}, {"bunny-1k", 2}, {"bunny-1k", 3}, {"bunny-1k", 4}}, true);
  Study dragon{"dragon", "dragon against the bunny of 75,408 triangles", {}, false, true};
  for (const char* mesh : {"dragon-11k", "dragon-47k", "dragon-202k", "dragon-871k"})
    dragon.points.push_back({{mesh}, {"bunny-75k"}, choice.gap, choice.cutoff});
  studies.push_back(dragon);
  Study cutoffs{"cutoff", "two bunnies of 16,298 triangles, cutoff varied", {}, true, false};
  for (const double cutoff : {0.0025, 0.005, 0.01, 0.02, 0.05, 0.1})
    cutoffs.points.push_back({{"bunny-16k"}, {"bunny-16k"}, choice.gap, cutoff});
  studies.push_back(cutoffs);
  Study gaps{"gap", "two bunnies of 16,298 triangles, gap varied", {}, false, false};
  for (const double gap : {0.00002, 0.0001, 0.0005, 0.002, 0.004, 0.008})
    gaps.points.push_back({{"bunny-16k"}, {"bunny-16k"}, gap, choice.cutoff});
  studies.push_back(gaps);
  return studies;
}

TriangleMesh load_mesh(const MeshChoice& mesh, const ScalingChoice& choice) {
  return subdivided(scaled_to_diagonal(resolve_mesh(mesh.mesh, choice.meshes).mesh, choice.diagonal),
                    mesh.subdivisions);
}

nlohmann::json to_json(const BuildCost& cost, std::size_t triangles) {
  const auto count = static_cast<double>(triangles);
  return {{"surface_seconds", cost.surface_seconds},
          {"surface_cpu_seconds", cost.surface_cpu_seconds},
          {"wide_hierarchy_seconds", cost.wide_hierarchy_seconds},
          {"wide_hierarchy_cpu_seconds", cost.wide_hierarchy_cpu_seconds},
          {"surface_bytes_per_triangle", static_cast<double>(cost.surface_bytes) / count},
          {"wide_hierarchy_bytes_per_triangle", static_cast<double>(cost.wide_hierarchy_bytes) / count},
          {"features_per_triangle", static_cast<double>(cost.features) / count}};
}

/// Bodies of a study's meshes and the cost to make them. Neighbouring points often share one.
class Bodies {
 public:
  explicit Bodies(const ScalingChoice& choice) : choice_(choice) {}

  std::shared_ptr<const Body> get(const MeshChoice& mesh) {
    for (const auto& body : last_)
      if (body->name() == mesh.label()) return body;
    TriangleMesh loaded = load_mesh(mesh, choice_);
    const std::string label = mesh.label();
    if (!costs_.contains(label)) {
      costs_[label] = to_json(measure_build(loaded), loaded.triangles.size());
      costs_[label]["triangles"] = loaded.triangles.size();
    }
    if (last_.size() == 2) last_.erase(last_.begin());
    return last_.emplace_back(std::make_shared<const Body>(label, build_surface(std::move(loaded))));
  }
  const nlohmann::json& costs() const { return costs_; }

 private:
  const ScalingChoice& choice_;
  std::vector<std::shared_ptr<const Body>> last_;
  nlohmann::json costs_ = nlohmann::json::object();
};

nlohmann::json to_json(const Series& series) {
  nlohmann::json result = {{"seconds", series.seconds}, {"objection", series.objection}};
  if (series.same.true_lmds > 0) result["set"] = experiments::error_json(series.same, series.neighbours);
  if (series.counters.empty()) return result;
  for (const CounterDescription& counter : method_description("certified").counters) {
    nlohmann::json values;
    for (const WorkCounters& counters : series.counters) values.push_back(counters.values[counter.index]);
    result["counters"][counter.name] = values;
  }
  return result;
}

void print_head(const Study& study, const Measurement& measurement) {
  fmt::print(
      "\n### {}\n\nMedian / p99 over poses [us]; in brackets where they are below 1: recall, recall with "
      "neighbouring features counting.\n\n",
      study.about);
  fmt::print("| meshes | triangles | gap [%] | cutoff [%] | LMDs |");
  for (const Series& series : measurement.series) fmt::print(" {} |", series.name);
  fmt::print("\n|---|---|---|---|---|");
  for (std::size_t i = 0; i < measurement.series.size(); ++i) fmt::print("---|");
  fmt::print("\n");
}

void print_row(const Point& point, const Scene& scene, const Measurement& measurement) {
  std::vector<double> lmds(measurement.lmd_counts.begin(), measurement.lmd_counts.end());
  fmt::print("| {} on {} | {} | {:g} | {:g} | {:g} |", point.moving.label(), point.fixed.label(),
             scene.moving->surface().mesh.triangles.size(), 100.0 * point.gap, 100.0 * point.cutoff,
             median(lmds));
  for (const Series& series : measurement.series) {
    fmt::print(" {:.1f} / {:.1f}", 1e6 * median(series.seconds), 1e6 * quantile(series.seconds, P99));
    if (series.same.missed() > 0)
      fmt::print(" ({:.3f}, {:.3f})", series.same.recall(), series.neighbours.recall());
    fmt::print("{} |", series.objection.empty() ? "" : " WRONG");
  }
  fmt::print("\n");
  std::fflush(stdout);
}

/// Of every pose the least time of both, and the first objection.
void keep_least(Measurement& kept, const Measurement& again) {
  for (std::size_t i = 0; i < kept.series.size(); ++i) {
    Series& series = kept.series[i];
    std::ranges::transform(series.seconds, again.series[i].seconds, series.seconds.begin(),
                           [](double a, double b) { return std::min(a, b); });
    if (series.objection.empty()) series.objection = again.series[i].objection;
  }
}

/// Exponent of a series' median over the moving mesh's triangles, by least squares of logarithms.
double slope(const nlohmann::json& points, const std::string& name) {
  std::vector<double> triangles, medians;
  for (const auto& point : points) {
    triangles.push_back(point.at("moving_triangles").get<double>());
    medians.push_back(median(point.at("methods").at(name).at("seconds").get<std::vector<double>>()));
  }
  return experiments::log_slope(triangles, medians);
}

void print_slopes(const nlohmann::json& points) {
  fmt::print("\nSlopes of log time over log triangles:");
  for (const auto& [name, series] : points.front().at("methods").items())
    fmt::print(" {} {:.3f};", name, slope(points, name));
  fmt::print("\n");
}

nlohmann::json measure_study(const Study& study, const ScalingChoice& choice, Bodies& bodies,
                             bool& kept_promises) {
  nlohmann::json result = {{"name", study.name}, {"about", study.about}, {"points", nlohmann::json::array()}};
  std::vector<Scene> scenes;
  std::vector<std::vector<Pose>> poses;
  for (const Point& point : study.points) {
    Scene& scene = scenes.emplace_back();
    scene.moving = bodies.get(point.moving);
    scene.fixed = {bodies.get(point.fixed)};
    scene.cutoff = point.cutoff * choice.diagonal;
    poses.push_back(study.same_surface && !poses.empty()
                        ? poses.front()
                        : experiments::grazing_poses(*scene.moving, *scene.fixed[0],
                                                     point.gap * choice.diagonal, choice.poses, choice.seed));
  }
  std::vector<Measurement> measured;
  for (std::size_t pass = 0; pass < choice.passes; ++pass)
    for (std::size_t i = 0; i < study.points.size(); ++i) {
      const Point& point = study.points[i];
      fmt::print(stderr, "{}, pass {}: {} on {}\n", study.name, pass + 1, point.moving.label(),
                 point.fixed.label());
      MeasureChoice measure_choice;
      measure_choice.repetitions = choice.repetitions;
      measure_choice.seed = choice.seed;
      measure_choice.gap = point.gap * choice.diagonal;
      Measurement measurement = measure(scenes[i], poses[i], measure_choice);
      if (pass > 0)
        keep_least(measured[i], measurement);
      else
        measured.push_back(std::move(measurement));
    }
  print_head(study, measured.front());
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    const Point& point = study.points[i];
    const Scene& scene = scenes[i];
    const Measurement& measurement = measured[i];
    print_row(point, scene, measurement);
    nlohmann::json entry = {{"moving", point.moving.label()},
                            {"fixed", point.fixed.label()},
                            {"moving_triangles", scene.moving->surface().mesh.triangles.size()},
                            {"fixed_triangles", scene.fixed[0]->surface().mesh.triangles.size()},
                            {"gap", point.gap},
                            {"cutoff", point.cutoff},
                            {"lmd_counts", measurement.lmd_counts}};
    for (const Series& series : measurement.series) {
      entry["methods"][series.name] = to_json(series);
      if (series.objection.empty()) continue;
      fmt::print(stderr, "wrong: {}: {}\n", series.name, series.objection);
      // FCL is a peer: its errors are reported, but this program does not fail by them.
      if (series.name.starts_with("certified")) kept_promises = false;
    }
    result["points"].push_back(entry);
  }
  if (study.points.front().moving.label() != study.points.back().moving.label())
    print_slopes(result["points"]);
  return result;
}

void print_costs(const nlohmann::json& costs) {
  fmt::print("\n### What certified needs of a mesh\n\n");
  fmt::print(
      "| mesh | triangles | surface [ms] | hierarchy [ms] | million triangles a second | million triangles a "
      "second of one processor's time | surface [bytes a triangle] | hierarchy [bytes a triangle] | "
      "together [bytes a triangle] | features a triangle |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<std::pair<std::string, nlohmann::json>> rows;
  for (const auto& [mesh, cost] : costs.items()) rows.emplace_back(mesh, cost);
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.second.at("triangles") < b.second.at("triangles");
  });
  for (const auto& [mesh, cost] : rows) {
    const auto value = [&](const char* key) { return cost.at(key).get<double>(); };
    const double surface_bytes = value("surface_bytes_per_triangle");
    const double hierarchy_bytes = value("wide_hierarchy_bytes_per_triangle");
    fmt::print(
        "| {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.0f} | {:.2f} |\n", mesh,
        cost.at("triangles").get<std::size_t>(), 1e3 * value("surface_seconds"),
        1e3 * value("wide_hierarchy_seconds"),
        1e-6 * value("triangles") / (value("surface_seconds") + value("wide_hierarchy_seconds")),
        1e-6 * value("triangles") / (value("surface_cpu_seconds") + value("wide_hierarchy_cpu_seconds")),
        surface_bytes, hierarchy_bytes, surface_bytes + hierarchy_bytes, value("features_per_triangle"));
  }
}

int measure_scaling(const ScalingChoice& choice) {
  nlohmann::json report = {{"format", "lmdbench-scaling"},
                           {"format_version", FORMAT_VERSION},
                           {"context", experiments::run_context()},
                           {"diagonal_m", choice.diagonal},
                           {"poses", choice.poses},
                           {"repetitions", choice.repetitions},
                           {"passes", choice.passes},
                           {"seed", choice.seed},
                           {"studies", nlohmann::json::array()}};
  fmt::print(
      "## Scaling\n\n{} random poses, seed {}; median of {} runs a pose, one thread's processor time, "
      "interleaved; of {} passes over all points the least\n",
      choice.poses, choice.seed, choice.repetitions, choice.passes);
  Bodies bodies(choice);
  bool kept_promises = true;
  std::vector<std::string> unknown = choice.only;
  for (const Study& study : all_studies(choice)) {
    const bool named = std::erase(unknown, study.name) > 0;
    if (choice.only.empty() ? study.large && !choice.large : !named) continue;
    report["studies"].push_back(measure_study(study, choice, bodies, kept_promises));
    report["builds"] = bodies.costs();
    experiments::write_report(choice.json, report);
  }
  if (!unknown.empty())
    throw UsageError("", "--only", "there is no study '" + unknown.front() + "'",
                     "choose of bunny, armadillo, bunny-subdivided, dragon, cutoff, gap");
  print_costs(bodies.costs());
  return static_cast<int>(kept_promises ? ExitCode::DONE : ExitCode::CHECK_FAILED);
}

}  // namespace
}  // namespace lmdbench::scaling

void lmdbench::study::add_scaling(CLI::App& app, Run& chosen) {
  CLI::App* command = app.add_subcommand("scaling", "How run time grows with triangles, cutoff and gap");
  const auto choice = std::make_shared<scaling::ScalingChoice>();
  command->add_option("--meshes", choice->meshes, "Folder of built meshes");
  command->add_option("--diagonal", choice->diagonal, "Diagonal of all meshes [m]");
  command->add_option("--gap", choice->gap, "Gap, share of the diagonal");
  command->add_option("--cutoff", choice->cutoff, "Cutoff, share of the diagonal");
  command->add_option("--poses", choice->poses, "Random poses a point");
  command->add_option("--repetitions", choice->repetitions, "Timed runs a pose");
  command
      ->add_option("--passes", choice->passes,
                   "Passes over all points, of which each pose's least time counts")
      ->check(CLI::PositiveNumber);
  command->add_option("--seed", choice->seed, "Seed of poses and slides");
  command->add_option("--only", choice->only,
                      "Only these studies: bunny, armadillo, bunny-subdivided, dragon, cutoff, gap");
  command->add_flag("--large", choice->large,
                    "The dragon too, whose meshes are optional: lmdbench mesh build dragon-11k dragon-47k "
                    "dragon-202k dragon-871k");
  command->add_option("--json", choice->json, "Also write every pose's numbers to this file");
  command->callback([&chosen, command, choice] {
    chosen.work = [choice] { return scaling::measure_scaling(*choice); };
    chosen.pieces = [command, choice] {
      std::vector<std::string> names;
      for (const scaling::Study& each : scaling::all_studies(*choice))
        if (choice->only.empty()
                ? !each.large || choice->large
                : std::find(choice->only.begin(), choice->only.end(), each.name) != choice->only.end())
          names.push_back(each.name);
      return pieces_by(*command, {{"--only", names}});
    };
  });
}
