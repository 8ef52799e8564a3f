// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmdbench.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  const lmdbench::PreparedMesh moving(argv[1]);
  const lmdbench::PreparedMesh fixed(argv[2]);
  lmdbench::LmdSearch search(moving, fixed, std::atof(argv[3]));
  lmdbench::Pose pose;
  pose.translation = {0.2, 0.3, 1.02};
  for (const lmdbench::Lmd& lmd : search.at(pose))
    std::printf("%.17g %s %d %s %d\n", lmd.distance, to_string(lmd.feature_moving.kind).data(),
                lmd.feature_moving.index, to_string(lmd.feature_fixed.kind).data(), lmd.feature_fixed.index);
  return 0;
} catch (const lmdbench::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.code());
}
