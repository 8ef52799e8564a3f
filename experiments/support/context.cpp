// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/result_file/provenance.h>

#include <nlohmann/json.hpp>
#include <support/context.h>

namespace lmdbench::experiments {

nlohmann::json run_context() {
  const BuildInfo& build = build_info();
  nlohmann::json context = {{"build",
                             {{"version", build.version},
                              {"git_commit", build.git_commit},
                              {"git_dirty", build.git_dirty},
                              {"compiler", build.compiler},
                              {"compiler_flags", build.compiler_flags},
                              {"build_type", build.build_type}}}};
  for (const auto& [name, value] : machine_info()) context["machine"][name] = value;
  return context;
}

}  // namespace lmdbench::experiments
