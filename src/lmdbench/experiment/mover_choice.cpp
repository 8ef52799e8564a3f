// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>

namespace lmdbench {

void refuse_movers(const Experiment& experiment) {
  if (experiment.movers.empty()) return;
  throw UsageError(experiment.file.string(), experiment.movers.front().place,
                   "a mesh moves beside the moving one, and this looks at one that moves",
                   "leave movers out; run, plan, compare, report and export know them");
}

void check_movers(const Experiment& experiment) {
  if (experiment.movers.empty()) return;
  const std::string file = experiment.file.string();
  if (experiment.loop.closed)
    throw UsageError(file, "/loop/kind",
                     "a closed loop moves one mesh, and /movers are on paths of their own",
                     "take an open loop (--set /loop/kind=open), or leave movers out");
  if (experiment.realtime)
    throw UsageError(file, "/driver/kind", "the driver realtime moves one mesh",
                     "take the driver lockstep (--set /driver/kind=lockstep), or leave movers out");
  if (experiment.driver.predict)
    throw UsageError(file, "/driver/prediction", "a search is predicted for one mesh that moves",
                     "set it to none, or leave movers out");
  if (experiment.deforms())
    throw UsageError(file, experiment.movers.front().place,
                     "movers do not go together with meshes that deform",
                     "leave the deformations out, or movers");
  refuse_critical_pairs(experiment, file, "forces of several movers are sums",
                        "take sum, or leave movers out");
}

}  // namespace lmdbench
