// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

namespace lmdbench {

/// What every method owes of the set that it reports, whether it is complete or not: sorted by `lmd_less`; features, triangles and bodies
/// that there are; the triangles hold the features; directions of unit length or not known, distances those of the points up to the
/// rounding of their coordinates.
bool is_well_formed(const LmdSet& lmds, const Scene& scene);

}  // namespace lmdbench
