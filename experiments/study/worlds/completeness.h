// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/judge.h>
#include <study/worlds/scenes.h>

#include <functional>
#include <string>

namespace lmdbench::worlds {

/// `certified` against `exhaustive`, which tests every instance, in each frame of a world's path.
/// @param complain receives each error as text, with the pose
completeness::Judgement judge_world(const World& world, double cutoff,
                                    const std::function<void(const std::string&)>& complain);

/// `certified` in a group of movers against `exhaustive` on all pairs of near spheres, every frame.
completeness::Judgement judge_play(const Play& play, double cutoff,
                                   const std::function<void(const std::string&)>& complain);

}  // namespace lmdbench::worlds
