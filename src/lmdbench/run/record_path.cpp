// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/run/record_path.h>

#include <cstddef>

namespace lmdbench {

Path record_path(const Experiment& experiment, std::size_t every, const RunProgress& progress) {
  if (!experiment.loop.closed)
    throw UsageError(experiment.file.string(), "/loop/kind", "the loop is open: its path is the given one",
                     "set it to closed");
  if (experiment.realtime)
    throw UsageError(experiment.file.string(), "/driver/kind",
                     "a path is recorded frame by frame, not on the machine's clock", "set it to lockstep");
  Experiment alone = experiment;
  alone.methods.resize(1);
  alone.driver.repetitions = 1;
  const PreparedRun prepared = prepare(alone, {}, Deforming::FOLLOWED);
  Progress counted;
  if (progress)
    counted = [&](std::int64_t done, std::int64_t total) { return progress("record", done, total); };
  const MethodRecord record =
      run_lockstep(driven_methods(alone, prepared), prepared.input, alone.driver, counted).front();
  Path path;
  path.reserve(record.loop.size() / every + 1);
  for (std::size_t frame = 0; frame < record.loop.size(); frame += every)
    path.push_back({prepared.times[frame], {record.loop[frame].position, record.loop[frame].orientation}});
  return path;
}

}  // namespace lmdbench
