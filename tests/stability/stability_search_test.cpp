// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/phantom/stability_boundary.h>
#include <lmdbench/stability/stability_search.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/committed.h>
#include <support/files.h>
#include <support/scratch_directory.h>
#include <support/source_directory.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

StabilityRow search(const std::vector<Override>& overrides) {
  return find_critical_stiffness(load_experiment(testing::WALL_FILE, overrides)).at(0);
}

/// The wall's ball is 2.02 mm within the cutoff, on a device without clipping; taps of a quarter.
std::vector<Override> pressed(const std::vector<Override>& more) {
  std::vector<Override> overrides{"/loop/push_n=[0, 0, 0]", "/force/cutoff_m=0.022"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

/// Characterization: simulation with meshes and method gives the table of the exact boundary.
TEST(StabilitySearch, WallReproducesTheExactTable) {
  const std::pair<int, double> table[] = {
      {0, 1605.3511}, {1, 536.2786}, {2, 322.7439}, {5, 148.0801}, {10, 78.7445}};
  for (const auto& [delay, exact] : table) {
    const StabilityRow row = search({fmt::format("/loop/delay_frames={}", delay)});
    EXPECT_NEAR(row.critical_stiffness_n_per_m, exact, 1e-3 * exact) << delay;
    EXPECT_NEAR(row.exact_n_per_m, exact, 1e-4) << delay;
  }
}

/// Number of random devices: a few, or LMDBENCH_STABILITY_DEVICES in a long run.
int device_count() {
  const char* const wanted = std::getenv("LMDBENCH_STABILITY_DEVICES");
  return wanted != nullptr ? std::atoi(wanted) : 5;
}

/// The softest boundary that scripts ask for still carries the file's push.
TEST(StabilitySearch, WallFindsVerySoftBoundaries) {
  const StabilityRow row = search(
      {"/loop/mass_kg=0.1", "/loop/damping_n_s_per_m=0.1", "/frame_rate_hz=250", "/loop/delay_frames=100"});
  EXPECT_NEAR(row.critical_stiffness_n_per_m, row.exact_n_per_m, 1e-3 * row.exact_n_per_m);
  EXPECT_LT(row.exact_n_per_m, 0.5);
}

/// For any device, rate and delay the stiffness found is exact to 0.1 %.
TEST(StabilitySearch, WallIsExactForEveryDevice) {
  std::mt19937_64 random(20);
  const auto logarithmic = [&random](double least, double most) {
    return least * std::pow(most / least, static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (int i = 0; i < device_count(); ++i) {
    const double mass = logarithmic(0.02, 1.0);
    const double damping = logarithmic(0.2, 10.0);
    const double rate = logarithmic(250.0, 10000.0);
    const int delay = static_cast<int>(random() % 51);
    const StabilityRow row =
        search({fmt::format("/loop/mass_kg={}", mass), fmt::format("/loop/damping_n_s_per_m={}", damping),
                fmt::format("/frame_rate_hz={}", rate), fmt::format("/loop/delay_frames={}", delay)});
    EXPECT_NEAR(row.critical_stiffness_n_per_m, row.exact_n_per_m, 1e-3 * row.exact_n_per_m)
        << mass << " kg, " << damping << " N s/m, " << rate << " Hz, " << delay << " frames";
  }
}

TEST(StabilitySearch, HandMovesTheBoundaryAsItsExactOne) {
  const StabilityRow row =
      search({"/loop/hand=hogan-1989", "/loop/mass_kg=0.072", "/loop/damping_n_s_per_m=0.005"});
  EXPECT_NEAR(row.exact_n_per_m, 11022.0, 0.5);
  EXPECT_NEAR(row.critical_stiffness_n_per_m, row.exact_n_per_m, 1e-3 * row.exact_n_per_m);
}

StabilityRow search_lever(const std::vector<Override>& overrides) {
  return find_critical_stiffness(load_experiment(testing::LEVER_FILE, overrides)).at(0);
}

/// A device too heavy to move, touched 50 mm beside its turning point: a rotational wall, K l^2.
TEST(StabilitySearch, RotationalWallIsExact) {
  for (const int delay : {0, 3}) {
    const StabilityRow row = search_lever(
        {"/loop/mass_kg=1000", "/loop/damping_n_s_per_m=10000", "/loop/rotation/inertia_kg_m2=1e-4",
         "/loop/rotation/damping_n_m_s=2e-3", fmt::format("/loop/delay_frames={}", delay)});
    const double rotational = critical_stiffness({{1e-4, 2e-3, 0.0, std::nullopt}, 1e-3, delay});
    EXPECT_NEAR(0.0025 * row.critical_stiffness_n_per_m, rotational, 1e-3 * rotational) << delay;
    EXPECT_NEAR(row.critical_stiffness_n_per_m, row.exact_n_per_m, 1e-3 * row.exact_n_per_m) << delay;
  }
}

TEST(StabilitySearch, TurningDeviceIsExact) {
  for (const std::vector<Override>& device :
       {std::vector<Override>{}, std::vector<Override>{"/loop/delay_frames=4", "/frame_rate_hz=2500"},
        std::vector<Override>{"/loop/rotation/lever_m=0.02", "/loop/hand=hogan-1989"}}) {
    const StabilityRow row = search_lever(device);
    EXPECT_NEAR(row.critical_stiffness_n_per_m, row.exact_n_per_m, 1e-3 * row.exact_n_per_m);
    EXPECT_LT(row.bound_n_per_m, row.exact_n_per_m);
  }
}

TEST(StabilitySearch, DeviceThatClipsFirstSaysSo) {
  // The Desktop renders 7.9 N at most: 717 N/m at 11 mm depth, below the boundary.
  const StabilityRow row =
      search({"/device=phantom-desktop", "/loop/push_n=[0, 0, 0]", "/force/cutoff_m=0.031"});
  EXPECT_EQ(row.clean_until, "device_force");
  EXPECT_NEAR(row.critical_stiffness_n_per_m, 7.9 / 0.01102, 0.01 * 7.9 / 0.01102);
}

/// However stiff the file's contact: the search varies it.
TEST(StabilitySearch, AFileWhoseForceTheDeviceClipsIsSearchedDownwards) {
  const auto boundary = [](double force) {
    return search(pressed({"/device=phantom-desktop", "/loop/friction_n=0", "/loop/resolution_m=0",
                           "/loop/damping_n_s_per_m=0.8", fmt::format("/force/maximum_force_n={}", force)}));
  };
  const StabilityRow soft = boundary(5.0), hard = boundary(20000.0);
  EXPECT_GT(soft.critical_stiffness_n_per_m, 100.0);
  EXPECT_EQ(hard.clean_until, soft.clean_until);
  EXPECT_NEAR(hard.critical_stiffness_n_per_m, soft.critical_stiffness_n_per_m,
              2e-3 * soft.critical_stiffness_n_per_m);
}

TEST(StabilitySearch, DeviceThatClipsTheTorqueFirstSaysSo) {
  // 0.188 N m at most, 50 mm beside the held point and 11 mm deep: 341 N/m, less than the boundary
  // and than 8.5 N give. The hand's spring keeps the lever from rolling over the tip.
  const StabilityRow row =
      search_lever({"/device=phantom-premium-1.5-6dof", "/loop/push_n=[0, 0, 0]", "/force/cutoff_m=0.031",
                    "/loop/friction_n=0", "/loop/resolution_m=0",
                    R"(/loop/rotation/hand={"damping_n_m_s": 0.01, "stiffness_n_m": 1})"});
  EXPECT_EQ(row.clean_until, "device_force");
  const double torque_limit = 0.188 / (0.05 * 0.01102);
  EXPECT_NEAR(row.critical_stiffness_n_per_m, torque_limit, 0.01 * torque_limit);
  EXPECT_GT(row.exact_n_per_m, 1.5 * torque_limit);
}

/// With counts, growth is not smooth in the stiffness. The answer is clean; none far above it is.
TEST(StabilitySearch, IsNearTheBoundaryWhereEncodersCount) {
  for (const double resolution : {1e-5, 3e-5, 1e-4}) {
    const std::string counts = fmt::format("/loop/resolution_m={}", resolution);
    const StabilityRow row = search(pressed({counts}));
    const auto clean_at = [&](double stiffness) {
      // F_max divided by the cutoff.
      const Experiment experiment = load_experiment(
          testing::WALL_FILE, pressed({counts, fmt::format("/force/maximum_force_n={}", 0.022 * stiffness)}));
      const PreparedRun prepared = prepare(experiment);
      const StabilityTrial trial =
          try_stiffness(experiment, prepared.input, driven_methods(experiment, prepared).at(0), {});
      EXPECT_NEAR(trial.stiffness_n_per_m, stiffness, 1e-6 * stiffness);
      return trial.outcome.clean();
    };
    EXPECT_NEAR(row.critical_stiffness_n_per_m, row.exact_n_per_m, 0.05 * row.exact_n_per_m) << resolution;
    EXPECT_TRUE(clean_at(row.critical_stiffness_n_per_m)) << resolution;
    EXPECT_FALSE(clean_at(1.05 * row.exact_n_per_m)) << resolution;
  }
}

/// Another method's set under a law as a force of its own, and no set.
class OwnLaw : public Method, public HasOwnWrench {
 public:
  OwnLaw(std::unique_ptr<Method> method, const ForceProfile& profile)
      : method_(std::move(method)), profile_(profile) {}
  const MethodDescription& description() const override { return method_->description(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    method_->search(X_WM, lmds, counters);
    const Wrench wrench = sum_forces(lmds, profile_, X_WM.translation);
    own_ = {.force = wrench.force, .torque = wrench.torque, .about = X_WM.translation};
    lmds.clear();
  }
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }
  std::optional<OwnWrench> own_wrench(std::size_t /*mover*/) const override { return own_; }

 private:
  std::unique_ptr<Method> method_;
  ForceProfile profile_;
  OwnWrench own_;
};

/// A force of a method's own is scaled, measured and shaken like the law that it equals.
TEST(StabilitySearch, OwnForceIsTriedAsTheLawThatItEquals) {
  const Experiment experiment = load_experiment(testing::WALL_FILE, pressed({}));
  const PreparedRun prepared = prepare(experiment);
  const DrivenMethod law = driven_methods(experiment, prepared).at(0);
  DrivenMethod own = law;
  own.make = [&] { return std::make_unique<OwnLaw>(law.make(), law.profile); };
  for (const auto& [stiffness, clean] : {std::pair{1550.0, true}, std::pair{1650.0, false}}) {
    const auto trial_of = [&, s = stiffness](DrivenMethod method) {
      method.profile.scale_force(s / (law.profile.maximum_force / law.profile.cutoff));
      return try_stiffness(experiment, prepared.input, method, {});
    };
    const StabilityTrial of_own = trial_of(own), of_law = trial_of(law);
    EXPECT_NEAR(of_own.stiffness_n_per_m, stiffness, 1e-6 * stiffness);
    EXPECT_NEAR(of_own.force_at_rest_W.z(), of_law.force_at_rest_W.z(), 1e-9);
    EXPECT_EQ(of_own.outcome.clean(), clean);
    EXPECT_EQ(of_law.outcome.clean(), clean);
  }
}

TEST(StabilitySearch, PushIsCarriedOrThereIsNoCleanStiffness) {
  // 78.7 N/m over 20 mm carry 1.57 N: a stiffness that does not shake cannot carry a push of 2 N.
  const auto row = [](double push) {
    return search({"/loop/delay_frames=10", fmt::format("/loop/push_n=[0, 0, {}]", -push)});
  };
  EXPECT_NEAR(row(1.5).critical_stiffness_n_per_m, 78.7445, 0.08);
  const StabilityRow sinking = row(2.0);
  EXPECT_EQ(sinking.clean_until, "never");
  EXPECT_TRUE(std::isnan(sinking.critical_stiffness_n_per_m));
}

TEST(StabilitySearch, APushThatTheDeviceCannotRenderIsNeverCarried) {
  const StabilityRow row = search({"/device=phantom-premium-1.5", "/loop/push_n=[0, 0, -20]"});
  EXPECT_EQ(row.clean_until, "never");
  EXPECT_NE(advice(row).find("/loop/push_n"), std::string::npos);
}

TEST(StabilitySearch, ClipAtTheProfilesMaximumIsScaledWithIt) {
  // 20 N exceed the file's F_max of 10 N, but not the 32 N at the boundary's stiffness.
  const StabilityRow row = search({"/loop/push_n=[0, 0, -20]", "/force/clip=maximum"});
  EXPECT_NEAR(row.critical_stiffness_n_per_m, 1605.3511, 1.6);
}

/// Two contacts at 0.8 F_max each: their sum is constant, but they do not turn away.
TEST(StabilitySearch, ASumThatTheProfileClipsHasNoCleanStiffness) {
  const std::vector<Override> two{R"(/fixed=[{"mesh": "slab"}, {"mesh": "slab"}])", "/force/cutoff_m=0.1",
                                  "/loop/push_n=[0, 0, 0]"};
  std::vector<Override> clipped = two;
  clipped.emplace_back("/force/clip=maximum");
  EXPECT_TRUE(search(two).has_answer());
  EXPECT_EQ(search(clipped).clean_until, "never");
}

TEST(StabilitySearch, DeviceRestsWhereTheContactCarriesThePush) {
  for (const char* const law : {"linear", "exponential"}) {
    for (const double push : {0.5, 3.0, 9.0}) {
      const Experiment experiment = load_experiment(
          testing::WALL_FILE,
          {fmt::format("/methods/0/force_law={}", law), fmt::format("/loop/push_n=[0, 0, {}]", -push)});
      const PreparedRun prepared = prepare(experiment);
      const StabilityTrial trial =
          try_stiffness(experiment, prepared.input, driven_methods(experiment, prepared).at(0), {});
      ASSERT_TRUE(trial.carried && trial.in_contact);
      EXPECT_NEAR(trial.force_at_rest_W.z(), push, 1e-6 * push) << law;
      // F = F_max (e^(k s) - 1) / (e^k - 1): its slope is k (F + F_max / (e^k - 1)) / cutoff.
      const double slope =
          std::string(law) == "linear" ? 500.0 : 4.0 * (push + 10.0 / std::expm1(4.0)) / 0.02;
      EXPECT_NEAR(trial.stiffness_n_per_m, slope, 1e-5 * slope) << law;
    }
  }
}

/// Two sharp ridges along y of a mesh, at x and -x, upwards or downwards.
TriangleMesh ridges(double x, bool upwards) {
  const TriangleMesh up = translated(make_wedge(0.01, 0.1, 0.03), Vec3(0.0, 0.0, -0.015));
  TriangleMesh one = up;
  for (Vec3& vertex : one.vertices)
    if (!upwards) vertex = Vec3(-vertex.x(), vertex.y(), -vertex.z());
  return merged(translated(one, Vec3(x, 0.0, 0.0)), translated(one, Vec3(-x, 0.0, 0.0)));
}

/// Ridges across ridges at 45 degrees: contacts that turn are less stiff than their K_eff.
TEST(StabilitySearch, ContactsThatTurnAreLessStiffThanTheirLawAndMayGiveWay) {
  const testing::ScratchDirectory scratch;
  constexpr double CUTOFF = 0.005, FORCE = 10.0;
  for (const double distance : {0.004, 0.002}) {
    const double beside = distance / std::numbers::sqrt2;
    write_off(scratch / "moving.off", ridges(0.02, false));
    write_off(scratch / "fixed.off", ridges(0.02 + beside, true));
    const std::string rest = fmt::format("0 0 {0} 0 0 0 1", beside);
    const std::string path = scratch.write("rest.tum", "0 " + rest + "\n1 " + rest + "\n");
    const std::vector<Override> overrides{"/moving={\"mesh\":\"" + (scratch / "moving.off").string() + "\"}",
                                          "/fixed=[{\"mesh\":\"" + (scratch / "fixed.off").string() + "\"}]",
                                          "/path/file=" + path,
                                          fmt::format("/force/cutoff_m={}", CUTOFF),
                                          fmt::format("/force/maximum_force_n={}", FORCE),
                                          "/loop/push_n=[0, 0, 0]",
                                          "/loop/hand=postural-arm"};
    if (distance < 0.5 * CUTOFF) {
      EXPECT_EQ(search(overrides).clean_until, "gives_way");
      continue;
    }
    const Experiment experiment = load_experiment(testing::WALL_FILE, overrides);
    const PreparedRun prepared = prepare(experiment);
    const StabilityTrial trial =
        try_stiffness(experiment, prepared.input, driven_methods(experiment, prepared).at(0), {});
    const double slope = FORCE / CUTOFF - FORCE * (1.0 / distance - 1.0 / CUTOFF);
    EXPECT_NEAR(trial.stiffness_n_per_m, slope, 1e-4 * slope) << "K_eff is a third more";
  }
}

TEST(StabilitySearch, PathOutOfContactIsNoContact) {
  EXPECT_EQ(search({"/force/cutoff_m=0.001"}).clean_until, "no_contact");
  EXPECT_EQ(search({"/force/cutoff_m=0.001", "/loop/push_n=[0, 0, 0]"}).clean_until, "no_contact");
  EXPECT_EQ(search({"/loop/push_n=[0, 0, 1]"}).clean_until, "no_contact") << "pushed away from the wall";
}

TEST(StabilitySearch, NothingIsCleanWithoutDamping) {
  const StabilityRow row = search({"/loop/damping_n_s_per_m=0"});
  EXPECT_EQ(row.exact_n_per_m, 0.0);
  EXPECT_TRUE(std::isnan(row.critical_stiffness_n_per_m));
  EXPECT_EQ(row.clean_until, "never");
}

/// Devices that lose all speed within a period shake at half the rate; boundary near 2 b / T.
TEST(StabilitySearch, OverdampedDevicesAreExact) {
  for (const auto& [mass, damping, delay] : {std::tuple{1e-6, 10.0, 0}, {1e-4, 5.0, 3}, {0.01, 10.0, 100}}) {
    const StabilityRow row =
        search({fmt::format("/loop/mass_kg={}", mass), fmt::format("/loop/damping_n_s_per_m={}", damping),
                fmt::format("/loop/delay_frames={}", delay)});
    EXPECT_NEAR(row.critical_stiffness_n_per_m, row.exact_n_per_m, 1e-3 * row.exact_n_per_m)
        << mass << " kg, " << damping << " N s/m, " << delay << " frames";
  }
}

constexpr double PRESSED_M = 0.00202;

struct CoulombDevice {
  double mass, damping, friction;
  int delay;
};

/// One axis alone: mass, damper, Coulomb friction that holds, and a sampled spring about the rest
/// position, in steps of 1/500 period, velocity first.
/// @return whether a tap that would swing to `tap` decays before it swings to half of PRESSED_M
bool dies_down(const CoulombDevice& device, double stiffness, double tap) {
  constexpr double PERIOD = 1e-3;
  constexpr int STEPS = 500;
  constexpr double STEP = PERIOD / STEPS;
  double x = 0.0;
  double v = tap * std::sqrt(stiffness / device.mass);
  std::vector<double> under_way(static_cast<std::size_t>(device.delay), 0.0);
  int still = 0;
  for (int period = 0; period < 200'000; ++period) {
    under_way.push_back(-stiffness * x);
    const double spring = under_way.front();
    under_way.erase(under_way.begin());
    bool moved = false;
    for (int step = 0; step < STEPS; ++step) {
      if (v == 0.0 && std::abs(spring) <= device.friction) continue;
      moved = true;
      const double against =
          v != 0.0 ? std::copysign(device.friction, v) : std::copysign(device.friction, spring);
      const double next = v + STEP * (spring - device.damping * v - against) / device.mass;
      v = v * next < 0.0 ? 0.0 : next;
      x += STEP * v;
      if (std::abs(x) > 0.5 * PRESSED_M) return false;
    }
    still = moved ? 0 : still + 1;
    if (still > device.delay + 1) return true;
  }
  return true;
}

double critical_by_itself(const CoulombDevice& device, double tap) {
  double low = 10.0, high = 10.0;
  while (dies_down(device, high, tap)) low = std::exchange(high, 1.5 * high);
  while (high > 1.002 * low) {
    const double middle = std::sqrt(low * high);
    (dies_down(device, middle, tap) ? low : high) = middle;
  }
  return low;
}

/// Through meshes, method and exact integrator, against an integration without shared code.
TEST(StabilitySearch, FrictionIsAsAnIndependentIntegrationHasIt) {
  for (const CoulombDevice& device :
       {CoulombDevice{0.045, 0.005, 0.06, 0}, CoulombDevice{0.04, 0.8, 0.1, 0},
        CoulombDevice{0.075, 0.005, 0.04, 1}, CoulombDevice{0.2, 0.3, 0.03, 3}}) {
    const StabilityRow row = search(pressed({fmt::format("/loop/mass_kg={}", device.mass),
                                             fmt::format("/loop/damping_n_s_per_m={}", device.damping),
                                             fmt::format("/loop/friction_n={}", device.friction),
                                             fmt::format("/loop/delay_frames={}", device.delay)}));
    EXPECT_NEAR(row.tap_m, FRICTION_TAP_SHARE * PRESSED_M, 0.02 * PRESSED_M);
    const double expected = critical_by_itself(device, row.tap_m);
    EXPECT_NEAR(row.critical_stiffness_n_per_m, expected, 0.02 * expected)
        << device.mass << " kg, " << device.damping << " N s/m, " << device.friction << " N, "
        << device.delay;
    EXPECT_GT(row.critical_stiffness_n_per_m, row.exact_n_per_m) << "friction only takes energy";
    EXPECT_TRUE(row.has_answer());
  }
}

/// Friction f takes 4 f a an oscillation; a held stiffness K gives pi w a^2 (K (T/2 + t_d) - b).
TEST(StabilitySearch, FrictionIsNearItsEnergyBalance) {
  for (const auto& [friction, delay] : {std::pair{0.06, 0}, {0.03, 1}, {0.12, 0}}) {
    const StabilityRow row = search(
        pressed({"/loop/mass_kg=0.045", "/loop/damping_n_s_per_m=0.005",
                 fmt::format("/loop/friction_n={}", friction), fmt::format("/loop/delay_frames={}", delay)}));
    const double k = row.critical_stiffness_n_per_m;
    const double a = row.tap_m;
    const double given = std::numbers::pi * std::sqrt(k / 0.045) * a * a * (k * 1e-3 * (0.5 + delay) - 0.005);
    EXPECT_NEAR(given, 4.0 * friction * a, 0.15 * given) << friction << " N, " << delay << " frames";
  }
}

TEST(StabilitySearch, LargerTapsBearLessStiffness) {
  const auto at = [](double cutoff) {
    return search({"/loop/push_n=[0, 0, 0]", "/loop/friction_n=0.06", "/loop/mass_kg=0.045",
                   "/loop/damping_n_s_per_m=0.005", fmt::format("/force/cutoff_m={}", cutoff)});
  };
  const StabilityRow small = at(0.0215);
  const StabilityRow large = at(0.024);
  EXPECT_LT(small.tap_m, large.tap_m);
  EXPECT_GT(small.critical_stiffness_n_per_m, large.critical_stiffness_n_per_m);
}

/// 1 um within the cutoff no tap overcomes 0.1 N: "stuck"; a search by growth gives 26,024 N/m.
TEST(StabilitySearch, TapsWithinFrictionAreStuck) {
  for (const char* counts : {"0", "3e-5"}) {
    const StabilityRow row = search({"/loop/friction_n=0.1", std::string("/loop/resolution_m=") + counts});
    EXPECT_EQ(row.clean_until, "stuck");
    EXPECT_TRUE(std::isnan(row.critical_stiffness_n_per_m));
    EXPECT_FALSE(row.has_answer());
    EXPECT_LT(row.trials, 100);
    EXPECT_NE(advice(row).find("/loop/push_n of more than 0.8 N"), std::string::npos) << advice(row);
  }
  // The remedy of the message works.
  const StabilityRow row = search({"/loop/friction_n=0.1", "/loop/push_n=[0, 0, -2]"});
  EXPECT_TRUE(row.has_answer());
  EXPECT_GT(row.critical_stiffness_n_per_m, row.exact_n_per_m);
}

/// The wall moves, too, and beside it a pair stands at a quarter of the cutoff: no business of the
/// held mesh.
TEST(StabilitySearch, OtherPairsDoNotChangeTheTap) {
  const auto slab = [](double x, const std::string& more) {
    return fmt::format(R"({{"mesh": "slab", "pose": {{"translation_m": [{}, 0, 0]}}{}}})", x, more);
  };
  const std::string rests = R"(, "path": {"way_diagonals": 0, "turn_rad": 0, "period_s": 1})";
  const auto with = [&](double height) {
    return search(
        {"/fixed=[" + slab(50.0, "") + "]",
         "/movers=[" + slab(0.0, rests) +
             fmt::format(
                 R"(, {{"mesh": "ball", "diagonal_m": 0.02, "pose": {{"translation_m": [50, 0, {}]}}{}}}])",
                 height, rests)});
  };
  const StabilityRow alone = with(5.0), beside = with(0.11077350269);
  EXPECT_NEAR(alone.critical_stiffness_n_per_m, alone.exact_n_per_m, 1e-3 * alone.exact_n_per_m);
  EXPECT_NEAR(beside.critical_stiffness_n_per_m, alone.critical_stiffness_n_per_m,
              1e-6 * alone.exact_n_per_m);
}

/// F_max is varied, so that of the file is only where the search begins.
TEST(StabilitySearch, AFileWhoseTapEncodersDoNotSeeIsSearchedDownwards) {
  const std::vector<Override> common{"/loop/resolution_m=1e-4", "/loop/push_n=[0, 0, -1]"};
  const auto with = [&](const char* maximum) {
    std::vector<Override> overrides = common;
    overrides.emplace_back(maximum);
    return search(overrides);
  };
  const StabilityRow seen = with("/force/maximum_force_n=10"), unseen = with("/force/maximum_force_n=30");
  ASSERT_TRUE(seen.has_answer());
  EXPECT_NEAR(unseen.critical_stiffness_n_per_m, seen.critical_stiffness_n_per_m,
              0.01 * seen.critical_stiffness_n_per_m)
      << unseen.clean_until;
}

/// A trial that is clean below where friction holds every tap does not make it "never".
TEST(StabilitySearch, FrictionThatHoldsAboveWhatIsCleanIsTold) {
  const StabilityRow row = search({"/device=ideal", "/loop/hand=postural-arm", "/loop/friction_n=0.2",
                                   "/loop/push_n=[0, 0, -1]", "/force/maximum_force_n=3"});
  EXPECT_EQ(row.clean_until, "stuck");
}

/// Above what the encoders see nothing is shown, but what was clean below stays so.
TEST(StabilitySearch, WhereEncodersSeeNothingTheCleanRangeEnds) {
  const StabilityRow row = search({"/device=ideal", "/loop/hand=postural-arm", "/loop/resolution_m=2.3e-5",
                                   "/loop/push_n=[0, 0, -1]", "/force/maximum_force_n=30"});
  EXPECT_GE(row.critical_stiffness_n_per_m, 1490.0) << row.clean_until;
  EXPECT_TRUE(row.has_answer());
}

/// Also without friction a tap within four counts shows nothing; nor may it leave the contact.
TEST(StabilitySearch, TapsAreSeenByTheEncoders) {
  const double exact = search(pressed({})).tap_m;
  const double fine = search(pressed({"/loop/resolution_m=1e-6"})).tap_m;
  EXPECT_DOUBLE_EQ(fine, exact) << "a hundredth of the way is more";
  const double coarse = search(pressed({"/loop/resolution_m=2e-5"})).tap_m;
  EXPECT_DOUBLE_EQ(coarse, 8e-5);
  const double coarser = search(pressed({"/loop/resolution_m=2e-4"})).tap_m;
  EXPECT_NEAR(coarser, 25.0 * exact, 0.01 * coarser) << "a quarter of the way at most";

  const StabilityRow row = search(pressed({"/loop/resolution_m=3e-3"}));
  EXPECT_EQ(row.clean_until, "within_counts");
  EXPECT_FALSE(row.has_answer());
  EXPECT_NE(advice(row).find("encoders"), std::string::npos) << advice(row);
}

/// Friction and counts of real devices give an answer with a reason, in few trials.
TEST(StabilitySearch, PhantomsHaveAnAnswer) {
  for (const char* device : {"phantom-desktop", "phantom-premium-1.5", "phantom-premium-1.5-6dof",
                             "phantom-omni", "phantom-premium-3.0-6dof"}) {
    Json file = Json::parse(testing::read_text(testing::WALL_FILE));
    for (const char* figure : {"mass_kg", "damping_n_s_per_m", "friction_n", "resolution_m"})
      file["loop"].erase(figure);
    file["device"] = device;
    const StabilityRow row =
        find_critical_stiffness(parse_experiment(file.dump(), testing::WALL_FILE, pressed({}))).at(0);
    EXPECT_TRUE(row.has_answer()) << device << ": " << row.clean_until;
    EXPECT_GT(row.critical_stiffness_n_per_m, row.exact_n_per_m) << device;
    EXPECT_LT(row.trials, 60) << device;
  }
}

TEST(StabilitySearch, NearerThanTheSaturationIsSaturated) {
  const StabilityRow row = search({"/force/saturation_m=0.01999", "/loop/push_n=[0, 0, 0]"});
  EXPECT_EQ(row.clean_until, "saturated");
  EXPECT_FALSE(row.has_answer());
  EXPECT_NE(advice(row).find("init --contact"), std::string::npos);
}

TEST(StabilitySearch, SpentBudgetIsUndecided) {
  const Experiment experiment = load_experiment(testing::WALL_FILE);
  const StabilityRow row = find_critical_stiffness(experiment, {}, {.trials = 3}).at(0);
  EXPECT_EQ(row.clean_until, "undecided");
  EXPECT_EQ(row.trials, 3);
  EXPECT_FALSE(row.has_answer());
  EXPECT_LE(row.critical_stiffness_n_per_m, row.exact_n_per_m) << "what is known so far";
  EXPECT_EQ(find_critical_stiffness(experiment, {}, {.seconds = 1e-9}).at(0).clean_until, "undecided");
}

/// Poses under a push that none carries are looked at within the budget, too.
TEST(StabilitySearch, TheBudgetHoldsWhereNothingIsCarried) {
  const Experiment experiment = load_experiment(testing::WALL_FILE, {"/loop/push_n=[1, 0, 0]"});
  std::int64_t told = 0;
  const auto rows = find_critical_stiffness(experiment,
                                            [&told](const std::string&, std::int64_t, std::int64_t) {
                                              ++told;
                                              return true;
                                            },
                                            {.trials = 1, .seconds = 1e9});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_GT(told, 10);
}

TEST(StabilitySearch, ProgressTellsTrialsAndStops) {
  const Experiment experiment = load_experiment(testing::WALL_FILE);
  std::string last;
  find_critical_stiffness(experiment, [&](const std::string& phase, std::int64_t, std::int64_t) {
    last = phase;
    return true;
  });
  EXPECT_NE(last.find("trial 5, clean to 15"), std::string::npos) << last;
  EXPECT_THROW(find_critical_stiffness(experiment,
                                       [](const std::string&, std::int64_t, std::int64_t) { return false; }),
               Interrupted);
}

TEST(StabilitySearch, OpenLoopIsRefused) {
  EXPECT_THROW(search({"/loop/kind=open"}), UsageError);
}

TEST(StabilitySearch, JsonHasTheContractsNamesAndTheTap) {
  StabilityRow row;
  row.method = "certified";
  const auto json = nlohmann::json::parse(stability_json({row}));
  const std::vector<std::string> names{"method",
                                       "profile",
                                       "delay_frames",
                                       "servo_rate_hz",
                                       "mass_kg",
                                       "damping_n_s_per_m",
                                       "critical_stiffness_n_per_m",
                                       "exact_n_per_m",
                                       "bound_n_per_m",
                                       "clean_until",
                                       "tap_m",
                                       "trials"};
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0].size(), names.size());
  for (const std::string& name : names) EXPECT_TRUE(json[0].contains(name)) << name;
  EXPECT_TRUE(json[0]["critical_stiffness_n_per_m"].is_null()) << "what was not found is null";
}

}  // namespace
}  // namespace lmdbench
