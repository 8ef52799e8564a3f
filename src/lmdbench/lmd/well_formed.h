// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

namespace lmdbench {

/// Whether an LMD's features, triangles and body exist; the triangles hold the features; its
/// direction is of unit length or NaN; its distance is that of the points up to rounding of
/// coordinates.
bool is_well_formed(const Lmd& lmd, const Scene& scene);
/// Whether all LMDs of a set, complete or not, are well formed and sorted by `lmd_less`.
bool is_well_formed(const LmdSet& lmds, const Scene& scene);

}  // namespace lmdbench
