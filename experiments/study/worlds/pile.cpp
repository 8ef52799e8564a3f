// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/scatter.h>
#include <lmdbench/scene/scene_search.h>

#include <study/worlds/cost.h>
#include <study/worlds/heap.h>
#include <study/worlds/pile.h>
#include <support/random.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <set>

namespace lmdbench::worlds {
namespace {

/// Poses of the spheres by frame. Correctly rounded operations alone: the same on every machine.
class PileScript {
 public:
  PileScript(PileMotion motion, std::vector<Pose> sites, double spacing, const PileChoice& choice)
      : motion_(motion), sites_(std::move(sites)), choice_(choice) {
    experiments::Random random(choice.seed + 1);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      direction_.push_back(random.direction());
      axis_.push_back(random.direction());
      phase_.push_back(random.uniform());
    }
    if (motion_ != PileMotion::STIRRED) return;
    // Layers stand above each other, not in the hollows of the next one, so that they can turn.
    for (Pose& site : sites_) {
      Vec3& place = site.translation;
      layer_.push_back(std::lround(place.z() / (spacing * std::sqrt(2.0 / 3.0))));
      place.z() = spacing * static_cast<double>(layer_.back());
      widest_ = std::max(widest_, std::hypot(place.x(), place.y()));
    }
  }

  void at(std::size_t frame, std::vector<Pose>& poses) const {
    poses = sites_;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (motion_ == PileMotion::SETTLING) {
        const double left = 1.0 - static_cast<double>(frame) / static_cast<double>(choice_.frames);
        poses[i].translation *= 1.0 + choice_.looseness * left * left;
      }
      if (motion_ == PileMotion::STIRRED && widest_ > 0.0) {
        const double half = 0.5e-3 * static_cast<double>(frame) * choice_.stirring_speed / widest_;
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(1.0, 0.0, 0.0, layer_[i] % 2 == 0 ? half : -half).normalized();
        poses[i].translation = turn * poses[i].translation;
        poses[i].rotation = (turn * poses[i].rotation).normalized();
      }
      swing(i, frame, poses[i]);
    }
  }

 private:
  void swing(std::size_t i, std::size_t frame, Pose& pose) const {
    // A parabola forth and one back, whose slope is at most 8 amplitudes a period.
    constexpr double PERIOD = 40.0;
    const double amplitude = choice_.swing_speed * 1e-3 * PERIOD / 8.0;
    const double x = static_cast<double>(frame) / PERIOD + phase_[i], part = 2.0 * (x - std::floor(x));
    const double u = part < 1.0 ? part : part - 1.0;
    const double swing = (part < 1.0 ? 4.0 : -4.0) * u * (1.0 - u);
    pose.translation += amplitude * swing * direction_[i];
    const Vec3 half = 0.5 * amplitude / choice_.radius * swing * axis_[i];
    pose.rotation =
        (Eigen::Quaterniond(1.0, half.x(), half.y(), half.z()).normalized() * pose.rotation).normalized();
  }

  PileMotion motion_;
  std::vector<Pose> sites_;
  const PileChoice& choice_;
  std::vector<Vec3> direction_, axis_;
  std::vector<double> phase_;
  std::vector<long> layer_;
  double widest_ = 0.0;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// One pass over a pile. Counters replace those of the last pass, which are the same.
void run_pass(const std::shared_ptr<const Body>& sphere, const PileScript& script, const PileChoice& choice,
              const BroadPhase::Tuning& tuning, PileRow& row) {
  const MethodDescription& certified = method_description("certified");
  const auto make = [&certified, options = complete_options(certified, {}, "")](const Scene& of_pair) {
    return certified.make(of_pair, options);
  };
  const double heap = heap_in_use();
  const auto poses = std::make_shared<std::vector<Pose>>();
  script.at(0, *poses);
  SceneSearch search({sphere, {}, choice.cutoff, std::vector(row.movers, sphere), 0, poses}, certified, make,
                     tuning);
  LmdSet lmds;
  WorkCounters work;
  auto begin = std::chrono::steady_clock::now();
  search.search(poses->front(), lmds, work);
  row.first_seconds = std::min(row.first_seconds, seconds_since(begin));
  work = {};
  std::size_t all = 0;
  for (std::size_t frame = 0; frame < choice.frames; ++frame) {
    script.at(frame + 1, *poses);
    begin = std::chrono::steady_clock::now();
    search.search(poses->front(), lmds, work);
    row.seconds[frame] = std::min(row.seconds[frame], seconds_since(begin));
    std::set<std::int32_t> pairs;
    for (const Lmd& lmd : lmds) pairs.insert(lmd.fixed_body);
    row.contact_pairs[frame] = pairs.size();
    all += lmds.size();
  }
  const auto a_frame = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(choice.frames);
  };
  row.lmds = a_frame(all);
  row.touched = a_frame(counted(search, work, "pairs_touched"));
  row.searched = a_frame(counted(search, work, "pairs_searched"));
  row.anchored = a_frame(counted(search, work, "broad_phase_queries"));
  row.node_pairs = a_frame(counted(search, work, "node_pairs"));
  row.candidates = search.candidate_count();
  row.methods = search.method_count();
  row.bytes = heap_in_use() - heap;
}

}  // namespace

const char* to_string(PileMotion motion) {
  return motion == PileMotion::JOSTLING   ? "jostling"
         : motion == PileMotion::SETTLING ? "settling"
                                          : "stirred";
}

double PileRow::seconds_per_contact_pair() const {
  const std::size_t pairs = std::accumulate(contact_pairs.begin(), contact_pairs.end(), std::size_t{0});
  if (pairs == 0) return std::numeric_limits<double>::quiet_NaN();
  // Frames without contact, before a pile has come together, do not count.
  double sum = 0.0;
  for (std::size_t i = 0; i < seconds.size(); ++i)
    if (contact_pairs[i] > 0) sum += seconds[i];
  return sum / static_cast<double>(pairs);
}

std::size_t PileRow::frames_above(double limit) const {
  return static_cast<std::size_t>(
      std::count_if(seconds.begin(), seconds.end(), [limit](double s) { return s > limit; }));
}

std::vector<PileRow> measure_piles(PileMotion motion, const PileChoice& choice,
                                   const BroadPhase::Tuning& tuning) {
  const auto sphere =
      std::make_shared<const Body>("sphere", build_surface(make_sphere(choice.radius, choice.subdivisions)));
  const auto& bounds = sphere->prepared<MeshBounds>();
  const double spacing = 2.0 * choice.radius + 0.5 * choice.cutoff;
  std::vector<PileRow> rows;
  std::vector<PileScript> scripts;
  for (const std::size_t count : choice.counts) {
    scripts.emplace_back(motion,
                         scatter({.rule = Scatter::Rule::PILE,
                                  .count = static_cast<std::int64_t>(count),
                                  .spacing = spacing / (2.0 * bounds.half_sides.norm()),
                                  .seed = choice.seed},
                                 bounds),
                         spacing, choice);
    PileRow row;
    row.motion = motion;
    row.movers = count;
    row.triangles = sphere->surface().mesh.triangles.size();
    row.first_seconds = std::numeric_limits<double>::infinity();
    row.seconds.assign(choice.frames, std::numeric_limits<double>::infinity());
    row.contact_pairs.assign(choice.frames, 0);
    rows.push_back(std::move(row));
  }
  for (std::size_t pass = 0; pass < choice.passes; ++pass)
    for (std::size_t k = 0; k < rows.size(); ++k) run_pass(sphere, scripts[k], choice, tuning, rows[k]);
  return rows;
}

}  // namespace lmdbench::worlds
