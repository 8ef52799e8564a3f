// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/drivers/run_keeper.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace lmdbench {
namespace {

constexpr const char* FRAMES_MEASURED = "/frames_measured";
/// Stands in the part for the time of a frame that a plugin lost: NaN says that none was measured.
constexpr double LOST = -1.0;

double time_of_part(double kept) {
  return kept == LOST ? UNSET : kept;
}

const DatasetInfo& frames_measured_info() {
  static const DatasetInfo info{FRAMES_MEASURED, "1",
                                "haptic frames measured so far, over all methods and repetitions"};
  return info;
}

/// The count that stands in a part before its first frame.
void write_no_frames(ResultWriter& image) {
  image.write(frames_measured_info(), std::vector<std::int64_t>{0}, {1});
}

ReservedDataset frames_measured_of(const PartialResult& file) {
  return file.dataset(FRAMES_MEASURED, ElementKind::INTEGER, {1}, 1);
}

std::vector<Column<Pose>> pose_columns() {
  return {column<Pose>("path/position", "m", "origin of the moving mesh's frame, world frame",
                       [](const Pose& pose) { return pose.translation; })};
}

/// Kind and numbers in a row of what a column's function gives.
template <typename Value>
constexpr std::pair<ElementKind, std::size_t> form_of() {
  if constexpr (std::is_same_v<Value, Vec3>)
    return {ElementKind::REAL, 3};
  else
    return {std::is_same_v<Value, double> ? ElementKind::REAL : ElementKind::INTEGER, 1};
}

template <typename Row>
std::pair<ElementKind, std::size_t> form_of(const Column<Row>& column) {
  return std::visit(
      [](const auto& value) { return form_of<typename std::decay_t<decltype(value)>::result_type>(); },
      column.value);
}

void set_row(ReservedDataset& dataset, std::size_t row, const Vec3& value) {
  dataset.set(row, std::as_bytes(std::span(value.data(), 3)));
}
void set_row(ReservedDataset& dataset, std::size_t row, double value) {
  dataset.set_real(row, value);
}
void set_row(ReservedDataset& dataset, std::size_t row, std::int64_t value) {
  dataset.set(row, std::as_bytes(std::span(&value, 1)));
}

}  // namespace

template <typename Row>
void RunKeeper::Table<Row>::set(std::size_t row, const Row& values) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    std::visit(
        [&](const auto& value) {
          using Value = typename std::decay_t<decltype(value)>::result_type;
          if constexpr (std::is_same_v<Value, bool>)
            set_row(datasets[i], row, std::int64_t{value(values)});
          else
            set_row(datasets[i], row, value(values));
        },
        columns[i].value);
}

/// Every reserved dataset with what it is: visit(dataset, info, kind, shape, numbers in a row).
template <typename Visit>
void RunKeeper::for_each_dataset(Visit&& visit) {
  const auto repetitions = static_cast<std::size_t>(repetitions_);
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    KeptMethod& kept = methods_[i];
    const std::string group = "/methods/" + labels_[i] + "/";
    const auto table = [&](auto& columns, std::size_t rows, const std::string& prefix) {
      columns.datasets.resize(columns.columns.size());
      for (std::size_t c = 0; c < columns.columns.size(); ++c) {
        const auto& column = columns.columns[c];
        const auto [kind, width] = form_of(column);
        visit(columns.datasets[c], DatasetInfo{group + prefix + column.name, column.units, column.long_name},
              kind, width == 1 ? std::vector{rows} : std::vector{rows, width}, width);
      }
    };
    table(kept.frames, frames_, "");
    table(kept.searches, searches_, "");
    table(kept.poses, frames_, "");
    table(kept.loop, frames_, "loop/");
    kept.search_time_values.resize(kept.search_times.size());
    for (std::size_t t = 0; t < kept.search_times.size(); ++t)
      visit(kept.search_time_values[t],
            DatasetInfo{group + kept.search_times[t].name, "s", kept.search_times[t].long_name},
            ElementKind::REAL, std::vector{repetitions, searches_}, std::size_t{1});
    visit(kept.local_update_time,
          DatasetInfo{group + "local_update_time", "s",
                      "time of the frame's local part, by repetition; -1: a plugin gave no answer"},
          ElementKind::REAL, std::vector{repetitions, frames_}, std::size_t{1});
    if (deforms_)
      visit(kept.following_time, following_time_info(group), ElementKind::REAL,
            std::vector{repetitions, frames_}, std::size_t{1});
  }
}

RunKeeper::RunKeeper(PartFile& part, const Experiment& experiment, std::int64_t frames,
                     const std::string& fingerprint, const std::function<void(ResultWriter&)>& write_head)
    : part_name_(part.part_name().string()),
      repetitions_(experiment.driver.repetitions),
      frames_(static_cast<std::size_t>(frames)),
      searches_(static_cast<std::size_t>((frames + experiment.driver.search_every_frames - 1) /
                                         experiment.driver.search_every_frames)),
      deforms_(experiment.deforms()) {
  for (const MethodChoice& choice : experiment.methods) {
    const MethodDescription method = described(experiment, choice.name);
    KeptMethod kept;
    kept.frames.columns = frame_columns(method, experiment.record_torque, choice.counts_indices());
    kept.searches.columns = search_columns(method);
    kept.search_times = search_times(method);
    if (experiment.loop.closed) {
      kept.poses.columns = pose_columns();
      kept.loop.columns = loop_columns(experiment.loop.rotation.has_value());
    }
    labels_.push_back(choice.label);
    methods_.push_back(std::move(kept));
  }
  const std::int64_t measured = measured_frames(part);
  if (measured > 0) {
    file_ = PartialResult::open(part);
    if (file_->fingerprint() != fingerprint)
      throw InputError(
          part_name_, "",
          "is of another run: the experiment, its inputs, the program or the processor differ",
          "resume with the same experiment file, --set values, inputs and program, or remove the file");
  } else {
    ResultWriter image;
    write_head(image);
    image.attribute("/", "format", PART_FORMAT);
    image.attribute("/", "fingerprint", fingerprint);
    // Not reserved, which would leave it unset until the first process has opened what it wrote.
    write_no_frames(image);
    for_each_dataset([&](ReservedDataset&, const DatasetInfo& info, ElementKind kind,
                         const std::vector<std::size_t>& shape,
                         std::size_t) { image.reserve(info, kind, shape); });
    file_.emplace(part, image.image());
  }
  file_->hold_open(true);
  for_each_dataset([&](ReservedDataset& dataset, const DatasetInfo& info, ElementKind kind,
                       const std::vector<std::size_t>& shape,
                       std::size_t width) { dataset = file_->dataset(info.path, kind, shape, width); });
  frames_measured_ = frames_measured_of(*file_);
  file_->hold_open(false);
  for (KeptMethod& kept : methods_) {
    kept.known_frames.resize(static_cast<std::size_t>(repetitions_), 0);
    for (std::size_t r = 0; r < kept.known_frames.size(); ++r) {
      std::int64_t& known = kept.known_frames[r];
      while (known < frames &&
             !std::isnan(kept.local_update_time.real(r * frames_ + static_cast<std::size_t>(known))))
        ++known;
      resumed_frames_ += known;
    }
  }
  measured_ = resumed_frames_;
  set_row(frames_measured_, 0, measured_);
}

void RunKeeper::prepare(PartFile& part) {
  if (measured_frames(part) > 0) return;
  ResultWriter image;
  image.attribute("/", "format", PART_FORMAT);
  write_no_frames(image);
  part.write(image.image());
}

std::int64_t RunKeeper::measured_frames(PartFile& part) {
  const std::optional<PartialResult> file = PartialResult::open(part);
  if (!file) return 0;
  std::int64_t measured = 0;
  frames_measured_of(*file).get(0, std::as_writable_bytes(std::span(&measured, 1)));
  return measured;
}

void RunKeeper::keep(std::int64_t repetition, std::size_t method, MethodRecord& record, bool search_changed) {
  KeptMethod& kept = methods_[method];
  RepetitionTimes& times = record.repetitions.front();
  const std::size_t frame = record.frames.size() - 1;
  const std::size_t row = static_cast<std::size_t>(repetition) * frames_ + frame;
  const auto known = static_cast<std::size_t>(kept.known_frames[static_cast<std::size_t>(repetition)]);
  if (frame < known) {
    // A method from outside may lose a frame, or answer otherwise.
    if (repetition == 0 && times.way.empty()) check_force(frame, kept, record);
    times.local_update.back() = time_of_part(kept.local_update_time.real(row));
    if (deforms_) times.following.back() = kept.following_time.real(row);
    if (frame + 1 == known) adopt_searches(repetition, kept, times);
    return;
  }
  if (repetition == 0) {
    kept.frames.set(frame, record.frames.back());
    if (!record.loop.empty()) {
      kept.poses.set(frame, record.poses.back());
      kept.loop.set(frame, record.loop.back());
    }
  }
  if (search_changed) keep_searches(repetition, kept, record);
  if (deforms_) kept.following_time.set_real(row, times.following.back());
  // The frame counts from here on; the compiler must not store this any earlier.
  std::atomic_signal_fence(std::memory_order_seq_cst);
  const double time = times.local_update.back();
  kept.local_update_time.set_real(row, std::isnan(time) ? LOST : time);
  set_row(frames_measured_, 0, ++measured_);
}

void RunKeeper::keep_searches(std::int64_t repetition, KeptMethod& kept, const MethodRecord& record) {
  const std::size_t searches = record.searches.size();
  // A frame may track the set of the search before and then begin a new one.
  for (std::size_t search = searches - std::min<std::size_t>(searches, 2); search < searches; ++search) {
    if (repetition == 0) kept.searches.set(search, record.searches[search]);
    for (std::size_t t = 0; t < kept.search_times.size(); ++t)
      kept.search_time_values[t].set_real(static_cast<std::size_t>(repetition) * searches_ + search,
                                          (record.repetitions.front().*kept.search_times[t].times)[search]);
  }
}

/// Known times of searches so far, of stages that the replay has had as well: the frame in which
/// the earlier process ended is done again.
void RunKeeper::adopt_searches(std::int64_t repetition, const KeptMethod& kept,
                               RepetitionTimes& times) const {
  for (std::size_t t = 0; t < kept.search_times.size(); ++t) {
    std::vector<double>& values = times.*kept.search_times[t].times;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double known =
          kept.search_time_values[t].real(static_cast<std::size_t>(repetition) * searches_ + i);
      if (!std::isnan(values[i]) && !std::isnan(known)) values[i] = known;
    }
  }
}

void RunKeeper::check_force(std::size_t frame, const KeptMethod& kept, const MethodRecord& record) const {
  const Vec3& force = record.frames.back().force;
  const ReservedDataset& kept_force = kept.frames.datasets.front();
  std::array<double, 3> known{};
  kept_force.get(frame, std::as_writable_bytes(std::span(known)));
  // A crash of the machine may have taken the force and left the time: that is no contradiction.
  if (std::isnan(known[0]) || kept_force.holds(frame, std::as_bytes(std::span(force.data(), 3)))) return;
  throw InputError(part_name_, fmt::format("method {}, frame {}", record.label, frame),
                   "the interrupted run left another force than this one",
                   "remove the file and run again: its times are of other work");
}

bool RunKeeper::knows_repetition(std::int64_t repetition) const {
  for (const KeptMethod& kept : methods_)
    if (static_cast<std::size_t>(kept.known_frames[static_cast<std::size_t>(repetition)]) < frames_)
      return false;
  return true;
}

RepetitionTimes RunKeeper::times(std::int64_t repetition, std::size_t method, std::size_t searches) const {
  const KeptMethod& kept = methods_[method];
  const auto first = static_cast<std::size_t>(repetition);
  RepetitionTimes times;
  for (std::size_t frame = 0; frame < frames_; ++frame)
    times.local_update.push_back(time_of_part(kept.local_update_time.real(first * frames_ + frame)));
  for (std::size_t frame = 0; deforms_ && frame < frames_; ++frame)
    times.following.push_back(kept.following_time.real(first * frames_ + frame));
  for (std::vector<double>* of_searches :
       {&times.global_search, &times.first_reduction, &times.second_tracking})
    of_searches->assign(searches, UNSET);
  for (std::size_t t = 0; t < kept.search_times.size(); ++t)
    for (std::size_t i = 0; i < searches; ++i)
      (times.*kept.search_times[t].times)[i] = kept.search_time_values[t].real(first * searches_ + i);
  return times;
}

}  // namespace lmdbench
