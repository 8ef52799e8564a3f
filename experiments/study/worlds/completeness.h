// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/judge.h>
#include <study/worlds/scenes.h>

#include <functional>
#include <string>

namespace lmdbench::worlds {

/// `certified` along the world's path against `exhaustive`, which looks at every instance, in every frame.
/// @param complain is called with what is wrong, in words with the pose
completeness::Judgement judge_world(const World& world, double cutoff,
                                    const std::function<void(const std::string&)>& complain);

/// `certified` in a group of movers against `exhaustive` on every pair whose spheres are near enough, in every frame.
completeness::Judgement judge_play(const Play& play, double cutoff,
                                   const std::function<void(const std::string&)>& complain);

}  // namespace lmdbench::worlds
