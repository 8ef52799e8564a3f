// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <cstdint>
#include <string_view>
#include <vector>

/// When a closed loop is "clean". After a small tap the device swings about its place of rest. The
/// run is clean if, from one stretch of WINDOW_CYCLES oscillations to the next, no measure grows:
///  - amplitude: root mean square of the device's distance from its mean place;
///  - energy: mean of half the mass times the squared velocity;
///  - force above 30 Hz: root mean square of the rendered force after a Butterworth high pass of
///    second order, felt as buzzing (not at servo rates below 60 Hz, which cannot render it).
/// The first SKIPPED_CYCLES belong to the tap. A Hann window weights the sums, so that a stretch
/// need not hold whole oscillations. An amplitude within the encoders' resolution is always clean.
namespace lmdbench {

inline constexpr int SKIPPED_CYCLES = 5;
inline constexpr int WINDOW_CYCLES = 20;
inline constexpr double HIGH_PASS_HZ = 30.0;

/// The signal after the high pass, sample by sample, as if its first value had always been there.
std::vector<Vec3> above_30_hz(const std::vector<Vec3>& signal, double period_s);

/// A swing, frame by frame from the tap on.
struct Swing {
  double period_s = 1e-3;
  double resolution_m = 0.0;
  std::vector<Vec3> position_W;  ///< Displacement from rest [m].
  std::vector<Vec3> velocity_W;  ///< [m/s]
  std::vector<Vec3> force_W;     ///< Rendered, minus the force at rest [N].
};

enum class CleanMeasure : std::uint8_t { AMPLITUDE, ENERGY, FORCE_ABOVE_30_HZ };
inline constexpr std::size_t CLEAN_MEASURE_COUNT = 3;

/// "amplitude", "energy", "force_above_30_hz".
std::string_view to_string(CleanMeasure measure);

/// The verdict about a swing.
struct Cleanliness {
  /// Largest growth of a measure from one window to the next, as the logarithm of the ratio of
  /// amplitudes (half that of energies). Below 0 all decay: clean.
  double growth = 0.0;
  CleanMeasure fastest = CleanMeasure::AMPLITUDE;  ///< The measure that grows so.
  double amplitude_m = 0.0;                        ///< Root mean square in the last window.
  double frequency_hz = 0.0;  ///< Oscillations a second over both windows; 0 where there is none.

  bool clean() const { return growth <= 0.0; }
};

/// Judges a swing by its last two equal stretches after the skipped part: of N frames the first N *
/// SKIPPED_CYCLES / (SKIPPED_CYCLES + 2 WINDOW_CYCLES) are skipped.
/// @pre at least 9 frames
Cleanliness judge(const Swing& swing);

}  // namespace lmdbench
