// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// How an LMD's distance becomes the length of its force. To add one: a value here, the count, and
/// its description in force_law.cpp.
enum class ForceLaw : std::uint8_t {
  LINEAR,      ///< The original's: proportional to what is left of the cutoff.
  EXPONENTIAL  ///< The improved algorithm's (paper, section 4.5; decision E9).
};

/// For arrays indexed by ForceLaw.
inline constexpr std::size_t FORCE_LAW_COUNT = 2;

/// All of them, in the order of their values.
const std::vector<ForceLaw>& force_laws();
/// As experiment files spell it: "linear", "exponential".
std::string_view to_string(ForceLaw law);
/// @throws UsageError for an unknown name, naming those that there are
ForceLaw force_law_named(std::string_view name, const std::string& file = "",
                         const std::string& place = "force_law");

/// A force law with its constants; *hard* and *soft* are profiles. The paper gives none of them
/// (decision E8): they belong to the experiment and are recorded with the result.
struct ForceProfile {
  ForceLaw law = ForceLaw::EXPONENTIAL;
  double cutoff = 0.0;               ///< No force at or beyond this distance [m].
  double saturation_distance = 0.0;  ///< Full force at or below it [m]; below the cutoff.
  double maximum_force = 0.0;        ///< F_max of one LMD [N].
  double sharpness = 4.0;            ///< k of the exponential law; k -> 0 is linear. Dimensionless.
  /// The length of the summed force is clipped to this [N], if not by the device to less.
  double largest_sum = std::numeric_limits<double>::infinity();
  /// Factor of a force that a method has of its own (own_wrench.h): the law does not shape it.
  double own_scale = 1.0;

  /// F_max and all that is measured by it, times a factor.
  void scale_force(double factor) {
    maximum_force *= factor;
    largest_sum *= factor;
    own_scale *= factor;
  }
};

/// Checks that a profile can be evaluated: 0 <= saturation_distance < cutoff, maximum_force > 0,
/// sharpness >= 0, all finite.
/// @param file    experiment file that the profile comes from, or empty
/// @param pointer JSON pointer of the profile in that file; the field's name is appended
/// @throws UsageError naming the field
void validate_force_profile(const ForceProfile& profile, const std::string& file = "",
                            const std::string& pointer = "");

/// Length of one LMD's force [N] at distance >= 0 [m]: F(d) = F_max for d <= d_sat, else F_max
/// (e^(k s) - 1) / (e^k - 1), s = (cutoff - d) / (cutoff - d_sat); F_max s for the linear law.
/// Continuous at both ends; zero at and beyond the cutoff; NaN for a NaN distance.
/// @pre the profile is valid (`validate_force_profile`)
double force_magnitude(const ForceProfile& profile, double distance);

/// Stiffness -dF/dd [N/m] of one LMD's force; 0 where the force is constant (saturated,
/// or at and beyond the cutoff).
/// @pre the profile is valid (`validate_force_profile`)
double force_stiffness(const ForceProfile& profile, double distance);

}  // namespace lmdbench
