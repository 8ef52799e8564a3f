// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/scene/scatter.h>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>
#include <study/worlds/broad_phases.h>
#include <study/worlds/heap.h>
#include <support/random.h>
#ifdef LMDBENCH_HAS_EMBREE
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>

namespace lmdbench::worlds {
namespace {

/// Shares of the cube's diagonal.
constexpr double CUTOFF = 0.005, STEP = 0.002;

using Boxes = std::vector<Eigen::AlignedBox3d>;
using Found = std::vector<std::uint32_t>;

/// Finds the boxes within reach of the moving one at a pose.
class Answers {
 public:
  virtual ~Answers() = default;
  virtual void near(const Pose& X_WM, Found& found) = 0;
};

struct Input {
  Scene scene;
  Boxes boxes;
  MeshBounds moving;
  double reach = 0.0;
  std::vector<Pose> way, jumps;

  bool within_reach(std::uint32_t instance, const Pose& X_WM) const {
    const Body& cube = *scene.moving;
    return within_distance(cube, cube, relative_pose(scene.fixed[instance].X_WF, X_WM), reach);
  }
  /// Box of the moving cube, grown by the reach.
  Eigen::AlignedBox3d asked(const Pose& X_WM) const {
    const Eigen::AlignedBox3d box = moving.placed(RigidTransform(X_WM));
    return {box.min() - Vec3::Constant(reach), box.max() + Vec3::Constant(reach)};
  }
};

Input make_input(std::size_t instances, std::size_t frames, std::uint64_t seed) {
  const auto cube = std::make_shared<const Body>("cube", build_surface(make_box({1.0, 1.0, 1.0})));
  Input input;
  input.moving = cube->prepared<MeshBounds>();
  const double diagonal = 2.0 * input.moving.radius;
  input.reach = CUTOFF * diagonal;
  input.scene = {cube, {}, input.reach};
  for (const Pose& pose : scatter({.rule = Scatter::Rule::RANDOM,
                          .count = static_cast<std::int64_t>(instances),
                          .spacing = 1.5,
                          .seed = seed},
                                  input.moving)) {
    input.scene.fixed.emplace_back(cube, pose);
    input.boxes.push_back(input.moving.placed(RigidTransform(pose)));
  }
  experiments::Random random(seed + 1);
  const double half = 0.5 * 1.5 * diagonal * std::cbrt(static_cast<double>(instances));
  Pose pose;
  Vec3 direction = random.direction();
  for (std::size_t i = 0; i < frames; ++i) {
    if (pose.translation.cwiseAbs().maxCoeff() > half) direction = -pose.translation.normalized();
    pose.translation += STEP * diagonal * direction;
    input.way.push_back(pose);
    Pose jump;
    jump.translation =
        Vec3(random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half));
    jump.rotation = random.rotation();
    input.jumps.push_back(jump);
  }
  return input;
}

class BruteForce : public Answers {
 public:
  explicit BruteForce(const Input& input) : input_(input) {
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis].resize(static_cast<Eigen::Index>(input.boxes.size()));
      high_[axis].resize(static_cast<Eigen::Index>(input.boxes.size()));
      for (std::size_t i = 0; i < input.boxes.size(); ++i) {
        low_[axis][static_cast<Eigen::Index>(i)] = input.boxes[i].min()[axis];
        high_[axis][static_cast<Eigen::Index>(i)] = input.boxes[i].max()[axis];
      }
    }
  }
  void near(const Pose& X_WM, Found& found) override {
    const Eigen::AlignedBox3d asked = input_.asked(X_WM);
    found.clear();
    gap_ = (low_[0] - asked.max()[0]).max(asked.min()[0] - high_[0]);
    for (int axis = 1; axis < 3; ++axis)
      gap_ = gap_.max(low_[axis] - asked.max()[axis]).max(asked.min()[axis] - high_[axis]);
    for (Eigen::Index i = 0; i < gap_.size(); ++i)
      if (gap_[i] <= 0.0) found.push_back(static_cast<std::uint32_t>(i));
  }

 private:
  const Input& input_;
  Eigen::ArrayXd low_[3], high_[3], gap_;
};

class Boost : public Answers {
 public:
  explicit Boost(const Input& input) : input_(input), tree_(input.boxes) {}
  void near(const Pose& X_WM, Found& found) override { tree_.touching(input_.asked(X_WM), found); }

 private:
  const Input& input_;
  InstanceTree tree_;
};

class Kept : public Answers {
 public:
  explicit Kept(const Input& input) : phase_(input.scene) {}
  void near(const Pose& X_WM, Found& found) override {
    BroadPhase::Work work;
    phase_.advance(X_WM, work);
    found.clear();
    phase_.for_each_near(work, [&](const BroadPhase::Candidate& near) { found.push_back(near.other - 1); });
  }

 private:
  BroadPhase phase_;
};

class Fcl : public Answers {
 public:
  explicit Fcl(const Input& input) : input_(input) {
    const auto shape = std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0);
    for (std::size_t i = 0; i < input.boxes.size(); ++i) {
      objects_.push_back(std::make_unique<fcl::CollisionObjectd>(shape));
      // Its own box: FCL would take the box of the sphere around what is turned.
      objects_.back()->setTranslation(input.boxes[i].center());
      const_cast<fcl::AABBd&>(objects_.back()->getAABB()) =
          fcl::AABBd(input.boxes[i].min(), input.boxes[i].max());
      objects_.back()->setUserData(reinterpret_cast<void*>(i));
    }
    std::vector<fcl::CollisionObjectd*> pointers;
    for (const auto& object : objects_) pointers.push_back(object.get());
    manager_.registerObjects(pointers);
    manager_.setup();
    asking_ = std::make_unique<fcl::CollisionObjectd>(shape);
  }
  void near(const Pose& X_WM, Found& found) override {
    const Eigen::AlignedBox3d asked = input_.asked(X_WM);
    const_cast<fcl::AABBd&>(asking_->getAABB()) = fcl::AABBd(asked.min(), asked.max());
    found.clear();
    manager_.collide(asking_.get(), &found, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd*, void* data) {
      static_cast<Found*>(data)->push_back(
          static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(a->getUserData())));
      return false;
    });
  }

 private:
  const Input& input_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  std::unique_ptr<fcl::CollisionObjectd> asking_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

#ifdef LMDBENCH_HAS_EMBREE
/// User-defined boxes, found by a point query around the moving cube's sphere.
class Embree : public Answers {
 public:
  explicit Embree(const Input& input) : input_(input), device_(rtcNewDevice("threads=1")) {
    scene_ = rtcNewScene(device_);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(input.boxes.size()));
    rtcSetGeometryUserData(geometry, const_cast<Boxes*>(&input.boxes));
    rtcSetGeometryBoundsFunction(
        geometry,
        [](const RTCBoundsFunctionArguments* arguments) {
          const auto& box = (*static_cast<const Boxes*>(arguments->geometryUserPtr))[arguments->primID];
          RTCBounds& bounds = *arguments->bounds_o;
          const Eigen::Vector3f low = box.min().cast<float>(), high = box.max().cast<float>();
          // Grown a little because of rounding to floats.
          const float more = 1e-5F * (low.norm() + high.norm());
          bounds.lower_x = low.x() - more, bounds.lower_y = low.y() - more, bounds.lower_z = low.z() - more;
          bounds.upper_x = high.x() + more, bounds.upper_y = high.y() + more,
          bounds.upper_z = high.z() + more;
        },
        nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  void near(const Pose& X_WM, Found& found) override {
    struct State {
      const Boxes& boxes;
      Eigen::AlignedBox3d asked;
      Found& found;
    } state{input_.boxes, input_.asked(X_WM), found};
    found.clear();
    const Vec3 centre = state.asked.center();
    RTCPointQuery query;
    query.x = static_cast<float>(centre.x());
    query.y = static_cast<float>(centre.y());
    query.z = static_cast<float>(centre.z());
    query.time = 0.0F;
    query.radius = static_cast<float>(state.asked.sizes().norm() * 0.5 * (1.0 + 1e-5));
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        scene_, &query, &context,
        [](RTCPointQueryFunctionArguments* arguments) {
          auto& of = *static_cast<State*>(arguments->userPtr);
          if (of.boxes[arguments->primID].intersects(of.asked)) of.found.push_back(arguments->primID);
          return false;
        },
        &state);
  }

 private:
  const Input& input_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};
#endif

double seconds_of(const std::function<void()>& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Peer {
  std::string name;
  std::function<std::unique_ptr<Answers>(const Input&)> make;
};

template <class Kind>
Peer peer(const char* name) {
  return {name, [](const Input& input) -> std::unique_ptr<Answers> { return std::make_unique<Kind>(input); }};
}

}  // namespace

std::vector<BroadPhaseRow> compare_broad_phases(std::size_t instances, std::size_t frames, std::size_t passes,
                                                std::uint64_t seed) {
  const Input input = make_input(instances, frames, seed);
  std::vector<Peer> peers{peer<Boost>("boost"), peer<Fcl>("fcl"), peer<BruteForce>("brute force"),
                          peer<Kept>("kept")};
#ifdef LMDBENCH_HAS_EMBREE
  peers.insert(peers.begin() + 2, peer<Embree>("embree"));
#endif
  std::vector<std::unique_ptr<Answers>> all;
  std::vector<BroadPhaseRow> rows;
  const double never = std::numeric_limits<double>::infinity();
  for (const Peer& one : peers) {
    BroadPhaseRow row{one.name, instances, never, 0.0, {}, {}, 0};
    for (int k = 0; k < 3; ++k) {
      std::unique_ptr<Answers> made;
      const double before = heap_in_use();
      row.build_seconds = std::min(row.build_seconds, seconds_of([&] { made = one.make(input); }));
      row.bytes = (heap_in_use() - before) / static_cast<double>(instances);
      if (k == 2) all.push_back(std::move(made));
    }
    row.seconds.assign(frames, never);
    row.jump_seconds.assign(frames, never);
    rows.push_back(std::move(row));
  }
  Found truth, found;
  BruteForce looks_at_all(input);
  for (std::size_t pass = 0; pass < passes; ++pass)
    for (const bool jumping : {false, true}) {
      const std::vector<Pose>& poses = jumping ? input.jumps : input.way;
      for (std::size_t i = 0; i < frames; ++i) {
        looks_at_all.near(poses[i], truth);
        for (std::size_t k = 0; k < all.size(); ++k) {
          const std::size_t at = (k + i + pass) % all.size();
          double& seconds = (jumping ? rows[at].jump_seconds : rows[at].seconds)[i];
          seconds = std::min(seconds, seconds_of([&] { all[at]->near(poses[i], found); }));
          std::sort(found.begin(), found.end());
          // Some test more than boxes: only instances whose cube is within reach must be found.
          const bool complete = std::all_of(truth.begin(), truth.end(), [&](std::uint32_t t) {
            return std::binary_search(found.begin(), found.end(), t) || !input.within_reach(t, poses[i]);
          });
          rows[at].wrong += complete ? 0 : 1;
        }
      }
    }
  return rows;
}

SlackRow measure_slack(double slack, std::size_t instances, std::size_t frames, std::size_t passes,
                       std::uint64_t seed) {
  const Input input = make_input(instances, frames, seed);
  SlackRow row{slack, 0.0, 0.0, std::numeric_limits<double>::infinity()};
  for (std::size_t pass = 0; pass < passes; ++pass) {
    BroadPhase phase(std::make_shared<const Scene>(input.scene), {.slack = slack});
    BroadPhase::Work work;
    const double seconds = seconds_of([&] {
      for (const Pose& pose : input.way) {
        phase.advance(pose, work);
        phase.for_each_near(work, [](const BroadPhase::Candidate&) {});
      }
    });
    row.seconds = std::min(row.seconds, seconds / static_cast<double>(frames));
    row.queries = static_cast<double>(work.queries) / static_cast<double>(frames);
    row.touched = static_cast<double>(work.touched) / static_cast<double>(frames);
  }
  return row;
}

}  // namespace lmdbench::worlds
