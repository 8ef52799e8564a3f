// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/force/aggregation.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <cmath>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

const ForceProfile PROFILE_OF_ONE{
    .law = ForceLaw::LINEAR, .cutoff = 1.0, .saturation_distance = 0.0, .maximum_force = 1.0};

CriticalPair critical(double distance, const Vec3& direction, int index) {
  CriticalPair pair;
  pair.pair.distance = distance;
  pair.pair.direction = direction.normalized();
  pair.pair.point_moving = Vec3(distance, 0.0, 0.0);
  pair.index = index;
  pair.is_minimum = pair.is_basin = index > 0;
  return pair;
}

Vec3 force_of(const Aggregation& law, const CriticalSet& set, const std::vector<Merge>& merges = {}) {
  return law.combine({set, merges}, PROFILE_OF_ONE, Vec3::Zero()).force;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-15) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " and " << b.transpose();
}

TEST(Aggregation, UnknownNameIsAnError) {
  EXPECT_EQ(aggregations().front().name, "sum");
  for (const Aggregation& law : aggregations()) EXPECT_EQ(aggregation_named(law.name).combine, law.combine);
  EXPECT_THAT(
      testing::message_of<UsageError>([] { aggregation_named("shard", "my.json", "/force/aggregation"); }),
      ::testing::AllOf(HasSubstr("/force/aggregation"), HasSubstr("sum, signed, shared")));
  EXPECT_THROW(force_law_named("cubic"), UsageError);
  for (const ForceLaw law : force_laws()) EXPECT_EQ(force_law_named(to_string(law)), law);
}

TEST(Aggregation, OfSeparatedMinimaAllAreTheSum) {
  const CriticalSet set{critical(0.2, {0, 0, -1}, 1), critical(0.5, {0, 1, -1}, 1),
                        critical(0.9, {1, 1, 1}, 1)};
  for (const Aggregation& law : aggregations()) {
    if (law.needs == AggregationNeeds::MINIMA) continue;  // These laws may give another force.
    const Wrench own = law.combine({set, {}}, PROFILE_OF_ONE, Vec3::Zero()),
                 sum = sum_forces(minima_of(set), PROFILE_OF_ONE, Vec3::Zero());
    expect_near(own.force, sum.force);
    expect_near(own.torque, sum.torque);
    EXPECT_NEAR(own.stiffness, sum.stiffness, 1e-14) << law.name;
  }
}

TEST(Aggregation, ALawOfTheLmdsAloneIsAsked) {
  const Aggregation mean{
      .name = "mean",
      .summary = "",
      .needs = AggregationNeeds::MINIMA,
      .combine = [](const ForceInput& input, const ForceProfile& profile, const Vec3& about) {
        Wrench wrench = sum_forces(minima_of(input.critical), profile, about);
        wrench.force /= static_cast<double>(input.critical.size());
        return wrench;
      }};
  const LmdSet lmds = minima_of({critical(0.2, {0, 0, -1}, 1), critical(0.5, {0, 1, -1}, 1)});
  const Wrench sum = ContactFinder(sum_law(), Scene{}).combine(lmds, PROFILE_OF_ONE, Vec3::Zero());
  expect_near(sum.force, sum_forces(lmds, PROFILE_OF_ONE, Vec3::Zero()).force);
  EXPECT_GT(sum.force.norm(), 0.1);
  expect_near(ContactFinder(mean, Scene{}).combine(lmds, PROFILE_OF_ONE, Vec3::Zero()).force,
              0.5 * sum.force);
}

TEST(Aggregation, AMinimumAndItsSaddleVanishTogether) {
  const Vec3 u(0.3, -0.2, 0.9), v(-0.5, 0.1, 0.8);
  const CriticalSet before{critical(0.2, u, 1)};
  for (const double apart : {0.0, 1e-12, 1e-6}) {
    const CriticalSet set{critical(0.2, u, 1), critical(0.4 - apart, v, 1), critical(0.4, v, -1)};
    const std::vector<Merge> merges{{2, 0, 1}};
    for (const Aggregation* law : {&signed_law(), &shared_law()})
      expect_near(force_of(*law, set, merges), force_of(*law, before), 10.0 * apart + 1e-15);
    EXPECT_GT((force_of(sum_law(), set, merges) - force_of(sum_law(), before)).norm(), 0.5);
  }
}

TEST(Aggregation, SharedIsTheIntegralOverLevels) {
  const Vec3 u = Vec3(0.3, -0.2, 0.9).normalized(), v = Vec3(-0.5, 0.1, 0.8).normalized();
  const CriticalSet set{critical(0.1, u, 1), critical(0.3, v, 1), critical(0.5, {0, 0, 1}, -1)};
  // f = 1 - d. The branches are alone from .1 and .3 to .5; at the merge they are .4 and .2 long.
  const Vec3 expected = -(0.4 * u + 0.2 * v) - 0.5 * (2.0 / 3.0 * u + 1.0 / 3.0 * v);
  expect_near(force_of(shared_law(), set, {{{2, 0, 1}}}), expected);
  // Merges at one level have no order.
  const CriticalSet three{critical(0.1, u, 1), critical(0.2, v, 1), critical(0.3, {1, 0, 0}, 1),
                          critical(0.6, {0, 0, 1}, -1), critical(0.6, {0, 1, 1}, -1)};
  expect_near(force_of(shared_law(), three, {{3, 0, 1}, {4, 1, 2}}),
              force_of(shared_law(), three, {{4, 1, 2}, {3, 0, 1}}), 1e-15);
  // A merge that closes a loop shares nothing more.
  expect_near(force_of(shared_law(), three, {{3, 0, 1}, {4, 1, 0}}),
              force_of(shared_law(), three, {{3, 0, 1}}), 1e-15);
}

TEST(Aggregation, SignedIsTheSlopeOfItsPotential) {
  // Signed weights in parallel directions.
  const CriticalSet set{critical(0.2, {0, 0, 1}, 1), critical(0.3, {0, 0, 1}, -2),
                        critical(0.4, {0, 0, 1}, 3)};
  expect_near(force_of(signed_law(), set), -Vec3(0, 0, 0.8 - 2 * 0.7 + 3 * 0.6));
  const Wrench wrench = signed_law().combine({set, {}}, PROFILE_OF_ONE, Vec3::Zero());
  EXPECT_NEAR(wrench.stiffness, 1.0 - 2.0 + 3.0, 1e-14);
}

TEST(Aggregation, NothingBeyondTheCutoffPushes) {
  const CriticalSet set{critical(0.9999999, {0, 0, 1}, 1), critical(1.2, {0, 1, 0}, 1),
                        critical(1.5, {1, 0, 0}, -1)};
  for (const Aggregation& law : aggregations())
    EXPECT_LT(force_of(law, set, {{2, 0, 1}}).norm(), 1e-6) << law.name;
}

TEST(Aggregation, ContactWithoutDirectionIsLeftOut) {
  CriticalPair touching;
  touching.pair.distance = 0.0;
  const CriticalSet set{touching, critical(0.5, {0, 0, 1}, 1)};
  for (const Aggregation& law : aggregations()) expect_near(force_of(law, set), -Vec3(0, 0, 0.5));
}

TEST(Aggregation, SaturationIsPartOfTheProfile) {
  ForceProfile saturated = PROFILE_OF_ONE;
  saturated.saturation_distance = 0.6;
  // Both are saturated up to the merge: neither gives a share of its own, but branch lengths count.
  const Vec3 u = Vec3(1, 0, 1).normalized(), v = Vec3(-1, 0, 1).normalized();
  const CriticalSet set{critical(0.1, u, 1), critical(0.3, v, 1), critical(0.5, {0, 0, 1}, -1)};
  const std::vector<Merge> merges{{2, 0, 1}};
  expect_near(shared_law().combine({set, merges}, saturated, Vec3::Zero()).force, -(2.0 * u + v) / 3.0);
}

SurfaceSample sample_at(double distance, const Vec3& direction, double area) {
  return {distance, area, direction, Vec3::Zero(), 0};
}

TEST(Aggregation, LayeredIsTheMeanOverTheSurface) {
  // f = 1 - d. Up to 0.4 the minimum alone; above, weights AREA (t - 0.4) and KAPPA (t - 0.2).
  const Vec3 u = Vec3::UnitZ(), v = Vec3::UnitX();
  const CriticalSet set{critical(0.2, u, 1)};
  constexpr double AREA = 0.3, KAPPA = 0.5, SUM = AREA + KAPPA;
  const std::vector<SurfaceSample> samples{sample_at(0.4, v, AREA)};
  const std::vector<double> areas{KAPPA};
  const Vec3 force = layered_law().combine({set, {}, samples, areas}, PROFILE_OF_ONE, Vec3::Zero()).force;
  // The integral of AREA (t - 0.4) / (SUM t - b) from 0.4 to 1.
  const double b = 0.4 * AREA + 0.2 * KAPPA;
  const double share = AREA / SUM * (0.6 + (b / SUM - 0.4) * std::log((SUM - b) / (0.4 * SUM - b)));
  expect_near(force, -(0.2 + 0.6 - share) * u - share * v, 1e-4);
  // Without any patch `layered` is `shared`.
  expect_near(layered_law().combine({set, {}, {}, areas}, PROFILE_OF_ONE, Vec3::Zero()).force, -0.8 * u);
}

TEST(Aggregation, APatchBeginsWithoutAJump) {
  const CriticalSet set{critical(0.2, {0, 0, 1}, 1), critical(0.3, {0, 1, 0}, 1),
                        critical(0.6, {1, 0, 0}, -1)};
  const std::vector<Merge> merges{{2, 0, 1}};
  const std::vector<double> areas{0.1, 0.1, 0.0};
  const auto force_with = [&](double distance) {
    const std::vector<SurfaceSample> samples{sample_at(0.25, {0, 0.6, 0.8}, 2.0),
                                             sample_at(distance, {0.8, 0, 0.6}, 1.0)};
    return layered_law().combine({set, merges, samples, areas}, PROFILE_OF_ONE, Vec3::Zero()).force;
  };
  expect_near(force_with(1.0 - 1e-9), force_with(2.0), 1e-8);
  // Nor is there a jump where it passes the level of another patch or of the saddle.
  for (const double at : {0.25, 0.6}) expect_near(force_with(at - 1e-9), force_with(at + 1e-9), 1e-7);
}

TEST(Aggregation, APatchOfTheSameDirectionChangesNothing) {
  const Vec3 u = Vec3(0.3, -0.2, 0.9).normalized();
  const CriticalSet set{critical(0.05, u, 1)};
  const std::vector<SurfaceSample> samples{sample_at(0.07, u, 1.0), sample_at(0.3, u, 3.0)};
  const std::vector<double> areas{0.1};
  for (const ForceLaw law : force_laws())
    for (const double saturation : {0.0, 0.06, 0.2, 0.299, 0.4}) {
      ForceProfile profile = PROFILE_OF_ONE;
      profile.law = law;
      profile.saturation_distance = saturation;
      expect_near(layered_law().combine({set, {}, samples, areas}, profile, Vec3::Zero()).force,
                  -force_magnitude(profile, 0.05) * u, 1e-13);
    }
}

}  // namespace
}  // namespace lmdbench
