// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Bullet's contact manifold: btGImpactMeshShape, its users' choice for moving concave meshes, with
// a collision margin, new at each pose. Our decisions: each margin is half the cutoff (the default
// of 4 cm suits scenes a metre wide): contacts begin where LMDs do; points within half a margin are
// one, as 2 cm is half of Bullet's default (its own 2 % of a mesh's size are many cutoffs here, in
// which the last point took the others' place, whatever its depth). "points" "four": those that
// btPersistentManifold keeps a pair of objects; "all": before that reduction. Bullet's points lie
// on a clipped triangle of two moved by margins: each pair of triangles is a contact once, at its
// exact nearest points. Double precision if Bullet has it.
#include "closest.h"
#include "plugin.hpp"
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <set>
#include <utility>

namespace {

using namespace rivals;

struct Shape {
  btTriangleMesh triangles{true, false};
  std::unique_ptr<btGImpactMeshShape> shape;
  btCollisionObject object;

  Shape(const Mesh& mesh, double margin) {
    const auto vector = [](const Point& p) {
      return btVector3(static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2]));
    };
    triangles.preallocateVertices(static_cast<int>(3 * mesh.triangles.size()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      triangles.addTriangle(vector(mesh.corner(t, 0)), vector(mesh.corner(t, 1)), vector(mesh.corner(t, 2)));
    shape = std::make_unique<btGImpactMeshShape>(&triangles);
    shape->setMargin(static_cast<btScalar>(margin));
    shape->updateBound();
    object.setCollisionShape(shape.get());
  }
};

/// The pairs of triangles that touch within their margins, before the reduction.
class AllPairs : public btManifoldResult {
 public:
  using btManifoldResult::btManifoldResult;
  void addContactPoint(const btVector3&, const btVector3&, btScalar) override {
    pairs.emplace(m_index0, m_index1);
  }
  std::set<std::pair<int, int>> pairs;
};

struct Dispatcher : btCollisionDispatcher {
  btScalar merge_distance;
  Dispatcher(btCollisionConfiguration* configuration, double distance)
      : btCollisionDispatcher(configuration), merge_distance(static_cast<btScalar>(distance)) {}
  btPersistentManifold* getNewManifold(const btCollisionObject* a, const btCollisionObject* b) override {
    btPersistentManifold* manifold = btCollisionDispatcher::getNewManifold(a, b);
    manifold->setContactBreakingThreshold(merge_distance);
    return manifold;
  }
};

class Manifold {
 public:
  Manifold(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& options)
      : kept_(std::make_unique<Kept>(a, b, cutoff)),
        cutoff_(cutoff),
        all_(nlohmann::json::parse(options).at("points") == "all") {}

  void search(const double* X_BA, std::vector<lmdbench_contact>& contacts) {
    Kept& k = *kept_;
    const auto at = [&](std::size_t i) { return static_cast<btScalar>(X_BA[i]); };
    k.shape_a.object.setWorldTransform(
        btTransform(btMatrix3x3(at(0), at(1), at(2), at(4), at(5), at(6), at(8), at(9), at(10)),
                    btVector3(at(3), at(7), at(11))));
    const Transform X{X_BA};
    std::vector<Found> found_here;
    for (const auto& [t_a, t_b] : touching()) {
      const auto a = static_cast<std::size_t>(t_a), b = static_cast<std::size_t>(t_b);
      Point p{}, q{};
      closest_of_triangles({X(k.a.corner(a, 0)), X(k.a.corner(a, 1)), X(k.a.corner(a, 2))},
                           {k.b.corner(b, 0), k.b.corner(b, 1), k.b.corner(b, 2)}, p, q);
      if (distance(p, q) <= cutoff_)
        found_here.push_back(found(p, q, t_a, LMDBENCH_PART_UNKNOWN, t_b, LMDBENCH_PART_UNKNOWN));
    }
    hand_over(found_here, contacts);
  }

 private:
  struct Kept {
    Mesh a, b;
    Shape shape_a, shape_b;
    btDefaultCollisionConfiguration configuration;
    Dispatcher dispatcher;
    Kept(const lmdbench_mesh& of_a, const lmdbench_mesh& of_b, double cutoff)
        : a(of_a),
          b(of_b),
          shape_a(a, 0.5 * cutoff),
          shape_b(b, 0.5 * cutoff),
          dispatcher(&configuration, 0.25 * cutoff) {
      btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
    }
  };

  std::set<std::pair<int, int>> touching() {
    Kept& k = *kept_;
    const btCollisionObjectWrapper a(nullptr, k.shape_a.shape.get(), &k.shape_a.object,
                                     k.shape_a.object.getWorldTransform(), -1, -1),
        b(nullptr, k.shape_b.shape.get(), &k.shape_b.object, k.shape_b.object.getWorldTransform(), -1, -1);
    btCollisionAlgorithm* algorithm =
        k.dispatcher.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    AllPairs every(&a, &b);
    btManifoldResult kept(&a, &b);
    algorithm->processCollision(&a, &b, btDispatcherInfo(), all_ ? &every : &kept);
    btManifoldArray manifolds;
    algorithm->getAllContactManifolds(manifolds);
    for (int i = 0; i < manifolds.size(); ++i)
      for (int c = 0; c < manifolds[i]->getNumContacts(); ++c) {
        const btManifoldPoint& point = manifolds[i]->getContactPoint(c);
        const bool turned = manifolds[i]->getBody0() != &k.shape_a.object;
        every.pairs.emplace(turned ? point.m_index1 : point.m_index0,
                            turned ? point.m_index0 : point.m_index1);
      }
    algorithm->~btCollisionAlgorithm();
    k.dispatcher.freeCollisionAlgorithm(algorithm);
    return std::move(every.pairs);
  }

  std::unique_ptr<Kept> kept_;
  double cutoff_;
  bool all_;
};

constexpr lmdbench_method METHOD = plugin::Functions<Manifold>::described(
    "manifold", "2", "Bullet's contact manifold of two GImpact meshes with a margin",
    LMDBENCH_PROMISE_APPROXIMATION,
    R"({"points": {"enum": ["four", "all"], "default": "four",
        "description": "those that Bullet's manifold keeps, or all before"}})");

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
