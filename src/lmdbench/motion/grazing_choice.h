// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/motion/grazing.h>

#include <cstdint>
#include <functional>

/// Among paths that graze, one that shows what this program is about: several contacts at once.
namespace lmdbench {

/// Paths that are looked at, in the order of their seeds.
inline constexpr std::uint64_t RICH_SEEDS = 4;
/// Contacts that are enough.
inline constexpr double RICH_CONTACTS = 2.0;

/// The first path of `grazing_path`'s seeds that has RICH_CONTACTS; of RICH_SEEDS that have fewer the one with the most.
/// @param contacts  how many a path has, by the caller's measure; called once a path that grazes
/// @param progress  over all RICH_SEEDS, never going back; it ends early where fewer are enough
/// @throws InputError as `grazing_path`
GrazingPath rich_grazing_path(const PathScene& scene, double cutoff, double haptic_rate,
                              const std::function<double(const Path&)>& contacts,
                              const ProgressFunction& progress = {});

}  // namespace lmdbench
