// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/cli/real_range.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/motion/generate.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/mesh_scene.h>
#include <lmdbench/motion/path_facts.h>
#include <lmdbench/motion/path_spec.h>
#include <lmdbench/motion/tum_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>

namespace lmdbench {
namespace {

/// Decimals of a generated path: nanometres and nanoradians keep the file small, unless they move
/// the mesh (tiny, or far from its origin) by 1e-5 of its size. The rounded path is checked.
std::optional<int> stored_decimals(const PathScene& scene) {
  const double reach = std::max(1.0, scene.moving_centre_M.norm() + scene.moving_radius);
  if (1e-9 * reach > 1e-5 * scene.diagonal) return std::nullopt;
  return 9;
}

constexpr double DEGREES = 180.0 / std::numbers::pi;

struct PathArguments {
  std::string spec;
  std::string path;
  std::string mesh_folder;
  double rate = 1000.0;
  bool json = false;
};

TriangleMesh place(const PlacedMesh& choice, const PathArguments& arguments) {
  const std::filesystem::path beside_spec = std::filesystem::path(arguments.spec).parent_path() / choice.mesh;
  TriangleMesh mesh = is_mesh_name(choice.mesh) ? resolve_mesh(choice.mesh, arguments.mesh_folder).mesh
                                                : resolve_mesh(beside_spec.string()).mesh;
  return placed(std::move(mesh), choice.placement);
}

std::string name_of(const PlacedMesh& choice) {
  const std::optional<double>& diagonal = choice.placement.diagonal;
  return diagonal ? fmt::format("{} ({:g} m)", choice.mesh, *diagonal) : choice.mesh;
}

PathScene load_scene(const PathSpec& spec, const PathArguments& arguments) {
  return mesh_scene(place(spec.moving, arguments), place(spec.fixed, arguments));
}

/// Shows progress and enforces the time limit: gaps far beyond the meshes' sizes, where all
/// triangles are equally near, may take seconds a frame.
ProgressFunction progress_on(ProgressBar& bar, const std::string& phase, const std::string& spec) {
  return [&bar, phase, spec](std::size_t done, std::size_t all) {
    bar.update(phase, static_cast<std::int64_t>(done), static_cast<std::int64_t>(all));
    const auto most = limit_of(Limit::PATH_SECONDS);
    if (static_cast<std::int64_t>(std::clock() / CLOCKS_PER_SEC) <= most) return;
    throw UsageError(
        spec, "",
        fmt::format("after {} s of processor time {} of {} frames are through ({})", most, done, all, phase),
        "lower frame_rate_hz, shorten the gaps' times, keep gaps below the meshes' sizes, or " +
            raise_remedy(Limit::PATH_SECONDS));
  };
}

/// A frame whose gap differs from the wanted one by no more than this part of it is at that gap.
constexpr double AT_WANTED_GAP = 0.1;

struct GapNote {
  double smallest = 0.0;  ///< Fraction of the diagonal, as all here.
  double time_of_smallest = 0.0;
  double floor = 0.0;
  std::size_t intersecting_frames = 0;
  std::size_t frames_at_wanted_gap = 0;

  bool sound() const { return intersecting_frames == 0 && smallest >= floor; }
};

GapNote note_gaps(const PathInterpolator& interpolator, const PathSpec& spec, const PathScene& scene,
                  const std::string& file) {
  ProgressBar bar(talk_welcome());
  const Path frames = resample(interpolator, spec.frame_rate);
  const GapMeasure measure = measure_gaps(frames, scene.distance, progress_on(bar, "check", file));
  std::size_t at_wanted_gap = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double wanted = scene.diagonal * wanted_gap(spec.gaps, frames[k].time - interpolator.start_time());
    if (std::abs(measure.gaps[k] - wanted) <= AT_WANTED_GAP * wanted) ++at_wanted_gap;
  }
  return {.smallest = measure.smallest() / scene.diagonal,
          .time_of_smallest = frames[measure.nearest_frame].time,
          .floor = spec.gap_floor,
          .intersecting_frames = measure.frames_within(0.0),
          .frames_at_wanted_gap = at_wanted_gap};
}

void print_facts(const std::string& file, const PathFacts& facts, double rate,
                 const std::optional<GapNote>& gaps, bool json) {
  if (json) {
    const auto corner = [](const Vec3& p) { return nlohmann::ordered_json::array({p.x(), p.y(), p.z()}); };
    nlohmann::ordered_json line{
        {"path", file},
        {"poses", facts.pose_count},
        {"start_time_s", facts.start_time},
        {"duration_s", facts.duration},
        {"sample_interval_s", facts.sample_interval},
        {"longest_interval_s", facts.longest_interval},
        {"gaps", facts.gaps},
        {"frame_rate_hz", rate},
        {"frames", facts.frame_count},
        {"length_m", facts.length},
        {"turning_deg", facts.turning * DEGREES},
        {"maximum_speed_m_per_s", facts.maximum_speed},
        {"maximum_acceleration_m_per_s2", facts.maximum_acceleration},
        {"maximum_angular_speed_deg_per_s", facts.maximum_angular_speed * DEGREES},
        {"maximum_angular_acceleration_deg_per_s2", facts.maximum_angular_acceleration * DEGREES},
        {"lower_corner_m", corner(facts.lower_corner)},
        {"upper_corner_m", corner(facts.upper_corner)}};
    if (gaps)
      line.update({{"smallest_gap_diagonal", gaps->smallest},
                   {"time_of_smallest_gap_s", gaps->time_of_smallest},
                   {"gap_floor_diagonal", gaps->floor},
                   {"frames_at_wanted_gap", gaps->frames_at_wanted_gap},
                   {"intersecting_frames", gaps->intersecting_frames}});
    fmt::print("{}\n", json_line(line));
    return;
  }
  fmt::print("{}: {} poses, {:.6g} s from {:.6g} s; {} frames at {:g} Hz\n", file, facts.pose_count,
             facts.duration, facts.start_time, facts.frame_count, rate);
  if (facts.pose_count > 1)
    fmt::print(
        "  a pose every {:.4g} s in the median, {:.4g} s at most; {} gaps are held, not interpolated\n",
        facts.sample_interval, facts.longest_interval, facts.gaps);
  fmt::print("  way {:.4g} m, turning {:.4g} deg\n", facts.length, facts.turning * DEGREES);
  if (facts.pose_count > 1 && facts.frame_count < 3)
    fmt::print("  no speeds and accelerations: it is shorter than two frames at {:g} Hz\n", rate);
  else if (facts.pose_count > 1)
    fmt::print("  at most {:.3g} m/s, {:.3g} m/s^2, {:.3g} deg/s, {:.3g} deg/s^2\n", facts.maximum_speed,
               facts.maximum_acceleration, facts.maximum_angular_speed * DEGREES,
               facts.maximum_angular_acceleration * DEGREES);
  if (!gaps) return;
  fmt::print("  smallest gap {:.4g} % of the diagonal, at {:.6g} s (floor {:.4g} %); {} frames intersect\n",
             100.0 * gaps->smallest, gaps->time_of_smallest, 100.0 * gaps->floor, gaps->intersecting_frames);
  fmt::print("  {} frames within {:.0f} % of the wanted gap\n", gaps->frames_at_wanted_gap,
             100.0 * AT_WANTED_GAP);
}

/// Generated paths have a mark in their first line; recorded ones have none.
bool is_generated_path(const std::filesystem::path& file) {
  const std::string head = first_bytes(file);
  return head.starts_with("# ") &&
         head.substr(0, head.find('\n')).find(GENERATED_PATH_MARK) != std::string::npos;
}

/// File of a specification's mesh, which may be missing.
std::filesystem::path mesh_file(const PlacedMesh& placed, const PathArguments& arguments) {
  if (is_mesh_name(placed.mesh)) return built_mesh_file(arguments.mesh_folder, placed.mesh);
  return std::filesystem::path(arguments.spec).parent_path() / placed.mesh;
}

void generate(const PathArguments& arguments) {
  const PathSpec spec = read_path_spec(arguments.spec);
  refuse_unsafe_output(arguments.path, {.what = "generated path", .is_ours = &is_generated_path},
                       {arguments.spec, std::filesystem::path(arguments.mesh_folder) / "manifest.json",
                        mesh_file(spec.moving, arguments), mesh_file(spec.fixed, arguments)},
                       "--out");
  const PathScene scene = load_scene(spec, arguments);
  Path path;
  {
    ProgressBar bar(talk_welcome());
    path = generate_path(spec, scene, progress_on(bar, "generate", arguments.spec));
  }
  const std::string comment =
      fmt::format("{} past {}, {} {}'", name_of(spec.moving), name_of(spec.fixed), GENERATED_PATH_MARK,
                  std::filesystem::path(arguments.spec).filename().string());
  const std::string text = tum_text(path, comment, stored_decimals(scene));
  // Readers will have the rounded poses, interpolated.
  std::istringstream stream(text);
  const PathInterpolator interpolator(read_tum(stream, arguments.path));
  const GapNote gaps = note_gaps(interpolator, spec, scene, arguments.spec);
  if (!gaps.sound())
    throw UsageError(
        arguments.spec, "/gap_floor",
        fmt::format("at {:.6g} s the path comes to {:.4g} of the diagonal, below {:.4g}; nothing was "
                    "written",
                    gaps.time_of_smallest, gaps.smallest, gaps.floor),
        "store more poses a second, move more slowly, or keep the gaps further above the floor");
  write_file_atomically(arguments.path, text);
  spdlog::info("wrote {}", arguments.path);
  if (arguments.json || talk_welcome())
    print_facts(arguments.path, path_facts(interpolator, spec.frame_rate), spec.frame_rate, gaps,
                arguments.json);
}

void info(const PathArguments& arguments) {
  const PathInterpolator interpolator(read_tum(std::filesystem::path(arguments.path)), Interpolation::CUBIC,
                                      USUAL_GAP_INTERVALS);
  double rate = arguments.rate;
  std::optional<GapNote> gaps;
  refuse_too_many_frames(interpolator, rate, std::nullopt, arguments.path);
  if (!arguments.spec.empty()) {
    const PathSpec spec = read_path_spec(arguments.spec);
    rate = spec.frame_rate;
    refuse_too_many_frames(interpolator, rate, std::nullopt, arguments.path);
    gaps = note_gaps(interpolator, spec, load_scene(spec, arguments), arguments.spec);
  }
  print_facts(arguments.path, path_facts(interpolator, rate), rate, gaps, arguments.json);
  if (gaps && !gaps->sound())
    throw Error(
        ExitCode::CHECK_FAILED, arguments.path, fmt::format("time {:.6g}", gaps->time_of_smallest),
        fmt::format("the gap falls to {:.4g} of the diagonal, below the specification's floor of {:.4g}",
                    gaps->smallest, gaps->floor),
        "generate the path again, with the meshes that its specification names");
}

}  // namespace

void add_path_command(CLI::App& app) {
  CLI::App* path = app.add_subcommand("path", "Make paths that keep a wanted gap, and describe paths");
  path->require_subcommand(1);
  const auto arguments = std::make_shared<PathArguments>();
  const auto add_common = [&](CLI::App* command) {
    add_mesh_folder_option(*command, arguments->mesh_folder);
    command->add_flag("--json", arguments->json, "one JSON object");
  };

  CLI::App* generate_command =
      path->add_subcommand("generate", "make a path from its specification and check every frame's gap");
  generate_command->add_option("SPEC", arguments->spec, "specification (JSON)")->required();
  generate_command->add_option("--out", arguments->path, "path file to write (TUM)")->required();
  add_common(generate_command);
  generate_command->callback([arguments] { generate(*arguments); });

  CLI::App* info_command = path->add_subcommand("info", "describe a path: times, ways, speeds, and its gaps");
  info_command->add_option("FILE", arguments->path, "path file (TUM)")->required();
  info_command->add_option("--spec", arguments->spec,
                           "specification of the path: check every frame's gap; exit code 1 below its floor");
  info_command
      ->add_option("--rate", arguments->rate, "frames a second for the speeds; the specification's if given")
      ->check(real_range(CLI::Range(1e-3, 1e6)))
      ->capture_default_str();
  add_common(info_command);
  info_command->callback([arguments] { info(*arguments); });
}

}  // namespace lmdbench
