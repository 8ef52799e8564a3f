// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/drivers/records.h>
#include <lmdbench/phantom/virtual_phantom.h>
#include <lmdbench/prepare/mover_play.h>

#include <vector>

namespace lmdbench {

/// Forces of all movers, one a mover by its number.
/// @param contacts that have split a set of the scene
/// @param method   as of ContactFinder::combine
std::vector<MoverFrame> render_movers(const ContactFinder& contacts, const Scene& scene, const Pose& X_WM,
                                      const MoverPlay& play, const ForceProfile& profile,
                                      const VirtualPhantom& device, const Method* method = nullptr);

}  // namespace lmdbench
