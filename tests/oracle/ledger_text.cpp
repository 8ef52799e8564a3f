// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "oracle/ledger.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace lmdbench::exact {
namespace {

/// Rows of each party that the text shows; the JSON has all.
constexpr std::size_t SHOWN = 3;

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "INFINITY";
}

std::string paste(const Vec3& p) {
  return fmt::format("Vec3({}, {}, {})", number(p[0]), number(p[1]), number(p[2]));
}

std::string paste(const Triangle& t) {
  return fmt::format("Triangle{{{}, {}, {}}}", paste(t[0]), paste(t[1]), paste(t[2]));
}

std::string verdict(const Opinion& opinion, double truth) {
  if (!opinion.wrong) return "right";
  if (std::isinf(opinion.distance)) return "found no pair";
  if (truth == 0.0) return fmt::format("sees {:.3g} m where they touch", opinion.distance);
  if (opinion.distance == 0.0) return "sees contact where there is none";
  return fmt::format("{} by {:.3g} of the distance", opinion.distance > truth ? "too far" : "too near",
                     opinion.relative_error);
}

std::string row_text(const LedgerRow& row) {
  std::string text = fmt::format("Frame {}, exact distance {} m", row.frame, number(row.truth));
  for (const Opinion& opinion : row.opinions)
    text += fmt::format("; {} {} ({})", opinion.who, number(opinion.distance), verdict(opinion, row.truth));
  const Vec3& p = row.pose.translation;
  const Eigen::Quaterniond& q = row.pose.rotation;
  text += fmt::format(
      ".\n\n    // triangle {} of the moving mesh and {} of fixed mesh {}\n    const Pose X_WM{{{}, "
      "Eigen::Quaterniond({}, {}, {}, {})}};  // w, x, y, z\n    const Triangle moving_W{};\n    const "
      "Triangle "
      "fixed_W{};\n    // FCL's kernel on these two alone: {} as the probe scales them, {} in metres\n\n",
      row.triangle_moving, row.triangle_fixed, row.fixed_body, paste(p), number(q.w()), number(q.x()),
      number(q.y()), number(q.z()), paste(row.moving_W).substr(8), paste(row.fixed_W).substr(8),
      number(row.fcl_on_pair), number(row.fcl_unscaled_on_pair));
  return text;
}

struct Tally {
  int judged = 0, wrong = 0, false_contacts = 0, missed_contacts = 0, no_pair = 0;
  double worst = 0.0;
  std::vector<std::pair<double, const LedgerRow*>> rows;  ///< error, row
};

std::map<std::string, Tally> tallies(const Ledger& ledger) {
  std::map<std::string, Tally> result;
  for (const LedgerRow& row : ledger.rows) {
    for (const Opinion& opinion : row.opinions) {
      Tally& tally = result[opinion.who];
      ++tally.judged;
      if (!opinion.wrong) continue;
      ++tally.wrong;
      tally.false_contacts += opinion.distance == 0.0;
      tally.missed_contacts += row.truth == 0.0;
      tally.no_pair += std::isinf(opinion.distance);
      if (opinion.distance > 0.0 && row.truth > 0.0 && std::isfinite(opinion.distance))
        tally.worst = std::max(tally.worst, opinion.relative_error);
      tally.rows.emplace_back(opinion.relative_error, &row);
    }
  }
  return result;
}

nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const Triangle& t) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Vec3& p : t) json.push_back({p[0], p[1], p[2]});
  return json;
}

}  // namespace

std::string ledger_markdown(const Ledger& ledger) {
  std::string text = fmt::format(
      "## {}\n\n{} frames were cross-checked. In {} of them FCL, the nearest pair and the fresh searches of "
      "the methods "
      "differ (relative tolerance {:g}); with FCL on unscaled meshes as a further party in {}. All are "
      "arbitrated by "
      "exact arithmetic.\n\n| party | judged | wrong | worst relative error | contact where there is none | "
      "no contact where "
      "there is | no pair found |\n|---|---|---|---|---|---|---|\n",
      ledger.experiment, ledger.frames, ledger.disagreements, ledger.tolerance, ledger.rows.size());
  const auto by_party = tallies(ledger);
  for (const auto& [who, tally] : by_party)
    text += fmt::format("| {} | {} | {} | {:.2g} | {} | {} | {} |\n", who, tally.judged, tally.wrong,
                        tally.worst, tally.false_contacts, tally.missed_contacts, tally.no_pair);
  text += "\n";
  for (const auto& [who, tally] : by_party) {
    if (tally.rows.empty()) continue;
    text += fmt::format("### {}: wrong in {}\n\n", who, tally.wrong);
    auto rows = tally.rows;
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t i = 0; i < std::min(rows.size(), SHOWN); ++i) text += row_text(*rows[i].second);
  }
  return text;
}

std::string ledger_json(const Ledger& ledger) {
  nlohmann::ordered_json json{{"experiment", ledger.experiment},
                              {"frames", ledger.frames},
                              {"disagreements", ledger.disagreements},
                              {"tolerance_relative", ledger.tolerance},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const LedgerRow& row : ledger.rows) {
    nlohmann::ordered_json opinions = nlohmann::ordered_json::array();
    for (const Opinion& opinion : row.opinions)
      opinions.push_back({{"who", opinion.who},
                          {"distance", json_number(opinion.distance)},
                          {"relative_error", json_number(opinion.relative_error)},
                          {"wrong", opinion.wrong}});
    const Vec3& p = row.pose.translation;
    const auto& q = row.pose.rotation.coeffs();
    json["rows"].push_back({{"frame", row.frame},
                            {"position", {p[0], p[1], p[2]}},
                            {"orientation_xyzw", {q[0], q[1], q[2], q[3]}},
                            {"exact_distance", row.truth},
                            {"fixed_body", row.fixed_body},
                            {"triangle_moving", row.triangle_moving},
                            {"triangle_fixed", row.triangle_fixed},
                            {"moving_W", json_of(row.moving_W)},
                            {"fixed_W", json_of(row.fixed_W)},
                            {"fcl_on_pair", json_number(row.fcl_on_pair)},
                            {"fcl_unscaled_on_pair", json_number(row.fcl_unscaled_on_pair)},
                            {"opinions", opinions}});
  }
  return json.dump(1);
}

}  // namespace lmdbench::exact
