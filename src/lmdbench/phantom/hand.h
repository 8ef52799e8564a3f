// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/device.h>

#include <span>
#include <string>
#include <string_view>

namespace lmdbench {

/// A hand or arm on the device: a mass on a spring and a damper whose other ends follow the path
/// that the person intends. Without a grip it is rigidly attached to the device; with one, a second
/// spring and damper are between them. The same in every direction.
struct Hand {
  std::string name;  ///< As written in experiments; "custom" for one with own figures.
  double mass_kg = 0.0;
  double damping_n_s_per_m = 0.0;       ///< Between its mass and the meant path.
  double stiffness_n_per_m = 0.0;       ///< Between its mass and the meant path.
  double grip_damping_n_s_per_m = 0.0;  ///< Between its mass and the device.
  double grip_stiffness_n_per_m = 0.0;  ///< Between its mass and the device; 0: rigidly attached.

  bool has_grip() const { return grip_stiffness_n_per_m > 0.0; }
};

/// A published set of figures.
struct KnownHand {
  Hand hand;
  std::string_view source;
  Trust trust = Trust::UNKNOWN;
};

/// All known hands, in a fixed order.
std::span<const KnownHand> known_hands();

/// Hand of that name.
/// @param file, pointer the place that the name was read from, for the message
/// @throws UsageError listing the known names
const Hand& hand_named(std::string_view name, std::string_view file = "", std::string_view pointer = "");

}  // namespace lmdbench
