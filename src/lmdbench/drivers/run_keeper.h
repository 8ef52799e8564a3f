// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/columns.h>
#include <lmdbench/drivers/records.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result_file/partial_result.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lmdbench {

/// What a new run does with what an interrupted one left.
enum class Leftover : std::uint8_t {
  REFUSE,  ///< An error, so that nothing measured is lost.
  RESUME   ///< Goes on with it.
};

/// Keeps frames in a run's part file as each is measured, and resumes an interrupted run.
///
/// Times alone cannot be computed again: all else is the same bits. A resumed run replays the
/// repetition in which the earlier one ended, and the first, which holds the records. Known times
/// replace those of the replay; whole known repetitions are skipped. No method has to save its
/// state. The replayed forces are compared with the kept ones.
class RunKeeper {
 public:
  /// @param fingerprint  of all that decides results and times; another run's part is refused
  /// @param write_head   writes what is known before the first frame
  /// @throws InputError for the part of another run, EnvironmentError for a full disk
  RunKeeper(PartFile& part, const Experiment& experiment, std::int64_t frames, const std::string& fingerprint,
            const std::function<void(ResultWriter&)>& write_head);

  /// Makes a part without measurements one that opens, before meshes are loaded.
  static void prepare(PartFile& part);

  /// Frames that the part's run measured, over all methods and repetitions; 0 if it is of none.
  static std::int64_t measured_frames(PartFile& part);

  /// Those that an earlier process measured.
  std::int64_t resumed_frames() const { return resumed_frames_; }

  /// The record's last frame has just been measured: keeps it, or takes the known times instead.
  /// @param search_changed  whether the last search has new numbers
  /// @throws InputError where the part holds another force
  void keep(std::int64_t repetition, std::size_t method, MethodRecord& record, bool search_changed);

  /// Whether an earlier process measured the whole repetition.
  bool knows_repetition(std::int64_t repetition) const;
  /// Its times.
  RepetitionTimes times(std::int64_t repetition, std::size_t method, std::size_t searches) const;

 private:
  /// The reserved datasets of columns, in their order.
  template <typename Row>
  struct Table {
    std::vector<Column<Row>> columns;
    std::vector<ReservedDataset> datasets;

    void set(std::size_t row, const Row& values);
  };
  struct KeptMethod {
    Table<FrameRecord> frames;
    Table<SearchRecord> searches;
    Table<LoopFrame> loop;
    Table<Pose> poses;
    std::vector<SearchTime> search_times;
    std::vector<ReservedDataset> search_time_values;  ///< Rows: repetition by repetition.
    ReservedDataset local_update_time;                ///< Likewise.
    ReservedDataset following_time;                   ///< Likewise; where meshes deform.
    std::vector<std::int64_t> known_frames;           ///< By repetition, from the start.
  };
  template <typename Visit>
  void for_each_dataset(Visit&& visit);
  void keep_searches(std::int64_t repetition, KeptMethod& kept, const MethodRecord& record);
  void adopt_searches(std::int64_t repetition, const KeptMethod& kept, RepetitionTimes& times) const;
  void check_force(std::size_t frame, const KeptMethod& kept, const MethodRecord& record) const;

  std::string part_name_;
  std::int64_t repetitions_;
  std::size_t frames_;
  std::size_t searches_;  ///< Room for so many.
  bool deforms_;
  std::vector<std::string> labels_;
  std::vector<KeptMethod> methods_;
  std::optional<PartialResult> file_;
  ReservedDataset frames_measured_;
  std::int64_t measured_ = 0;
  std::int64_t resumed_frames_ = 0;
};

}  // namespace lmdbench
