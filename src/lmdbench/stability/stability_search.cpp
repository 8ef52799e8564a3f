// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/stability_boundary.h>
#include <lmdbench/stability/stability_search.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace lmdbench {
namespace {

/// Stands for a stiffness that the device cannot render: any positive number.
constexpr double CLIPPED_GROWTH = 1.0;
/// Stands for a contact too soft to carry the push: the critical stiffness lies above.
constexpr double SINKING_GROWTH = -1.0;
/// Stands for a clean swing that neither grows nor decays, as all within the encoders' counts: a
/// root finder would take exactly 0 for the boundary.
constexpr double CALM_GROWTH = -1.0;
/// A push P moves a linear contact by P / K: from this multiple of the friction on, a tap of
/// FRICTION_TAP_SHARE of that exceeds STICTION_BANDS at any stiffness.
constexpr double PUSH_PER_FRICTION = STICTION_BANDS / FRICTION_TAP_SHARE;

/// Thrown when the budget of a search is spent.
class BudgetSpent {};

/// Result of a trial.
enum class Verdict : std::uint8_t {
  CLEAN,
  UNCLEAN,
  STUCK,   ///< Held by friction: shows nothing.
  UNSEEN,  ///< By encoders: shows nothing.
  SINKING  ///< Too soft to carry the push, or to carry it unsaturated.
};

/// A search on one method.
class Search {
 public:
  Search(const Experiment& experiment, const PreparedRun& prepared, DrivenMethod method,
         const RunProgress& progress, const StabilityBudget& budget)
      : experiment_(experiment),
        prepared_(prepared),
        method_(std::move(method)),
        progress_(progress),
        budget_(budget) {}

  void run(SampledLoop loop, StabilityRow& row) {
    try {
      search(std::move(loop), row);
    } catch (const BudgetSpent&) {
      row.clean_until = "undecided";
    }
    if (best_ > 0.0) {
      row.critical_stiffness_n_per_m = best_;
      row.tap_m = tap_;
    }
    row.trials = trials_;
  }

 private:
  void search(SampledLoop loop, StabilityRow& row) {
    double scale = 1.0;
    StabilityTrial given = try_scale(scale);
    for (int i = 0; i < MOST_BRACKETINGS && !given.carried; ++i) given = try_scale(scale *= BRACKET_FACTOR);
    // Under a push a softer contact leaves more way, which encoders may see.
    for (int i = 0; i < MOST_BRACKETINGS && given.within_counts && !experiment_.loop.push_n.isZero(0.0);
         ++i) {
      const StabilityTrial softer = try_scale(scale / BRACKET_FACTOR);
      if (!softer.carried || !softer.in_contact) break;
      scale /= BRACKET_FACTOR;
      given = softer;
    }
    if (loop.turn) loop.turn->lever_m = given.lever_m;
    row.exact_n_per_m = critical_stiffness(loop);
    row.bound_n_per_m = sufficient_stiffness(loop);
    if (!given.in_contact) {
      row.clean_until = given.saturated ? "saturated" : given.gives_way ? "gives_way" : "no_contact";
    } else if (given.within_counts) {
      row.clean_until = "within_counts";
    } else if (given.carried && has_friction(experiment_.loop)) {
      search_with_friction(scale, given, row);
    } else if (!given.carried || (row.exact_n_per_m == 0.0 && !counts())) {
      // Nothing to search for: without damping, friction and counts every stiffness diverges.
      row.clean_until = "never";
    } else {
      const bool known = std::isfinite(row.exact_n_per_m) && row.exact_n_per_m > 0.0;
      judge_trial(scale, given);
      search_without_friction(known ? scale * row.exact_n_per_m / given.stiffness_n_per_m : scale, row);
    }
  }

  void search_without_friction(double guess, StabilityRow& row) {
    double low = guess * (1.0 - FIRST_BRACKET);
    double growth_low = growth(low);
    double high = low;
    double growth_high = growth_low;
    if (growth_low <= 0.0) growth_high = growth(high = guess * (1.0 + FIRST_BRACKET));
    // Scales of F_max that bracket the growth's change of sign.
    for (int i = 0; i < MOST_BRACKETINGS && growth_low > 0.0; ++i) {
      high = std::exchange(low, low / BRACKET_FACTOR);
      growth_high = std::exchange(growth_low, growth(low));
    }
    for (int i = 0; i < MOST_BRACKETINGS && growth_high <= 0.0 && !ends_unseen(); ++i) {
      low = std::exchange(high, high * BRACKET_FACTOR);
      growth_low = std::exchange(growth_high, growth(high));
    }
    if (ends_unseen()) return end_where_encoders_see(high, row);
    if (growth_low < 0.0 && growth_high > 0.0) refine(low, high, growth_low, growth_high);
    row.clean_until = best_ == 0.0         ? (last_ == Verdict::UNSEEN ? "within_counts" : "never")
                      : growth_high <= 0.0 ? "nothing"
                                           : broken_by_;
  }

  /// Whether the last trial shows nothing, but one before it was clean.
  bool ends_unseen() const { return last_ == Verdict::UNSEEN && best_ > 0.0; }

  /// Between the largest clean scale and one at which encoders see no tap.
  void end_where_encoders_see(double unseen, StabilityRow& row) {
    row.clean_until = "within_counts";
    for (double low = best_scale_; unseen > low * (1.0 + FRICTION_TOLERANCE);) {
      const double middle = std::sqrt(low * unseen);
      const Verdict at_middle = verdict(middle);
      (at_middle == Verdict::CLEAN ? low : unseen) = middle;
      if (at_middle == Verdict::UNCLEAN) row.clean_until = broken_by_;
    }
  }

  void search_with_friction(double scale, const StabilityTrial& given, StabilityRow& row) {
    double low = scale;
    const Verdict at_first = judge_trial(low, given);
    Verdict at_low = at_first;
    double high = low;
    Verdict at_high = at_low;
    for (int i = 0; i < MOST_BRACKETINGS && at_low == Verdict::UNCLEAN; ++i) {
      high = std::exchange(low, low / FRICTION_FACTOR);
      at_high = std::exchange(at_low, verdict(low));
    }
    for (int i = 0;
         i < MOST_BRACKETINGS && at_low != Verdict::UNCLEAN && at_high != Verdict::UNCLEAN && !ends_unseen();
         ++i) {
      if (high > low) low = high, at_low = at_high;
      at_high = verdict(high = low * FRICTION_FACTOR);
    }
    if (ends_unseen()) return end_where_encoders_see(high, row);
    while (at_low != Verdict::UNCLEAN && at_high == Verdict::UNCLEAN &&
           high > low * (1.0 + FRICTION_TOLERANCE)) {
      const double middle = std::sqrt(low * high);
      const Verdict at_middle = verdict(middle);
      if (at_middle == Verdict::UNCLEAN)
        high = middle;
      else
        low = middle, at_low = at_middle;
    }
    if (at_high != Verdict::UNCLEAN && best_ > 0.0) {
      row.clean_until = "nothing";
    } else if (at_low == Verdict::CLEAN) {
      row.clean_until = broken_by_;
    } else {
      const bool stuck = at_first == Verdict::STUCK || (at_low == Verdict::STUCK && best_ > 0.0);
      best_ = 0.0;  // below the band proves nothing above it
      row.clean_until = stuck ? "stuck" : at_low == Verdict::UNSEEN ? "within_counts" : "never";
    }
  }

  /// Whether the encoders count, which can hold a swing that nothing damps.
  bool counts() const {
    const LoopChoice& loop = experiment_.loop;
    return loop.resolution_m > 0.0 || (loop.rotation && loop.rotation->resolution_rad > 0.0);
  }

  StabilityTrial try_scale(double scale) {
    if (trials_ >= budget_.trials) throw BudgetSpent();
    ++trials_;
    DrivenMethod scaled = method_;
    scaled.profile.scale_force(scale);
    const std::string phase =
        fmt::format("{} trial {}{}", method_.label, trials_,
                    best_ > 0.0 ? fmt::format(", clean to {:.4g} N/m", best_) : std::string());
    return try_stiffness(experiment_, prepared_.input, scaled, [&](std::int64_t, std::int64_t) {
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count() > budget_.seconds)
        throw BudgetSpent();
      return !progress_ || progress_(phase, 0, -1);
    });
  }

  /// Judges a trial and remembers its result.
  Verdict judge_trial(double scale, const StabilityTrial& trial) { return last_ = judged(scale, trial); }

  Verdict judged(double scale, const StabilityTrial& trial) {
    if (!trial.carried || !trial.in_contact) return Verdict::SINKING;
    if (trial.stuck) return Verdict::STUCK;
    if (trial.within_counts) return Verdict::UNSEEN;
    if (!trial.clipped && trial.outcome.clean()) {
      if (trial.stiffness_n_per_m > best_) {
        best_ = trial.stiffness_n_per_m;
        best_scale_ = scale;
        tap_ = trial.tap_m;
      }
      return Verdict::CLEAN;
    }
    if (worst_ == 0.0 || scale < worst_) {
      worst_ = scale;
      broken_by_ = trial.clipped       ? "device_force"
                   : trial.limit_cycle ? "limit_cycle"
                                       : to_string(trial.outcome.fastest);
    }
    return Verdict::UNCLEAN;
  }

  Verdict verdict(double scale) { return judge_trial(scale, try_scale(scale)); }

  /// Positive where the contact is not clean with F_max scaled so.
  double growth(double scale) {
    const StabilityTrial trial = try_scale(scale);
    const Verdict said = judge_trial(scale, trial);
    if (said == Verdict::SINKING) return SINKING_GROWTH;
    if (said == Verdict::STUCK || said == Verdict::UNSEEN) return CALM_GROWTH;
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
  DrivenMethod method_;
  const RunProgress& progress_;
  StabilityBudget budget_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::int64_t trials_ = 0;
  Verdict last_ = Verdict::SINKING;
  double best_ = 0.0;  ///< Largest clean stiffness.
  double best_scale_ = 0.0;
  double tap_ = UNSET;  ///< Of the trial that found it.
  double worst_ = 0.0;  ///< Smallest unclean one; 0: none yet.
  std::string broken_by_;
};

}  // namespace

bool StabilityRow::has_answer() const {
  return !std::isnan(critical_stiffness_n_per_m) && clean_until != "undecided";
}

std::string advice(const StabilityRow& row) {
  if (row.has_answer()) return "";
  const std::string who = row.method + ", " + row.profile + ": ";
  if (row.clean_until == "no_contact")
    return who +
           "finds no contact at the path's first pose, nor where the push can reach from it (remedy: begin "
           "the path where the "
           "meshes are nearer than the cutoff, `lmdbench init --contact` finds such a pose; where other "
           "methods find a contact, this one "
           "misses it)";
  if (row.clean_until == "saturated")
    return who +
           "the path begins nearer than the saturation distance, where the force does not change any more "
           "and a contact has no "
           "stiffness (remedy: begin it farther out, or lower /force/saturation_m; `lmdbench init --contact` "
           "finds a pose)";
  if (row.clean_until == "gives_way")
    return who +
           "the force at the path's first pose does not fall as the mesh moves along it: its contacts turn "
           "away, so it has no stiffness "
           "(remedy: begin the path where the contacts are nearer, or press against a flatter place)";
  if (row.clean_until == "stuck")
    return who + fmt::format(
                     "friction of {:g} N holds the device against every tap that the contact bears, so no "
                     "stiffness is shown to be clean "
                     "(remedy: press harder, /loop/push_n of more than {:.3g} N, or begin the path deeper "
                     "within a larger cutoff)",
                     row.friction_n, PUSH_PER_FRICTION * row.friction_n);
  if (row.clean_until == "within_counts")
    return who +
           "the contact leaves less way than the encoders count, so that no tap would be seen (remedy: begin "
           "the path deeper "
           "within a larger cutoff, press harder with /loop/push_n, or a finer /loop/resolution_m)";
  if (row.clean_until == "undecided")
    return who +
           fmt::format("the search was ended after {} trials; {} (remedy: raise --seconds or --trials)",
                       row.trials,
                       std::isnan(row.critical_stiffness_n_per_m)
                           ? std::string("none of them was clean")
                           : fmt::format("clean was {:.6g} N/m at most", row.critical_stiffness_n_per_m));
  return who +
         "no stiffness that carries the load is clean (remedy: a smaller /loop/push_n, more damping, a hand, "
         "fresher LMD sets, or another resting pose: on a convex contact a device without a hand slides "
         "off)";
}

std::vector<StabilityRow> find_critical_stiffness(const Experiment& experiment, const RunProgress& progress,
                                                  const StabilityBudget& budget) {
  if (!experiment.loop.closed)
    throw UsageError(experiment.file.string(), "/loop/kind", "the loop is open, so nothing can shake",
                     "set it to closed");
  PreparedRun prepared = prepare(experiment, {}, Deforming::FOLLOWED);
  hold_first_frame(prepared);
  SampledLoop sampled{experiment.loop.dynamics, 1.0 / experiment.frame_rate_hz, experiment.loop.delay_frames};
  if (experiment.loop.rotation) sampled.turn = SampledTurn{experiment.loop.rotation->dynamics, 0.0};
  StabilityRow common;
  common.delay_frames = experiment.loop.delay_frames;
  common.servo_rate_hz = experiment.frame_rate_hz;
  common.mass_kg = experiment.loop.dynamics.mass_kg;
  common.damping_n_s_per_m = experiment.loop.dynamics.damping_n_s_per_m;
  common.friction_n = experiment.loop.dynamics.friction_n;

  std::vector<StabilityRow> rows;
  std::vector<DrivenMethod> methods = driven_methods(experiment, prepared);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    DrivenMethod& method = methods[i];
    const std::string& name = experiment.profiles[experiment.methods[i].profile].name;
    StabilityRow row = common;
    row.method = experiment.methods[i].entry;
    row.profile = !name.empty() ? name : std::string(to_string(method.profile.law));
    Search(experiment, prepared, std::move(method), progress, budget).run(sampled, row);
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
                    {"clean_until", row.clean_until},
                    {"tap_m", row.tap_m},
                    {"trials", row.trials}});
  return json.dump(2);
}

std::string stability_text(const std::vector<StabilityRow>& rows) {
  std::string text = fmt::format(
      "{:<16} {:<12} {:>6} {:>9} {:>8} {:>10} {:>14} {:>14} {:>12} {:>9} {:>6}  {}\n", "method", "profile",
      "delay", "rate", "mass", "damping", "critical", "exact", "bound", "tap", "trials", "clean until");
  text += fmt::format("{:<16} {:<12} {:>6} {:>9} {:>8} {:>10} {:>14} {:>14} {:>12} {:>9} {:>6}\n", "", "",
                      "frames", "Hz", "kg", "N s/m", "N/m", "N/m", "N/m", "m", "");
  for (const StabilityRow& row : rows)
    text += fmt::format(
        "{:<16} {:<12} {:>6} {:>9g} {:>8g} {:>10g} {:>14.4f} {:>14.4f} {:>12.4f} {:>9.3g} {:>6}  {}\n",
        row.method, row.profile, row.delay_frames, row.servo_rate_hz, row.mass_kg, row.damping_n_s_per_m,
        row.critical_stiffness_n_per_m, row.exact_n_per_m, row.bound_n_per_m, row.tap_m, row.trials,
        row.clean_until);
  if (std::any_of(rows.begin(), rows.end(), [](const StabilityRow& row) { return row.friction_n > 0.0; }))
    text +=
        "critical: largest clean stiffness, with the device's friction, for this tap; exact: boundary of the "
        "linear loop without "
        "friction; bound: sufficient, b / (T/2 + delay)\n";
  else
    text +=
        "critical: largest clean stiffness; exact: boundary of the linear loop; bound: sufficient, b / (T/2 "
        "+ delay)\n";
  return text;
}

}  // namespace lmdbench
