// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

namespace lmdbench {

/// Whether a set, complete or not, is sorted by `lmd_less`; its features, triangles and bodies
/// exist; the triangles hold the features; directions are of unit length or NaN; distances are
/// those of the points up to rounding of coordinates.
bool is_well_formed(const LmdSet& lmds, const Scene& scene);

}  // namespace lmdbench
