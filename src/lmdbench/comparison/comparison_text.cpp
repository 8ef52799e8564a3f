// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/comparison_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace lmdbench {
namespace {

nlohmann::ordered_json facts_json(const std::vector<std::pair<std::string, std::string>>& facts) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : facts) json[name] = value;
  return json;
}

template <typename Value>
nlohmann::ordered_json or_null(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string number_of(const std::vector<std::pair<std::string, std::string>>& facts, std::string_view name) {
  const auto found =
      std::find_if(facts.begin(), facts.end(), [&](const auto& fact) { return fact.first == name; });
  return found == facts.end() ? "" : found->second;
}

/// 0 where the text is no number.
double as_number(const std::string& text) {
  try {
    return std::stod(text);
  } catch (const std::exception&) {
    return 0.0;
  }
}

}  // namespace

std::string comparison_json(const Comparison& comparison) {
  nlohmann::ordered_json json{{"verdict", verdict_name(comparison.verdict)},
                              {"differences", nlohmann::ordered_json::array()},
                              {"timings", nlohmann::ordered_json::array()}};
  for (const Difference& d : comparison.differences)
    json["differences"].push_back(
        {{"method", d.method.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(d.method)},
         {"dataset", d.dataset},
         {"frame", or_null(d.frame)},
         {"base", d.base},
         {"candidate", d.candidate}});
  for (const Timing& t : comparison.timings)
    json["timings"].push_back({{"method", t.method},
                               {"stage", t.stage},
                               {"ratio", t.estimate.ratio},
                               {"low", finite_or_null(t.estimate.has_interval() ? t.estimate.low : NAN)},
                               {"high", finite_or_null(t.estimate.high)},
                               {"verdict", verdict_name(t.verdict)},
                               {"detectable", finite_or_null(t.estimate.detectable)},
                               {"processes_needed", or_null(t.processes_needed)}});
  const MachineComparison& machine = comparison.machine;
  json["machine"] = {{"comparable", machine.comparable},
                     {"reasons", machine.reasons},
                     {"build_notes", machine.build_notes},
                     {"base", facts_json(machine.base)},
                     {"candidate", facts_json(machine.candidate)}};
  json["notes"] = comparison.notes;
  // Texts of a foreign file may not be UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string google_benchmark_json(const std::vector<StageTimes>& processes,
                                  const std::vector<std::pair<std::string, std::string>>& machine) {
  constexpr double NANOSECONDS = 1e9;
  nlohmann::ordered_json json;
  json["context"] = {{"executable", "lmdbench"},
                     {"num_cpus", static_cast<int>(as_number(number_of(machine, "logical_processors")))},
                     {"mhz_per_cpu", 0},
                     {"cpu_scaling_enabled", number_of(machine, "frequency_governor") != "performance"},
                     {"caches", nlohmann::ordered_json::array()},
                     {"load_avg", {as_number(number_of(machine, "load_average_1_minute"))}},
                     {"library_build_type", "release"}};
  json["benchmarks"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < processes.size(); ++i) {
    for (const auto& [method, times] : processes[i]) {
      for (const TimedStage& stage : stages()) {
        const auto found = times.find(std::string(stage.name));
        if (found == times.end()) continue;
        std::string name = method + "/" + found->first;
        std::replace(name.begin(), name.end(), ' ', '_');
        json["benchmarks"].push_back({{"name", name},
                                      {"run_name", name},
                                      {"run_type", "iteration"},
                                      {"repetitions", processes.size()},
                                      {"repetition_index", i},
                                      {"threads", 1},
                                      {"iterations", 1},
                                      {"real_time", found->second * NANOSECONDS},
                                      {"cpu_time", found->second * NANOSECONDS},
                                      {"time_unit", "ns"}});
      }
    }
  }
  return json.dump(2);
}

std::string comparison_junit(const Comparison& comparison) {
  std::string cases;
  std::size_t failures = 0, skipped = 0;
  const auto add = [&](const std::string& group, const std::string& name, Verdict verdict,
                       const std::string& message) {
    cases += fmt::format("  <testcase classname=\"lmdbench.compare.{}\" name=\"{}\">", xml_escaped(group),
                         xml_escaped(name));
    if (verdict == Verdict::SLOWER || verdict == Verdict::CHANGED) {
      ++failures;
      cases +=
          fmt::format("<failure type=\"{}\" message=\"{}\"/>", verdict_name(verdict), xml_escaped(message));
    } else if (verdict == Verdict::UNSURE) {
      ++skipped;
      cases += fmt::format("<skipped message=\"{}\"/>", xml_escaped(message));
    }
    cases += "</testcase>\n";
  };
  std::string changes;
  for (const Difference& difference : comparison.differences) changes += difference_text(difference) + "; ";
  add("results", "forces, LMD sets and counters",
      comparison.differences.empty() ? Verdict::SAME : Verdict::CHANGED, changes);
  for (const Timing& timing : comparison.timings)
    add(timing.method, timing.stage, timing.verdict, timing_text(timing));
  if (comparison.timings.empty())
    add("times", "times", Verdict::UNSURE,
        fmt::format("no time was compared: {}", fmt::join(comparison.notes, "; ")));
  return fmt::format("{} tests=\"{}\" failures=\"{}\" skipped=\"{}\" errors=\"0\">\n{}</testsuite>\n",
                     JUNIT_BEGINS, std::max<std::size_t>(comparison.timings.size(), 1) + 1, failures, skipped,
                     cases);
}

namespace {

constexpr std::size_t LONGEST = 100;

std::string full_text(const nlohmann::json& value) {
  const bool is_nan = value.is_number_float() && std::isnan(value.get<double>());
  // Texts of a foreign file may not be UTF-8.
  return is_nan ? "NaN" : value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Values of base and candidate in full precision. Of long rows the first element that differs, by
/// its place in the row; other long texts are cut.
std::pair<std::string, std::string> shown(const Difference& d) {
  std::pair<std::string, std::string> texts{full_text(d.base), full_text(d.candidate)};
  if (std::max(texts.first.size(), texts.second.size()) <= LONGEST) return texts;
  if (d.base.is_array() && d.candidate.is_array()) {
    for (std::size_t i = 0; i < std::min(d.base.size(), d.candidate.size()); ++i) {
      const std::string a = full_text(d.base[i]), b = full_text(d.candidate[i]);
      if (a != b && std::max(a.size(), b.size()) <= LONGEST)
        return {fmt::format("element {}: {}", i, a), fmt::format("element {}: {}", i, b)};
    }
  }
  for (std::string* text : {&texts.first, &texts.second}) {
    std::size_t end = LONGEST;  // of a whole UTF-8 character
    while (end < text->size() && (static_cast<unsigned char>((*text)[end]) & 0xC0U) == 0x80U) --end;
    if (text->size() > LONGEST) *text = text->substr(0, end) + "...";
  }
  return texts;
}

std::string headline(const Comparison& comparison) {
  switch (comparison.verdict) {
    case Verdict::SAME:
      return fmt::format("same: results {}, and no stage is slower or faster beyond the least effect",
                         comparison.agreement);
    case Verdict::FASTER:
      return fmt::format("faster: results {}, and no stage is slower", comparison.agreement);
    case Verdict::SLOWER:
      return fmt::format("slower: results {}", comparison.agreement);
    case Verdict::CHANGED:
      return "changed: results or counters differ";
    case Verdict::UNSURE:
      break;
  }
  return fmt::format("unsure: results {}, but {}", comparison.agreement,
                     comparison.timings.empty() ? "no time was compared" : "the times cannot be told apart");
}

/// [us], or as it is where the machines cannot be compared.
std::string time_text(const Comparison& comparison, double seconds) {
  return fmt::format("{:.4g}", comparison.machine.comparable ? seconds * 1e6 : seconds);
}

/// What else a reader must know, a line each.
std::string remarks(const Comparison& comparison, const std::string& mark, const std::string& note_mark) {
  std::string text;
  for (const std::string& reason : comparison.machine.reasons)
    text += fmt::format("{}machines differ: {}\n", mark, reason);
  for (const std::string& note : comparison.machine.build_notes)
    text += fmt::format("{}builds differ: {}\n", mark, note);
  for (const std::string& note : comparison.notes) text += note_mark + note + "\n";
  return text;
}

std::string detectable(const Timing& timing) {
  return timing.estimate.can_alarm() ? fmt::format("{:.2g} %", 100.0 * timing.estimate.detectable) : "-";
}

std::string interval(const Timing& timing) {
  if (!timing.estimate.has_interval()) return "unknown";
  return fmt::format("{:.3f} to {:.3f}", timing.estimate.low, timing.estimate.high);
}

}  // namespace

std::string difference_text(const Difference& d) {
  std::string text = d.method.empty() ? "" : d.method + ": ";
  text += d.dataset.empty() ? "the method" : d.dataset;
  text += " differs";
  if (d.frame) text += fmt::format(" in frame {}", *d.frame);
  if (d.rows > 1) text += fmt::format(" (and {} more {})", d.rows - 1, d.rows == 2 ? "row" : "rows");
  const auto [base, candidate] = shown(d);
  return text + fmt::format(": {} became {}", base, candidate);
}

std::string timing_text(const Timing& t) {
  std::string text = fmt::format("{}, {}: {:.3f} times the base's time (interval {}), {}", t.method, t.stage,
                                 t.estimate.ratio, interval(t), verdict_name(t.verdict));
  if (!t.work.empty()) text += "; " + t.work;
  if (t.processes_needed)
    text += fmt::format("; about {} processes a side would decide", *t.processes_needed);
  return text;
}

std::string comparison_text(const Comparison& comparison) {
  std::string text = headline(comparison) + "\n";
  for (const Difference& difference : comparison.differences)
    text += "  " + difference_text(difference) + "\n";
  if (!comparison.timings.empty()) {
    std::size_t width = 10;
    for (const Timing& t : comparison.timings) width = std::max(width, t.method.size());
    text += fmt::format(
        "times of the path, least of {} repetitions a frame, {} base and {} candidate processes\n",
        comparison.repetitions, comparison.base.size(), comparison.candidate.size());
    text += fmt::format("  {:<{}}  {:<15}  {:>10}  {:>10}  {:>6}  {:>14}  {:>10}  {}\n", "method", width,
                        "stage", comparison.machine.comparable ? "base [us]" : "base", "candidate", "ratio",
                        "interval", "detectable", "verdict");
    for (const Timing& t : comparison.timings) {
      text += fmt::format("  {:<{}}  {:<15}  {:>10}  {:>10}  {:>6.3f}  {:>14}  {:>10}  {}\n", t.method, width,
                          t.stage, time_text(comparison, t.base_seconds),
                          time_text(comparison, t.candidate_seconds), t.estimate.ratio, interval(t),
                          detectable(t), verdict_name(t.verdict));
      if (!t.work.empty()) text += fmt::format("  {:<{}}  {}\n", "", width, t.work);
    }
  }
  return text + remarks(comparison, "", "note: ");
}

std::string comparison_markdown(const Comparison& comparison) {
  std::string text = fmt::format("**{}**\n", headline(comparison));
  if (!comparison.differences.empty()) {
    text += "\n| method | dataset | frame | base | candidate |\n|---|---|---|---|---|\n";
    for (const Difference& d : comparison.differences) {
      const auto [base, candidate] = shown(d);
      text += fmt::format("| {} | `{}` | {} | {} | {} |\n", d.method, d.dataset,
                          d.frame ? std::to_string(*d.frame) : "", base, candidate);
    }
  }
  if (!comparison.timings.empty()) {
    text += fmt::format(
        "\n| method | stage | base{0} | candidate{0} | ratio | interval | detectable | verdict |\n",
        comparison.machine.comparable ? " [us]" : "");
    text += "|---|---|---|---|---|---|---|---|\n";
    for (const Timing& t : comparison.timings) {
      text += fmt::format("| {} | {} | {} | {} | {:.3f} | {} | {} | {}{} |\n", t.method, t.stage,
                          time_text(comparison, t.base_seconds), time_text(comparison, t.candidate_seconds),
                          t.estimate.ratio, interval(t), detectable(t), verdict_name(t.verdict),
                          t.work.empty() ? "" : "; " + t.work);
    }
  }
  const std::string tail = remarks(comparison, "- ", "- ");
  return text + (tail.empty() ? "" : "\n") + tail;
}

}  // namespace lmdbench
