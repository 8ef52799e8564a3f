// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/comparison_text.h>

#include <fmt/format.h>

#include <algorithm>

namespace lmdbench {
namespace {

/// Values in full precision; long rows are cut.
std::string shown(const nlohmann::json& value) {
  constexpr std::size_t LONGEST = 100;
  const std::string text = value.is_null() ? "NaN" : value.dump();
  return text.size() <= LONGEST ? text : text.substr(0, LONGEST) + "...";
}

std::string headline(const Comparison& comparison) {
  switch (comparison.verdict) {
    case Verdict::SAME:
      return "same: results are the same bits, and no stage is slower or faster beyond the least effect";
    case Verdict::FASTER:
      return "faster: results are the same bits, and no stage is slower";
    case Verdict::SLOWER:
      return "slower: results are the same bits";
    case Verdict::CHANGED:
      return "changed: results or counters differ";
    case Verdict::UNSURE:
      break;
  }
  return "unsure: results are the same bits, but the times cannot be told apart";
}

std::string microseconds(double seconds) {
  return fmt::format("{:.4g}", seconds * 1e6);
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
  return text + fmt::format(": {} became {}", shown(d.base), shown(d.candidate));
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
      const auto value = [&](double v) {
        return comparison.machine.comparable ? microseconds(v) : fmt::format("{:.4g}", v);
      };
      text += fmt::format("  {:<{}}  {:<15}  {:>10}  {:>10}  {:>6.3f}  {:>14}  {:>10}  {}\n", t.method, width,
                          t.stage, value(t.base_seconds), value(t.candidate_seconds), t.estimate.ratio,
                          interval(t), detectable(t), verdict_name(t.verdict));
      if (!t.work.empty()) text += fmt::format("  {:<{}}  {}\n", "", width, t.work);
    }
  }
  for (const std::string& reason : comparison.machine.reasons) text += "machines differ: " + reason + "\n";
  for (const std::string& note : comparison.machine.build_notes) text += "builds differ: " + note + "\n";
  for (const std::string& note : comparison.notes) text += "note: " + note + "\n";
  return text;
}

std::string comparison_markdown(const Comparison& comparison) {
  std::string text = fmt::format("**{}**\n", headline(comparison));
  if (!comparison.differences.empty()) {
    text += "\n| method | dataset | frame | base | candidate |\n|---|---|---|---|---|\n";
    for (const Difference& d : comparison.differences)
      text += fmt::format("| {} | `{}` | {} | {} | {} |\n", d.method, d.dataset,
                          d.frame ? std::to_string(*d.frame) : "", shown(d.base), shown(d.candidate));
  }
  if (!comparison.timings.empty()) {
    text += fmt::format(
        "\n| method | stage | base{0} | candidate{0} | ratio | interval | detectable | verdict |\n",
        comparison.machine.comparable ? " [us]" : "");
    text += "|---|---|---|---|---|---|---|---|\n";
    for (const Timing& t : comparison.timings) {
      const auto value = [&](double v) {
        return comparison.machine.comparable ? microseconds(v) : fmt::format("{:.4g}", v);
      };
      text += fmt::format("| {} | {} | {} | {} | {:.3f} | {} | {} | {}{} |\n", t.method, t.stage,
                          value(t.base_seconds), value(t.candidate_seconds), t.estimate.ratio, interval(t),
                          detectable(t), verdict_name(t.verdict), t.work.empty() ? "" : "; " + t.work);
    }
  }
  if (!comparison.machine.reasons.empty() || !comparison.machine.build_notes.empty() ||
      !comparison.notes.empty())
    text += "\n";
  for (const std::string& reason : comparison.machine.reasons) text += "- machines differ: " + reason + "\n";
  for (const std::string& note : comparison.machine.build_notes) text += "- builds differ: " + note + "\n";
  for (const std::string& note : comparison.notes) text += "- " + note + "\n";
  return text;
}

}  // namespace lmdbench
