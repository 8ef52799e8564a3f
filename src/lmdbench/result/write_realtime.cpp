// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/lateness.h>
#include <lmdbench/result/write_result.h>
#include <lmdbench/result_file/write_column.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <utility>

namespace lmdbench {
namespace {

constexpr double S_PER_NS = 1e-9;
constexpr double US_PER_S = 1e6;

std::vector<double> seconds_since(const std::vector<std::int64_t>& instants, std::int64_t start) {
  std::vector<double> seconds;
  seconds.reserve(instants.size());
  for (const std::int64_t instant : instants)
    seconds.push_back(S_PER_NS * static_cast<double>(instant - start));
  return seconds;
}

std::vector<double> seconds_of(const std::vector<std::int64_t>& durations) {
  return seconds_since(durations, 0);
}

/// `later` minus the instant, for every instant of the grid [s]: those that a late tick skipped
/// have waited for it, too, each a period less than the one before. Else a stall of a hundred
/// periods would be one late sample among many.
std::vector<double> after_instants(const TickTimes& times, const std::vector<std::int64_t>& later,
                                   std::int64_t period) {
  std::vector<double> seconds;
  seconds.reserve(later.size() + static_cast<std::size_t>(times.skipped));
  for (std::size_t i = 0; i < later.size(); ++i)
    for (std::int64_t instant = times.asked[i]; instant == times.asked[i] || instant <= times.woken[i];
         instant += period)
      seconds.push_back(S_PER_NS * static_cast<double>(later[i] - instant));
  return seconds;
}

/// Lateness of a run and of its floor.
struct RunLateness {
  std::vector<double> servo, response, floor, floor_response;

  explicit RunLateness(const RealtimeRecord& clock)
      : servo(after_instants(clock.servo().times, clock.servo().times.woken, clock.period)),
        response(after_instants(clock.servo().times, clock.servo().times.done, clock.period)) {
    for (const TickTimes* times : {&clock.floor_before, &clock.floor_after}) {
      const std::vector<double> woken = after_instants(*times, times->woken, clock.period),
                                done = after_instants(*times, times->done, clock.period);
      floor.insert(floor.end(), woken.begin(), woken.end());
      floor_response.insert(floor_response.end(), done.begin(), done.end());
    }
  }
};

void write_tick_times(ResultWriter& writer, const std::string& group, const TickTimes& times,
                      std::int64_t start) {
  write_values(writer, {group + "/asked", "s", "instant that the loop slept until, since the servo's start"},
               seconds_since(times.asked, start));
  write_values(writer, {group + "/woken", "s", "when it went on"}, seconds_since(times.woken, start));
  write_values(writer, {group + "/done", "s", "when its result was handed on"},
               seconds_since(times.done, start));
  writer.attribute(group, "skipped", times.skipped);
}

void write_role(ResultWriter& writer, const std::string& group, const RoleRecord& role, std::int64_t start) {
  write_tick_times(writer, group, role.times, start);
  if (role.age.size() == role.times.done.size())  // also where it had no turn at all
    write_values(writer,
                 {group + "/age", "s",
                  role.name == "servo" ? "time since the pose that the set in use was brought to"
                                       : "time since the pose that it worked on, when it was done"},
                 seconds_of(role.age));
  writer.attribute(group, "core", std::int64_t{role.core.value_or(-1)});
  writer.attribute(group, "turns", role.turns);
  writer.attribute(group, "turns_lost", role.lost);
  writer.attribute(group, "ran_s", S_PER_NS * static_cast<double>(role.ran_ns));
  writer.attribute(group, "rate_hz", role.rate_hz());
  writer.attribute(group, "processor_s", S_PER_NS * static_cast<double>(role.use.processor_ns));
  writer.attribute(group, "load", role.load());
  writer.attribute(group, "minor_faults", role.use.minor_faults);
  writer.attribute(group, "major_faults", role.use.major_faults);
  writer.attribute(group, "involuntary_switches", role.use.involuntary_switches);
}

template <typename Row>
void write_quantiles(ResultWriter& writer, const std::string& group, const std::string& of,
                     const std::vector<Row>& rows) {
  writer.attribute(group, "interval", std::string("95 %, block bootstrap"));
  write_column(writer, {group + "/value", "s", "quantile of " + of}, rows,
               [](const Row& row) { return row.value; });
  write_column(writer, {group + "/low", "s", "lower end of its interval"}, rows,
               [](const Row& row) { return row.low; });
  write_column(writer, {group + "/high", "s", "upper end of its interval"}, rows,
               [](const Row& row) { return row.high; });
}

void write_series(ResultWriter& writer, const std::string& group, const std::string& of,
                  const std::vector<double>& seconds, const Lateness& lateness) {
  const std::vector<LatenessQuantile> quantiles = lateness.quantiles();
  write_quantiles(writer, group, of, quantiles);
  write_column(writer, {group + "/above", "1", "instants above it"}, quantiles,
               [](const LatenessQuantile& quantile) { return quantile.above; });
  write_values(writer, {group + "/histogram", "1", "instants by bin of edges; one more above the last edge"},
               lateness_histogram(seconds));
  writer.attribute(group, "maximum_s", lateness.maximum());
  writer.attribute(group, "instants", static_cast<std::int64_t>(lateness.size()));
}

void write_lateness(ResultWriter& writer, const std::string& group, const RealtimeRecord& clock) {
  const RunLateness late(clock);
  const Lateness servo(late.servo), response(late.response), floor(late.floor),
      floor_response(late.floor_response);
  write_values(writer, {group + "/share", "1", "shares of the quantiles"},
               std::vector<double>(LATENESS_SHARES.begin(), LATENESS_SHARES.end()));
  write_values(writer, {group + "/edges", "s", "upper edges of the histograms' bins"}, lateness_edges());
  write_series(writer, group + "/servo", "the servo loop's lateness, woken minus asked", late.servo, servo);
  write_series(writer, group + "/response", "the force's lateness, done minus asked", late.response,
               response);
  write_series(writer, group + "/floor", "the control loop's lateness, before and after", late.floor, floor);
  write_quantiles(writer, group + "/excess", "the servo loop's lateness minus the control loop's",
                  servo.excess_over(floor));
  write_quantiles(writer, group + "/response_excess", "the force's lateness minus the control loop's",
                  response.excess_over(floor_response));
}

void write_grants(ResultWriter& writer, const std::string& group, const std::vector<Grant>& grants) {
  const auto column = [&](const std::string& name, const std::string& long_name, auto Grant::*member) {
    write_column(writer, {group + "/" + name, "1", long_name}, grants,
                 [member](const Grant& grant) { return grant.*member; });
  };
  column("thread", "who asked", &Grant::thread);
  column("asked", "what for", &Grant::asked);
  column("reason", "why it was refused; empty where granted", &Grant::reason);
  column("granted", "1 where the system granted it", &Grant::granted);
}

}  // namespace

void write_realtime(ResultWriter& writer, const std::vector<RealtimeRecord>& clocks) {
  for (const RealtimeRecord& clock : clocks) {
    const std::string group = "/realtime/" + clock.label;
    writer.attribute(group, "period_s", S_PER_NS * static_cast<double>(clock.period));
    writer.attribute(group, "frames_skipped", clock.frames_from(FrameSource::SKIPPED));
    writer.attribute(group, "frames_lost", clock.frames_from(FrameSource::LOST));
    writer.attribute(group, "lmd_lists_lost", clock.lmd_lists_lost);
    writer.attribute(group, "stolen_s", clock.stolen_s);
    write_grants(writer, group + "/grants", clock.grants);
    for (const RoleRecord& role : clock.roles) write_role(writer, group + "/" + role.name, role, clock.start);
    write_values(writer, {group + "/servo/frame", "1", "frame of the result that the tick is for"},
                 clock.tick_frame);
    write_values(
        writer, {group + "/servo/search_age", "s", "time since the pose that the set in use was searched at"},
        seconds_of(clock.search_age));
    write_tick_times(writer, group + "/floor_before", clock.floor_before, clock.start);
    write_tick_times(writer, group + "/floor_after", clock.floor_after, clock.start);
    write_lateness(writer, group + "/lateness", clock);
    std::vector<std::uint8_t> sources;
    for (const FrameSource source : clock.frame_source) sources.push_back(static_cast<std::uint8_t>(source));
    write_values(writer,
                 {group + "/frame_source", "1",
                  "0 a tick, 1 skipped, shown as held, 2 lost to the record, shown as held"},
                 sources);
  }
}

nlohmann::ordered_json realtime_json(const std::vector<RealtimeRecord>& clocks) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const RealtimeRecord& clock : clocks) {
    const RunLateness late(clock);
    const Lateness servo(late.servo), response(late.response), floor(late.floor),
        floor_response(late.floor_response);
    const auto table = [](const auto& rows) {
      Json json = Json::array();
      for (const auto& row : rows)
        json.push_back(
            {{"share", row.share}, {"value_s", row.value}, {"low_s", row.low}, {"high_s", row.high}});
      return json;
    };
    Json grants = Json::array(), roles = Json::array();
    for (const Grant& grant : clock.grants)
      grants.push_back({{"thread", grant.thread},
                        {"asked", grant.asked},
                        {"granted", grant.granted},
                        {"reason", grant.reason}});
    for (const RoleRecord& role : clock.roles)
      roles.push_back({{"name", role.name},
                       {"core", role.core ? Json(*role.core) : Json(nullptr)},
                       {"rate_hz", role.rate_hz()},
                       {"load", role.load()},
                       {"skipped", role.times.skipped},
                       {"minor_faults", role.use.minor_faults},
                       {"major_faults", role.use.major_faults},
                       {"involuntary_switches", role.use.involuntary_switches}});
    list.push_back({{"label", clock.label},
                    {"frames", clock.frame_source.size()},
                    {"frames_skipped", clock.frames_from(FrameSource::SKIPPED)},
                    {"frames_lost", clock.frames_from(FrameSource::LOST)},
                    {"floor_skipped", clock.floor_before.skipped + clock.floor_after.skipped},
                    {"stolen_s", clock.stolen_s},
                    {"grants", std::move(grants)},
                    {"lateness",
                     {{"servo", table(servo.quantiles())},
                      {"response", table(response.quantiles())},
                      {"floor", table(floor.quantiles())},
                      {"excess", table(servo.excess_over(floor))},
                      {"response_excess", table(response.excess_over(floor_response))}}},
                    {"roles", std::move(roles)}});
  }
  return list;
}

std::string realtime_text(const std::vector<RealtimeRecord>& clocks) {
  if (clocks.empty()) return {};
  std::string text = "on the clock: lateness of the servo loop, of its force, and of an empty loop [us]\n";
  text += fmt::format("  {:<18} {:<10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "method", "loop", "p50", "p95",
                      "p99", "p99.9", "p99.99", "largest");
  for (const RealtimeRecord& clock : clocks) {
    const RunLateness late(clock);
    const auto row = [&](const char* name, const std::vector<double>& seconds) {
      const Lateness lateness(seconds);
      text += fmt::format("  {:<18} {:<10}", clock.label, name);
      for (const LatenessQuantile& quantile : lateness.quantiles())
        text += fmt::format(" {:>9.1f}", US_PER_S * quantile.value);
      text += fmt::format(" {:>9.1f}\n", US_PER_S * lateness.maximum());
    };
    row("servo", late.servo);
    row("force", late.response);
    row("empty", late.floor);
    const LatenessExcess p99 = Lateness(late.response).excess_over(Lateness(late.floor_response))[2];
    text += fmt::format(
        "  {:<18} force over empty, p99: {:.1f} us ({:.1f} to {:.1f}); {} of {} frames without a tick, {} "
        "lost\n",
        clock.label, US_PER_S * p99.value, US_PER_S * p99.low, US_PER_S * p99.high,
        clock.frames_from(FrameSource::SKIPPED), clock.frame_source.size(),
        clock.frames_from(FrameSource::LOST));
    for (const RoleRecord& role : clock.roles)
      text +=
          fmt::format("  {:<18} {:<10} {:>9.1f} a second, {:>6.2f} % of a core{}\n", clock.label, role.name,
                      role.rate_hz(), 100.0 * role.load(), role.core ? fmt::format(" ({})", *role.core) : "");
  }
  return text;
}

}  // namespace lmdbench
