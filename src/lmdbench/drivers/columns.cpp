// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/columns.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/scene_search.h>

#include <fmt/format.h>

namespace lmdbench {
namespace {

/// Counters of the rows, one column a counter that the method counts there.
template <typename Row>
void add_counters(std::vector<Column<Row>>& columns, const std::string& group,
                  const std::vector<CounterDescription>& counters, const std::string& of) {
  for (const CounterDescription& counter : counters)
    columns.push_back(column<Row>(fmt::format("{}/{}", group, counter.name), "1",
                                  fmt::format("{}, of the {}", counter.summary, of),
                                  [index = counter.index](const Row& row) {
                                    return static_cast<std::int64_t>(row.counters.values[index]);
                                  }));
}

}  // namespace

MethodDescription described(const Experiment& experiment, const std::string& name) {
  const bool is_pair =
      experiment.objects.size() == 2 && !experiment.several_move() && !has_placed_meshes(experiment);
  return is_pair ? method_description(name) : over_scene(method_description(name));
}

std::vector<Column<FrameRecord>> frame_columns(const MethodDescription& method, bool torque, bool indices) {
  using F = FrameRecord;
  std::vector<Column<F>> columns{
      column<F>("force", "N", "rendered force on the moving mesh, world frame",
                [](const F& f) { return f.force; }),
      column<F>("force_clipped", "1",
                "1 where the device, or maximum_force_n under clip: maximum, clipped the force",
                [](const F& f) { return f.force_clipped; }),
      column<F>("force_above_continuous", "1", "1 where the force exceeds what the device can hold",
                [](const F& f) { return f.force_above_continuous; }),
      column<F>("lmd_count", "1", "LMDs within the cutoff", [](const F& f) { return f.lmd_count; })};
  if (torque)
    columns.push_back(column<F>("torque", "N m",
                                "torque about the moving mesh's centre, before the device clips it",
                                [](const F& f) { return f.torque; }));
  if (method.tracks_locally) {
    columns.push_back(column<F>("lmd_count_before_reduction", "1",
                                "LMD candidates of the search behind the set in use",
                                [](const F& f) { return f.lmd_count_before_reduction; }));
    columns.push_back(column<F>(
        "reduction_ratio", "1",
        "LMD candidates divided by LMDs that the first reduction kept, of that search", [](const F& f) {
          return f.kept_after_reduction > 0.0 ? f.lmd_count_before_reduction / f.kept_after_reduction : UNSET;
        }));
    columns.push_back(column<F>("lmd_age", "s", "time since the search behind the set in use began",
                                [](const F& f) { return f.lmd_age; }));
  }
  columns.push_back(column<F>("minimum_distance", "m", "smallest LMD distance",
                              [](const F& f) { return f.minimum_distance; }));
  columns.push_back(column<F>("effective_stiffness", "N/m",
                              "slope of the force's length along the force, LMDs' directions held",
                              [](const F& f) { return f.effective_stiffness; }));
  columns.push_back(column<F>("contact_without_direction", "1",
                              "LMDs of triangles that intersect, which keep their last direction",
                              [](const F& f) { return f.contact_without_direction; }));
  if (indices)
    columns.push_back(column<F>("lmds_without_index", "1",
                                "LMDs at a border or where a mesh is not manifold: the force may jump there",
                                [](const F& f) { return f.lmds_without_index; }));
  add_counters(columns, "counters", method.local_counters(), "frame's local part");
  return columns;
}

std::vector<Column<SearchRecord>> search_columns(const MethodDescription& method) {
  using S = SearchRecord;
  if (!method.tracks_locally) return {};
  std::vector<Column<S>> columns{column<S>("global_frame", "1", "frame that the global search started in",
                                           [](const S& s) { return s.frame; }),
                                 column<S>("candidates", "1", "LMD candidates that the search found",
                                           [](const S& s) { return s.candidates; })};
  add_counters(columns, "global_counters", method.global_counters(), "global search and its trackings");
  if (method.trackings_after_search > 0)
    columns.push_back(column<S>("kept_after_reduction", "1", "LMDs left by the first tracking",
                                [](const S& s) { return s.kept_after_reduction; }));
  return columns;
}

bool is_counter(const std::string& name) {
  return name.starts_with("counters/") || name.starts_with("global_counters/");
}

std::vector<Column<LoopFrame>> loop_columns(bool turns) {
  using L = LoopFrame;
  const auto energy = [](const std::string& name, const std::string& long_name,
                         double EnergyAccount::*member) {
    return column<L>("energy_" + name, "J", long_name, [member](const L& l) { return l.energy.*member; });
  };
  std::vector<Column<L>> columns{
      column<L>("position", "m",
                "true position of the moving mesh's origin, which the device holds, world frame",
                [](const L& l) { return l.position; }),
      column<L>("velocity", "m/s", "velocity of that origin, world frame",
                [](const L& l) { return l.velocity; }),
      column<L>("held_force", "N", "force held until the next frame, delay included",
                [](const L& l) { return l.held.force; }),
      energy("kinetic", "energy of the device's motion", &EnergyAccount::kinetic),
      energy("spring", "energy in the springs of hand and grip", &EnergyAccount::spring),
      energy("rendered", "work of the held force on the device since the start", &EnergyAccount::rendered),
      energy("push", "work of the push since the start", &EnergyAccount::push),
      energy("hand", "work of the person who moves the hand since the start", &EnergyAccount::hand),
      energy("damped", "energy lost in dampers since the start", &EnergyAccount::damped),
      energy("friction", "energy lost to Coulomb friction since the start", &EnergyAccount::friction),
      energy("moved", "sum of the lengths of all energies that flowed since the start",
             &EnergyAccount::moved)};
  if (turns) {
    columns.push_back(column<L>("angular_velocity", "rad/s", "angular velocity of the device, world frame",
                                [](const L& l) { return l.angular_velocity; }));
    columns.push_back(column<L>("held_torque", "N m", "torque held until the next frame, delay included",
                                [](const L& l) { return l.held.torque; }));
    columns.push_back(column<L>("torque_clipped", "1", "1 where the device clips the torque that it holds",
                                [](const L& l) { return l.held.torque_clipped; }));
  }
  return columns;
}

DatasetInfo following_time_info(const std::string& group) {
  return {group + "following_time", "s",
          "part of local_update_time in which the meshes that deform, and what the method prepared of them, "
          "followed"};
}

std::vector<SearchTime> search_times(const MethodDescription& method) {
  std::vector<SearchTime> times;
  if (!method.tracks_locally) return times;
  times.push_back(
      {"global_search_time", "time of the global search, by repetition", &RepetitionTimes::global_search});
  if (method.trackings_after_search > 0)
    times.push_back({"first_reduction_time", "time of the first tracking, by repetition",
                     &RepetitionTimes::first_reduction});
  if (method.trackings_after_search > 1)
    times.push_back({"second_tracking_time", "time of the second tracking, by repetition",
                     &RepetitionTimes::second_tracking});
  return times;
}

}  // namespace lmdbench
