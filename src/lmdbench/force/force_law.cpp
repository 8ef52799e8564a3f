// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/force/force_law.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace lmdbench {

namespace {

/// A law between the saturation distance and the cutoff, where s of decision E9 goes from 1 to 0.
struct ForceLawDescription {
  std::string_view name;
  double (*magnitude)(const ForceProfile& profile, double s);  ///< newtons
  double (*stiffness)(const ForceProfile& profile, double s);  ///< N/m
};

/// Below this sharpness the exponential law is linear up to rounding: its relative deviation is k
/// (1 - s) / 2 to first order.
inline constexpr double LINEAR_SHARPNESS = std::numeric_limits<double>::epsilon();

double linear_magnitude(const ForceProfile& profile, double s) {
  return profile.maximum_force * s;
}

double linear_stiffness(const ForceProfile& profile, double /*s*/) {
  return profile.maximum_force / (profile.cutoff - profile.saturation_distance);
}

double exponential_magnitude(const ForceProfile& profile, double s) {
  const double k = profile.sharpness;
  LMDBENCH_EXPECTS(k >= 0.0, "a profile that was not validated (validate_force_profile)");
  if (k < LINEAR_SHARPNESS) return linear_magnitude(profile, s);
  // Decision E9, ours: (e^(k s) - 1) / (e^k - 1) as e^(k (s - 1)) (1 - e^(-k s)) / (1 - e^(-k)): no
  // exponent is positive, so large k do not overflow; expm1 keeps the digits of small k.
  return profile.maximum_force * std::exp(k * (s - 1.0)) * (std::expm1(-k * s) / std::expm1(-k));
}

double exponential_stiffness(const ForceProfile& profile, double s) {
  const double k = profile.sharpness, linear = linear_stiffness(profile, s);
  return k < LINEAR_SHARPNESS ? linear : linear * std::exp(k * (s - 1.0)) * (k / -std::expm1(-k));
}

/// In the order of ForceLaw.
constexpr std::array<ForceLawDescription, FORCE_LAW_COUNT> LAWS{
    {{"linear", linear_magnitude, linear_stiffness},
     {"exponential", exponential_magnitude, exponential_stiffness}}};

const ForceLawDescription& description_of(ForceLaw law) {
  const auto index = static_cast<std::size_t>(law);
  LMDBENCH_ALWAYS(index < LAWS.size() && LAWS[index].magnitude != nullptr,
                  "a force law without a description");
  return LAWS[index];
}

/// s of decision E9: 1 at the saturation distance, 0 at the cutoff.
double closeness(const ForceProfile& profile, double distance) {
  LMDBENCH_EXPECTS(profile.saturation_distance < profile.cutoff,
                   "a profile that was not validated (validate_force_profile)");
  return (profile.cutoff - distance) / (profile.cutoff - profile.saturation_distance);
}

[[noreturn]] void refuse(const std::string& file, const std::string& place, double value,
                         const char* remedy) {
  throw UsageError(file, place, fmt::format("{} is not a usable value", value), remedy);
}

}  // namespace

const std::vector<ForceLaw>& force_laws() {
  static const std::vector<ForceLaw> all = [] {
    std::vector<ForceLaw> laws;
    for (std::size_t law = 0; law < FORCE_LAW_COUNT; ++law) laws.push_back(static_cast<ForceLaw>(law));
    return laws;
  }();
  return all;
}

std::string_view to_string(ForceLaw law) {
  return description_of(law).name;
}

ForceLaw force_law_named(std::string_view name, const std::string& file, const std::string& place) {
  std::vector<std::string_view> known;
  for (const ForceLaw law : force_laws()) {
    if (to_string(law) == name) return law;
    known.push_back(to_string(law));
  }
  throw UsageError(file, place, fmt::format("unknown force law \"{}\"", name),
                   fmt::format("known ones: {}", fmt::join(known, ", ")));
}

void validate_force_profile(const ForceProfile& profile, const std::string& file,
                            const std::string& pointer) {
  if (!std::isfinite(profile.cutoff) || profile.cutoff <= 0.0)
    refuse(file, pointer + "/cutoff", profile.cutoff, "give a finite distance in metres above 0");
  if (!(profile.saturation_distance >= 0.0 && profile.saturation_distance < profile.cutoff))
    refuse(file, pointer + "/saturation_distance", profile.saturation_distance,
           "give a distance in metres of at least 0 and below the cutoff");
  if (!std::isfinite(profile.maximum_force) || profile.maximum_force <= 0.0)
    refuse(file, pointer + "/maximum_force", profile.maximum_force, "give a finite force in newtons above 0");
  if (!std::isfinite(profile.sharpness) || profile.sharpness < 0.0)
    refuse(file, pointer + "/sharpness", profile.sharpness,
           "give a finite number of at least 0; 0 is linear");
}

double force_magnitude(const ForceProfile& profile, double distance) {
  LMDBENCH_EXPECTS(std::isnan(distance) || distance >= 0.0, "a signed depth in place of a distance");
  if (std::isnan(distance)) return distance;  // An unset distance must not pass for a free one.
  if (distance <= profile.saturation_distance) return profile.maximum_force;
  if (distance >= profile.cutoff) return 0.0;
  return description_of(profile.law).magnitude(profile, closeness(profile, distance));
}

double force_stiffness(const ForceProfile& profile, double distance) {
  LMDBENCH_EXPECTS(std::isnan(distance) || distance >= 0.0, "a signed depth in place of a distance");
  if (std::isnan(distance)) return distance;
  if (distance <= profile.saturation_distance || distance >= profile.cutoff) return 0.0;
  return description_of(profile.law).stiffness(profile, closeness(profile, distance));
}

}  // namespace lmdbench
