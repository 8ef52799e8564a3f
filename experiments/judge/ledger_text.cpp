// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <judge/ledger.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace lmdbench::exact {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "INFINITY";
}

std::string paste(const Vec3& p) {
  return fmt::format("Vec3({}, {}, {})", number(p[0]), number(p[1]), number(p[2]));
}

std::string paste(const Triangle& t) {
  return fmt::format("{{{},\n                        {},\n                        {}}}", paste(t[0]),
                     paste(t[1]), paste(t[2]));
}

/// The kinds of error, as table and examples call them.
std::string kind_of(const Opinion& opinion, double truth) {
  if (std::isinf(opinion.distance)) return "finds no pair";
  if (truth == 0.0) return "sees no contact where there is";
  if (opinion.distance == 0.0) return "sees contact where there is none";
  return opinion.distance > truth ? "too far" : "too near";
}

std::string verdict(const Opinion& opinion, double truth) {
  if (!opinion.wrong) return "right";
  const std::string kind = kind_of(opinion, truth);
  const bool measurable = opinion.distance > 0.0 && truth > 0.0 && std::isfinite(opinion.distance);
  return measurable ? fmt::format("{} by {:.3g} of the distance", kind, opinion.relative_error) : kind;
}

/// "bunny-hard" as part of a test's name.
std::string camel_case(const std::string& name) {
  std::string result;
  bool upper = true;
  for (const char c : name) {
    const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (letter) result += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = !letter;
  }
  return result;
}

std::string pair_text(const JudgedPair& pair, double scale) {
  return fmt::format(
      "  {{\n    // {}: triangle {} of the moving mesh and {} of fixed mesh {}\n"
      "    const Triangle moving_M{};\n    const Triangle fixed_W{};\n"
      "    EXPECT_EQ(exact_distance(RigidTransform(X_WM).triangle(moving_M), fixed_W), {});\n"
      "    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, {}).distance, {});\n"
      "    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 1.0).distance, {});\n  }}\n",
      pair.why == "nearest" ? "the nearest pair" : "the pair that " + pair.why + " names",
      pair.triangle_moving, pair.triangle_fixed, pair.fixed_body, paste(pair.moving_M), paste(pair.fixed_W),
      number(pair.exact), number(scale), number(pair.fcl), number(pair.fcl_unscaled));
}

std::string row_text(const Ledger& ledger, const LedgerRow& row) {
  std::string text =
      fmt::format("{}, frame {}: exact distance {} m.\n\n", ledger.experiment, row.frame, number(row.truth));
  for (const Opinion& opinion : row.opinions)
    text +=
        fmt::format("- {}: {} m, {}\n", opinion.who, number(opinion.distance), verdict(opinion, row.truth));
  const Vec3& p = row.pose.translation;
  const Eigen::Quaterniond& q = row.pose.rotation;
  text += fmt::format(
      "\n```cpp\nTEST(LedgerRows, {}Frame{}) {{\n  const Pose X_WM{{{},\n                  "
      "Eigen::Quaterniond({}, {}, {}, {})}};  // w, x, y, z\n",
      camel_case(ledger.experiment), row.frame, paste(p), number(q.w()), number(q.x()), number(q.y()),
      number(q.z()));
  for (const JudgedPair& pair : row.pairs) text += pair_text(pair, ledger.scale);
  return text + "}\n```\n\n";
}

struct Tally {
  int wrong = 0;
  double worst = 0.0;               ///< relative error of distances except 0 and infinity
  std::map<std::string, int> rest;  ///< kinds without such an error
};

/// A table's cell: number and kinds of errors.
std::string cell(const Tally& tally) {
  if (tally.wrong == 0) return "0";
  std::string text = fmt::format("{}", tally.wrong);
  std::string separator = " (";
  const auto add = [&](const std::string& part) {
    text += separator + part;
    separator = "; ";
  };
  if (tally.worst > 0.0) add(fmt::format("by {:.2g}", tally.worst));
  for (const auto& [kind, count] : tally.rest) add(fmt::format("{} {}", count, kind));
  return text + ")";
}

/// The worst row of one party and kind of error.
struct Example {
  const Ledger* ledger = nullptr;
  const LedgerRow* row = nullptr;
  double relative_error = -1.0;
};

nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const Triangle& t) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Vec3& p : t) json.push_back({p[0], p[1], p[2]});
  return json;
}

}  // namespace

std::string ledger_markdown(const std::vector<Ledger>& ledgers) {
  // All parties of all runs, in the order of their first appearance.
  std::vector<std::string> parties;
  std::map<std::pair<std::string, std::string>, Example> examples;
  std::vector<std::map<std::string, Tally>> tallies(ledgers.size());
  for (std::size_t i = 0; i < ledgers.size(); ++i) {
    for (const LedgerRow& row : ledgers[i].rows) {
      for (const Opinion& opinion : row.opinions) {
        if (std::find(parties.begin(), parties.end(), opinion.who) == parties.end())
          parties.push_back(opinion.who);
        if (!opinion.wrong) continue;
        const std::string kind = kind_of(opinion, row.truth);
        Tally& tally = tallies[i][opinion.who];
        ++tally.wrong;
        if (kind == "too far" || kind == "too near") {
          tally.worst = std::max(tally.worst, opinion.relative_error);
        } else {
          ++tally.rest[kind];
        }
        Example& example = examples[{opinion.who, kind}];
        if (opinion.relative_error > example.relative_error)
          example = {&ledgers[i], &row, opinion.relative_error};
      }
    }
  }
  std::string text =
      "# Disagreement ledger\n\nWhere the minimum distances of FCL (as the cross-check scales it, and on "
      "unscaled "
      "meshes), of the exact-form\nnearest pair and of the methods' fresh searches differ by more than the "
      "relative tolerance, exact arithmetic says who is\nwrong. A cell: in how many of the frames that "
      "differ, by "
      "how much of the distance at the worst, and how else.\n\n| run | frames checked | frames that differ |";
  for (const std::string& who : parties)
    text += fmt::format(" {} |", who == "lmdbench" ? "nearest pair" : who);
  text += "\n|---|---|---|";
  for (std::size_t i = 0; i < parties.size(); ++i) text += "---|";
  for (std::size_t i = 0; i < ledgers.size(); ++i) {
    text +=
        fmt::format("\n| {} | {} | {} |", ledgers[i].experiment, ledgers[i].frames, ledgers[i].rows.size());
    for (const std::string& who : parties) text += fmt::format(" {} |", cell(tallies[i][who]));
  }
  text += "\n\n## The worst of each kind, to paste into a test\n\n";
  for (const auto& [key, example] : examples)
    text += fmt::format("### {}: {}\n\n{}", key.first, key.second, row_text(*example.ledger, *example.row));
  return text;
}

std::string ledger_json(const Ledger& ledger) {
  nlohmann::ordered_json json{{"experiment", ledger.experiment},
                              {"frames", ledger.frames},
                              {"disagreements", ledger.disagreements},
                              {"tolerance_relative", ledger.tolerance},
                              {"fcl_scale", ledger.scale},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const LedgerRow& row : ledger.rows) {
    nlohmann::ordered_json opinions = nlohmann::ordered_json::array();
    for (const Opinion& opinion : row.opinions)
      opinions.push_back({{"who", opinion.who},
                          {"distance", json_number(opinion.distance)},
                          {"relative_error", json_number(opinion.relative_error)},
                          {"wrong", opinion.wrong}});
    nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
    for (const JudgedPair& pair : row.pairs)
      pairs.push_back({{"why", pair.why},
                       {"fixed_body", pair.fixed_body},
                       {"triangle_moving", pair.triangle_moving},
                       {"triangle_fixed", pair.triangle_fixed},
                       {"moving_M", json_of(pair.moving_M)},
                       {"fixed_W", json_of(pair.fixed_W)},
                       {"exact_distance", pair.exact},
                       {"fcl_distance", json_number(pair.fcl)},
                       {"fcl_unscaled_distance", json_number(pair.fcl_unscaled)}});
    const Vec3& p = row.pose.translation;
    const auto& q = row.pose.rotation.coeffs();
    json["rows"].push_back({{"frame", row.frame},
                            {"position", {p[0], p[1], p[2]}},
                            {"orientation_xyzw", {q[0], q[1], q[2], q[3]}},
                            {"exact_distance", row.truth},
                            {"pairs", pairs},
                            {"opinions", opinions}});
  }
  return json.dump(1);
}

}  // namespace lmdbench::exact
