// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/stability/stability_trial.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace lmdbench {
namespace {

constexpr std::int64_t BLOCK_FRAMES = 256;  ///< Between checks for the end.
constexpr int CYCLES = SKIPPED_CYCLES + 2 * WINDOW_CYCLES;

constexpr int REST_STEPS = 64;  ///< Steps over a cutoff to find the pose under the push.
constexpr int REST_BITS = 30;   ///< Precision of that pose.

constexpr double SLOPE_STEP = 1e-4;   ///< Half the base of a central difference, in cutoffs, ...
constexpr double SLOPE_SHARE = 0.05;  ///< ... at most this share of the contact's range.
constexpr double SLOPE_CHANGE = 0.1;  ///< Of differences to both sides that are of one slope.

/// Stands for a swing that died down or escaped: ten times the amplitude a window.
constexpr double DECIDED_GROWTH = std::numbers::ln10;

/// The contact at rest, and the tap for it.
struct Rest {
  bool friction = false;  ///< The rules of friction apply, ...
  bool counts = false;    ///< ... or encoders count: it may rest elsewhere.
  Pose pose;
  RenderedForce rendered;
  Vec3 lever_W = Vec3::Zero();     ///< From the device's point to the watched one.
  double natural_frequency = 0.0;  ///< [rad/s] of device and rigid hand on that stiffness.
  double mass_share = 1.0;         ///< Felt mass at the watched point over the translation's, ...
  double inertia_ratio = 0.0;      ///< ... and over the inertia of the turn [1/m^2].
  double tap_m = 0.0;              ///< Swing of the tap on that stiffness alone.
  double range_m = 0.0;            ///< From rest to the contact's end or saturation.
};

/// Shared by a trial's pose source and its owner.
struct TrialState {
  Swing swing;
  std::optional<double> decided;  ///< Growth, where it needs no measurement.
  bool limit_cycle = false;
  bool over = false;
};

/// Holds the device, releases it with a tap and watches it.
class TrialPoses final : public PoseSource {
 public:
  TrialPoses(const LoopChoice& loop, const Rest& rest, const Vec3& reference_M, double period,
             std::int64_t hold_frames, std::shared_ptr<TrialState> state)
      : rest_(rest),
        direction_W_(rest.rendered.force.normalized()),
        natural_period_frames_(2.0 * std::numbers::pi / (rest.natural_frequency * period)),
        hold_frames_(hold_frames),
        state_(std::move(state)),
        pose_(rest.pose),
        mesh_(loop, period, rest.pose, reference_M, -rest.rendered.force, -rest.rendered.torque),
        held_at_W_(mesh_.held_position()),
        under_way_(static_cast<std::size_t>(loop.delay_frames), rest.rendered) {
    state_->swing.period_s = period;
    state_->swing.resolution_m = loop.resolution_m;
    const Vec3 speed_W = rest.tap_m * rest.natural_frequency * direction_W_;
    mesh_.strike(rest.mass_share * speed_W, rest.inertia_ratio * rest.lever_W.cross(speed_W));
  }

  const Pose& pose() const override { return pose_; }

  std::optional<LoopFrame> render(const RenderedForce& rendered) override {
    if (hold_frames_-- > 0) return std::nullopt;
    under_way_.push_back(rendered);
    watch();
    mesh_.advance(under_way_.front(), rest_.pose);
    under_way_.pop_front();
    pose_ = mesh_.sensed_pose();
    return std::nullopt;
  }

 private:
  void watch() {
    Swing& swing = state_->swing;
    swing.position_W.push_back(mesh_.held_position() - held_at_W_ + mesh_.turn().cross(rest_.lever_W));
    swing.velocity_W.push_back(mesh_.held_velocity() + mesh_.angular_velocity().cross(rest_.lever_W));
    swing.force_W.push_back(under_way_.front().force - rest_.rendered.force);
    const double way = swing.position_W.back().norm();
    const double speed = swing.velocity_W.back().dot(direction_W_);
    if (speed * last_speed_ < 0.0) ++sign_changes_;
    if (speed != 0.0) last_speed_ = speed;
    const auto frames = static_cast<double>(swing.position_W.size());
    // With friction or counts the device may stop away from its place of rest.
    const bool away = !rest_.friction && !rest_.counts && way > DEAD_SHARE * rest_.tap_m;
    const double any_speed = rest_.friction ? swing.velocity_W.back().norm() : std::abs(speed);
    if (away || any_speed > DEAD_SHARE * rest_.tap_m * rest_.natural_frequency) last_lively_ = frames;
    if (way > ESCAPED_SHARE * rest_.range_m) state_->decided = DECIDED_GROWTH;
    if (frames - last_lively_ > natural_period_frames_ + static_cast<double>(under_way_.size()))
      state_->decided = -DECIDED_GROWTH;
    state_->over = state_->decided || sign_changes_ >= 2 * CYCLES * rounds_;
    if (rest_.friction && state_->over && !state_->decided) look_whether_it_ends();
  }

  /// After a round of oscillations under friction: does it grow, persist, or perhaps die down?
  void look_whether_it_ends() {
    const Cleanliness judged = judge(state_->swing);
    if (judged.amplitude_m < state_->swing.resolution_m) return;  // within the counts
    const double growth = judged.growth;
    if (std::abs(growth) <= SUSTAINED_GROWTH) {
      state_->limit_cycle = true;
      state_->decided = DECIDED_GROWTH;
    }
    if (growth >= -SUSTAINED_GROWTH || rounds_ >= MOST_ROUNDS) return;
    rounds_ *= 2;
    state_->over = false;
  }

  Rest rest_;
  Vec3 direction_W_;
  double natural_period_frames_;
  std::int64_t hold_frames_;
  std::shared_ptr<TrialState> state_;
  Pose pose_;
  HeldMesh mesh_;
  Vec3 held_at_W_;  ///< Place of rest of the device's point.
  std::deque<RenderedForce> under_way_;
  double last_speed_ = 0.0;
  std::int64_t sign_changes_ = 0;
  std::int64_t rounds_ = 1;
  double last_lively_ = 0.0;
};

/// The last of the frames with the method held at a pose; its distance is that of the held mesh,
/// not of all that could move.
FrameRecord held_at(const Pose& X_WM, DriverInput held, const DrivenMethod& method,
                    const DriverChoice& driver, const Progress& progress) {
  held.poses.front() = X_WM;
  const Scene& scene = method.scene;
  if (scene.several_move()) held.keep_lmds = [](std::int64_t) { return true; };
  const MethodRecord record = run_lockstep({method}, held, driver, progress).front();
  FrameRecord last = record.frames.back();
  if (!scene.several_move()) return last;
  LmdSet own = record.lmds.rbegin()->second;
  std::erase_if(own, [&](const Lmd& lmd) {
    const ObjectPair pair = ObjectPair::of(lmd.fixed_body, scene);
    return pair.mover != scene.held && pair.other != scene.held;
  });
  last.minimum_distance = minimum_distance(own);
  return last;
}

/// The force's slope along itself, by central difference. Where the method's set changes within the
/// step, so that the differences to both sides are unlike, that of the set at rest: K_eff.
double slope_along(const FrameRecord& at_rest, const Pose& X_WM,
                   const std::function<FrameRecord(const Pose&)>& held, double step) {
  const double force = at_rest.force.norm();
  if (force == 0.0) return 0.0;
  const Vec3 along_W = at_rest.force / force;
  const auto force_at = [&](double way) {
    Pose moved = X_WM;
    moved.translation += way * along_W;
    return held(moved).force.dot(along_W);
  };
  const double towards = (force_at(-step) - force) / step, away = (force - force_at(step)) / step;
  const bool is_smooth =
      std::abs(towards - away) <= SLOPE_CHANGE * std::max(std::abs(towards), std::abs(away));
  return is_smooth || std::isnan(at_rest.effective_stiffness) ? 0.5 * (towards + away)
                                                              : at_rest.effective_stiffness;
}

/// Moves the pose along the push until the contact carries it: whole steps, then TOMS 748.
/// @param resists  set where the contact has some force against the push on the way
/// @return nothing where no pose within a cutoff of the first one does
std::optional<Pose> rest_under_push(const Pose& start, const Vec3& push_W,
                                    const std::function<FrameRecord(const Pose&)>& held, double cutoff,
                                    bool& resists) {
  const double load = push_W.norm();
  const Vec3 along_W = push_W / load;
  const auto pose_at = [&](double way) {
    Pose X_WM = start;
    X_WM.translation += way * along_W;
    return X_WM;
  };
  const auto excess = [&](double way) {
    const double against = -held(pose_at(way)).force.dot(along_W);
    resists = resists || against > 0.0;
    return against - load;
  };
  double there = 0.0;
  double excess_there = excess(there);
  const double step = (excess_there < 0.0 ? 1.0 : -1.0) * cutoff / REST_STEPS;
  for (int i = 0; i < REST_STEPS; ++i) {
    const double next = there + step;
    const double excess_next = excess(next);
    if ((excess_there < 0.0) != (excess_next < 0.0)) {
      const bool forward = step > 0.0;
      std::uintmax_t iterations = 100;
      const auto [low, high] = boost::math::tools::toms748_solve(
          excess, forward ? there : next, forward ? next : there, forward ? excess_there : excess_next,
          forward ? excess_next : excess_there, boost::math::tools::eps_tolerance<double>(REST_BITS),
          iterations);
      // The deeper end carries the push: the shallower one may be out of contact.
      return pose_at(high);
    }
    there = next;
    excess_there = excess_next;
  }
  return std::nullopt;
}

double moving_mass(const DeviceDynamics& dynamics) {
  const bool rigid_hand = dynamics.hand && !dynamics.hand->has_grip();
  return dynamics.mass_kg + (rigid_hand ? dynamics.hand->mass_kg : 0.0);
}

/// Friction against a motion along a direction: that of each axis times its share of the distance.
double felt_friction(const DeviceDynamics& dynamics, const Vec3& along) {
  return dynamics.friction_n * along.lpNorm<1>();
}

/// The distance within which friction holds the watched point against contact and hand springs.
double stiction_band(const LoopChoice& loop, const Rest& rest, double stiffness) {
  const Vec3 along_W = rest.rendered.force.normalized();
  double friction = felt_friction(loop.dynamics, along_W);
  const Vec3 turn_W = rest.lever_W.cross(along_W);
  if (loop.rotation && turn_W.norm() > 0.0)
    friction =
        std::max(friction, felt_friction(loop.rotation->dynamics, turn_W.normalized()) / turn_W.norm());
  const bool rigid_hand = loop.dynamics.hand && !loop.dynamics.hand->has_grip();
  return friction / (stiffness + (rigid_hand ? loop.dynamics.hand->stiffness_n_per_m : 0.0));
}

/// One count of the encoders at the watched point; 0 for exact ones.
double one_count(const LoopChoice& loop, const Rest& rest) {
  return std::max(loop.resolution_m,
                  loop.rotation ? loop.rotation->resolution_rad * rest.lever_W.norm() : 0.0);
}

}  // namespace

bool has_friction(const LoopChoice& loop) {
  return loop.dynamics.friction_n > 0.0 || (loop.rotation && loop.rotation->dynamics.friction_n > 0.0);
}

StabilityTrial try_stiffness(const Experiment& experiment, const DriverInput& input,
                             const DrivenMethod& method, const Progress& progress) {
  const LoopChoice& loop = experiment.loop;
  DriverChoice driver = experiment.driver;
  driver.repetitions = 1;
  driver.block_frames = BLOCK_FRAMES;
  // A method that searches in every frame has the contact at once.
  const bool searches_now_and_then = method.make()->description().tracks_locally;
  const std::int64_t hold_frames =
      searches_now_and_then ? driver.search_every_frames + driver.search_latency_frames + 1 : 1;
  DriverInput held = input;
  held.keep_lmds = nullptr;
  held.poses.resize(1);
  held.loop = {};
  held.frames = hold_frames;
  // The contact's own force and slope, which device and profile may clip.
  DrivenMethod unclipped = method;
  unclipped.profile.largest_sum = std::numeric_limits<double>::infinity();
  Device strong = input.device.device();
  strong.maximum_force.value = std::numeric_limits<double>::infinity();
  held.device = VirtualPhantom(strong);

  const auto at = [&](const Pose& X_WM) { return held_at(X_WM, held, unclipped, driver, progress); };

  StabilityTrial trial;
  if (!loop.push_n.isZero(0.0)) {
    const std::optional<Pose> pose =
        rest_under_push(held.poses.front(), loop.push_n, at, method.profile.cutoff, trial.in_contact);
    trial.carried = pose.has_value();
    if (!trial.carried) return trial;
    held.poses.front() = *pose;
  }
  const FrameRecord at_rest = at(held.poses.front());
  trial.force_at_rest_W = at_rest.force;
  Rest rest;
  rest.pose = held.poses.front();
  rest.rendered = input.device.render({at_rest.force, at_rest.torque, 0.0}, method.profile.largest_sum);
  if (!loop.rotation) rest.rendered.torque.setZero();
  trial.clipped = rest.rendered.clipped || (loop.rotation && rest.rendered.torque_clipped);
  rest.range_m = std::min(method.profile.cutoff - at_rest.minimum_distance,
                          at_rest.minimum_distance - method.profile.saturation_distance);
  // K_eff holds the directions of contacts; between corners and edges they turn as the mesh moves.
  const bool own_force = std::isnan(at_rest.effective_stiffness);
  const double step = SLOPE_STEP * method.profile.cutoff;
  trial.stiffness_n_per_m =
      slope_along(at_rest, held.poses.front(), at,
                  own_force || rest.range_m <= 0.0 ? step : std::min(step, SLOPE_SHARE * rest.range_m));
  if (own_force) rest.range_m = at_rest.force.norm() / trial.stiffness_n_per_m;
  trial.in_contact = trial.stiffness_n_per_m > 0.0 && at_rest.force.norm() > 0.0 && rest.range_m > 0.0;
  trial.saturated = !trial.in_contact && at_rest.minimum_distance <= method.profile.saturation_distance;
  trial.gives_way = !trial.in_contact && !trial.saturated && at_rest.force.norm() > 0.0;
  if (!trial.in_contact) return trial;
  double felt_mass = moving_mass(loop.dynamics);
  if (loop.rotation) {
    rest.lever_W = at_rest.force.cross(at_rest.torque) / at_rest.force.squaredNorm();
    trial.lever_m = rest.lever_W.norm();
    const double mass = felt_mass;
    const double inertia = moving_mass(loop.rotation->dynamics);
    felt_mass = 1.0 / (1.0 / mass + trial.lever_m * trial.lever_m / inertia);
    rest.mass_share = felt_mass / mass;
    rest.inertia_ratio = felt_mass / inertia;
  }
  if (trial.clipped) return trial;
  rest.natural_frequency = std::sqrt(trial.stiffness_n_per_m / felt_mass);
  rest.friction = has_friction(loop);
  rest.counts = loop.resolution_m > 0.0 || (loop.rotation && loop.rotation->resolution_rad > 0.0);
  const double count = one_count(loop, rest);
  const double largest_tap = FRICTION_TAP_SHARE * rest.range_m;
  rest.tap_m = trial.tap_m =
      rest.friction ? largest_tap
                    : std::min(std::max(TAP_SHARE * rest.range_m, TAP_COUNTS * count), largest_tap);
  if (rest.friction) {
    trial.stuck = rest.tap_m < STICTION_BANDS * stiction_band(loop, rest, trial.stiffness_n_per_m);
    if (trial.stuck) return trial;
  }
  trial.within_counts = rest.tap_m < LEAST_COUNTS * count;
  if (trial.within_counts) return trial;

  auto state = std::make_shared<TrialState>();
  DriverInput tapped = held;
  tapped.device = input.device;
  tapped.frames = hold_frames + (rest.friction ? MOST_FRICTION_FRAMES : MOST_SWING_FRAMES);
  tapped.make_poses = [&, state] {
    return std::make_unique<TrialPoses>(loop, rest, input.reference_M, 1.0 / input.frame_rate_hz, hold_frames,
                                        state);
  };
  bool asked_to_stop = false;
  try {
    run_lockstep({method}, tapped, driver, [&](std::int64_t done, std::int64_t total) {
      asked_to_stop = progress && !progress(done, total);
      return !asked_to_stop && !state->over;
    });
  } catch (const Interrupted&) {
    if (asked_to_stop) throw;
  }
  trial.frames = static_cast<std::int64_t>(state->swing.position_W.size());
  trial.outcome = judge(state->swing);
  trial.limit_cycle = state->limit_cycle;
  if (state->decided) trial.outcome.growth = *state->decided;
  return trial;
}

}  // namespace lmdbench
