// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/experiment/probe.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result_file/write_column.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// A probe's input: poses under one force profile, and the methods' records there.
struct ProbedTrack {
  const ProbeChoice& choice;
  const PreparedProfile& profile;
  const DriverInput& input;                  ///< `poses` as the methods saw them.
  const std::vector<bool>& in_contact;       ///< One a frame (contact.h).
  const Aggregation* aggregation;            ///< Of the profile.
  std::vector<DrivenMethod> methods;         ///< The methods of the track, ...
  std::vector<const MethodChoice*> choices;  ///< ... their entries in the experiment, ...
  std::vector<const MethodRecord*> records;  ///< ... and their records.
  const std::vector<RuleDecision>& rules;
  std::vector<std::int64_t> frames;  ///< Frames to probe.
  Progress progress;                 ///< Called after each of them (`tell_progress`).
};

/// Datasets of a table of findings, one for each column, in the order of the calls.
/// @tparam Findings the probe's own type
template <typename Findings, typename Row>
class ProbeTable {
 public:
  using Rows = const std::vector<Row>& (*)(const Findings& findings, std::size_t method);

  /// @param group as in ProbeDataset::path
  /// @param axis  name of the row count in results/README.md
  /// @param rows  of a track, or of one of its methods
  /// @param there whether findings have the table; null: always
  ProbeTable(std::string group, std::string axis, Rows rows, bool (*there)(const Findings&) = nullptr)
      : group_(std::move(group)), axis_(std::move(axis)), rows_(rows), there_(there) {}

  /// @param value gives a number, flag, text, Vec3 or quaternion from a row, or from row and method
  template <typename Value>
  ProbeTable& column(const std::string& name, std::string units, std::string long_name, Value value) {
    const auto of_row = [value](const Row& row, [[maybe_unused]] std::size_t method) {
      if constexpr (std::is_invocable_v<Value, const Row&, std::size_t>)
        return value(row, method);
      else
        return value(row);
    };
    using Type = std::decay_t<std::invoke_result_t<decltype(of_row), const Row&, std::size_t>>;
    const char* more = std::is_same_v<Type, Vec3>                 ? ", 3"
                       : std::is_same_v<Type, Eigen::Quaterniond> ? ", 4"
                                                                  : "";
    datasets_.push_back(
        {group_ + "/" + name, axis_ + more, std::move(units), std::move(long_name),
         [rows = rows_, there = there_, of_row](ResultWriter& writer, const DatasetInfo& info,
                                                const ProbeFindings& findings, std::size_t method) {
           const auto& own = static_cast<const Findings&>(findings);
           if (there == nullptr || there(own))
             write_column(writer, info, rows(own, method),
                          [&](const Row& row) { return of_row(row, method); });
         }});
    return *this;
  }

  /// Adds them to a probe's datasets.
  void into(std::vector<ProbeDataset>& datasets) const {
    datasets.insert(datasets.end(), datasets_.begin(), datasets_.end());
  }

 private:
  std::string group_, axis_;
  Rows rows_;
  bool (*there_)(const Findings&);
  std::vector<ProbeDataset> datasets_;
};

}  // namespace lmdbench
