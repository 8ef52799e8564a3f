// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/stability_search.h>
#include <lmdbench/phantom/stability_boundary.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace lmdbench {
namespace {

/// Growth that stands for a stiffness that the device cannot render: any positive number.
constexpr double CLIPPED_GROWTH = 1.0;
/// Growth that stands for a contact too soft to carry the push: the critical stiffness lies above.
constexpr double SINKING_GROWTH = -1.0;
/// Growth that stands for a clean swing that neither grows nor decays, as all within the encoders' counts are: of exactly 0 a
/// root finder would think that it is the boundary.
constexpr double CALM_GROWTH = -1.0;

/// A search on one method.
class Search {
 public:
  Search(const Experiment& experiment, const PreparedRun& prepared, LockstepMethod method, Progress progress)
      : experiment_(experiment),
        prepared_(prepared),
        method_(std::move(method)),
        progress_(std::move(progress)) {}

  void run(SampledLoop loop, StabilityRow& row) {
    double scale = 1.0;
    StabilityTrial given = try_scale(scale);
    for (int i = 0; i < MOST_BRACKETINGS && !given.carried; ++i) given = try_scale(scale *= BRACKET_FACTOR);
    if (loop.turn) loop.turn->lever_m = given.lever_m;
    row.exact_n_per_m = critical_stiffness(loop);
    row.bound_n_per_m = sufficient_stiffness(loop);
    if (!given.in_contact) {
      row.clean_until = "no_contact";
      return;
    }
    if (row.exact_n_per_m == 0.0 && !anything_holds_it()) {
      row.clean_until = "never";
      return;
    }
    const bool known = std::isfinite(row.exact_n_per_m) && row.exact_n_per_m > 0.0;
    const double guess = known ? scale * row.exact_n_per_m / given.stiffness_n_per_m : scale;
    double low = guess * (1.0 - FIRST_BRACKET);
    double growth_low = growth(low);
    double high = low;
    double growth_high = growth_low;
    if (growth_low <= 0.0) growth_high = growth(high = guess * (1.0 + FIRST_BRACKET));
    // Scales of F_max bracket the growth's change of sign.
    for (int i = 0; i < MOST_BRACKETINGS && growth_low > 0.0; ++i) {
      high = std::exchange(low, low / BRACKET_FACTOR);
      growth_high = std::exchange(growth_low, growth(low));
    }
    for (int i = 0; i < MOST_BRACKETINGS && growth_high <= 0.0; ++i) {
      low = std::exchange(high, high * BRACKET_FACTOR);
      growth_low = std::exchange(growth_high, growth(high));
    }
    if (growth_low < 0.0 && growth_high > 0.0) refine(low, high, growth_low, growth_high);
    if (best_ > 0.0) row.critical_stiffness_n_per_m = best_;
    row.clean_until = best_ == 0.0 ? "never" : growth_high <= 0.0 ? "nothing" : broken_by_;
  }

 private:
  /// Without damping, friction and counts every stiffness diverges, the less of it the more slowly: nothing to search for.
  bool anything_holds_it() const {
    const LoopChoice& loop = experiment_.loop;
    return loop.dynamics.friction_n > 0.0 || loop.resolution_m > 0.0 ||
           (loop.rotation &&
            (loop.rotation->dynamics.friction_n > 0.0 || loop.rotation->resolution_rad > 0.0));
  }

  StabilityTrial try_scale(double scale) {
    LockstepMethod scaled = method_;
    scaled.profile.maximum_force *= scale;
    scaled.profile.largest_sum *= scale;
    return try_stiffness(experiment_, prepared_.input, scaled, progress_);
  }

  /// Positive where the contact under that scale of F_max is not clean.
  double growth(double scale) {
    const StabilityTrial trial = try_scale(scale);
    if (!trial.carried) return SINKING_GROWTH;
    const bool clean = !trial.clipped && trial.outcome.clean();
    if (clean) {
      best_ = std::max(best_, trial.stiffness_n_per_m);
    } else if (worst_ == 0.0 || scale < worst_) {
      worst_ = scale;
      broken_by_ = trial.clipped ? "device_force" : to_string(trial.outcome.fastest);
    }
    if (trial.clipped) return CLIPPED_GROWTH;
    return trial.outcome.growth == 0.0 ? CALM_GROWTH : trial.outcome.growth;
  }

  void refine(double low, double high, double growth_low, double growth_high) {
    std::uintmax_t iterations = MOST_REFINEMENTS;
    boost::math::tools::toms748_solve(
        [this](double scale) { return growth(scale); }, low, high, growth_low, growth_high,
        [](double a, double b) { return std::abs(b - a) <= STIFFNESS_TOLERANCE * std::abs(a); }, iterations);
  }

  const Experiment& experiment_;
  const PreparedRun& prepared_;
  LockstepMethod method_;
  Progress progress_;
  double best_ = 0.0;   ///< Largest clean stiffness.
  double worst_ = 0.0;  ///< Smallest one that is not; 0: none yet.
  std::string broken_by_;
};

}  // namespace

std::vector<StabilityRow> find_critical_stiffness(const Experiment& experiment, const RunProgress& progress) {
  if (!experiment.loop.closed)
    throw UsageError(experiment.file.string(), "/loop/kind", "the loop is open, so nothing can shake",
                     "set it to closed");
  const PreparedRun prepared = prepare(experiment);
  SampledLoop sampled{experiment.loop.dynamics, 1.0 / experiment.frame_rate_hz, experiment.loop.delay_frames};
  if (experiment.loop.rotation) sampled.turn = SampledTurn{experiment.loop.rotation->dynamics, 0.0};
  StabilityRow common;
  common.delay_frames = experiment.loop.delay_frames;
  common.servo_rate_hz = experiment.frame_rate_hz;
  common.mass_kg = experiment.loop.dynamics.mass_kg;
  common.damping_n_s_per_m = experiment.loop.dynamics.damping_n_s_per_m;

  std::vector<StabilityRow> rows;
  std::vector<LockstepMethod> methods = lockstep_methods(experiment, prepared);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    LockstepMethod& method = methods[i];
    const std::string& name = experiment.profiles[experiment.methods[i].profile].name;
    StabilityRow row = common;
    row.method = experiment.methods[i].entry;
    row.profile = !name.empty() ? name : method.profile.law == ForceLaw::LINEAR ? "linear" : "exponential";
    std::int64_t trials = 0;
    Progress counted;
    if (progress)
      counted = [&](std::int64_t done, std::int64_t total) {
        // How many trials a search takes is not known beforehand: the bar shows the trial under way.
        if (done <= 256) ++trials;
        return progress(fmt::format("{} trial {}", method.label, trials), done, total);
      };
    Search(experiment, prepared, std::move(method), counted).run(sampled, row);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string stability_json(const std::vector<StabilityRow>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const StabilityRow& row : rows)
    json.push_back({{"method", row.method},
                    {"profile", row.profile},
                    {"delay_frames", row.delay_frames},
                    {"servo_rate_hz", row.servo_rate_hz},
                    {"mass_kg", row.mass_kg},
                    {"damping_n_s_per_m", row.damping_n_s_per_m},
                    {"critical_stiffness_n_per_m", row.critical_stiffness_n_per_m},
                    {"exact_n_per_m", row.exact_n_per_m},
                    {"bound_n_per_m", row.bound_n_per_m},
                    {"clean_until", row.clean_until}});
  return json.dump(2);
}

std::string stability_text(const std::vector<StabilityRow>& rows) {
  std::string text =
      fmt::format("{:<16} {:<12} {:>6} {:>9} {:>8} {:>10} {:>14} {:>14} {:>12}  {}\n", "method", "profile",
                  "delay", "rate", "mass", "damping", "critical", "exact", "bound", "clean until");
  text += fmt::format("{:<16} {:<12} {:>6} {:>9} {:>8} {:>10} {:>14} {:>14} {:>12}\n", "", "", "frames", "Hz",
                      "kg", "N s/m", "N/m", "N/m", "N/m");
  for (const StabilityRow& row : rows)
    text += fmt::format("{:<16} {:<12} {:>6} {:>9g} {:>8g} {:>10g} {:>14.4f} {:>14.4f} {:>12.4f}  {}\n",
                        row.method, row.profile, row.delay_frames, row.servo_rate_hz, row.mass_kg,
                        row.damping_n_s_per_m, row.critical_stiffness_n_per_m, row.exact_n_per_m,
                        row.bound_n_per_m, row.clean_until);
  return text;
}

}  // namespace lmdbench
