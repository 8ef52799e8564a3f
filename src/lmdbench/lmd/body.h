// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/surface_change.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

namespace lmdbench {

/// A mesh prepared for proximity queries: shared between methods, instances and threads; immutable
/// except by `deform`. Preparations of some methods (a hierarchy) are made once, on demand.
class Body {
 public:
  /// @param diagonal  unset: of the surface's box; one that stands has it turned into the world
  Body(std::string name, Surface surface, std::optional<double> diagonal = std::nullopt)
      : name_(std::move(name)),
        surface_(std::move(surface)),
        diagonal_(diagonal ? *diagonal : bounding_box_diagonal(surface_.mesh)) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const std::string& name() const { return name_; }
  const Surface& surface() const { return surface_; }
  /// Of the mesh's box in its own frame, before it was placed or deformed [m]: however a scene is
  /// told, its sizes are the same.
  double diagonal() const { return diagonal_; }

  /// `T::of(*this)` or else `T::of(surface())`, made at the first call and shared by later ones,
  /// from any thread. A look-up costs a lock: methods ask once and keep the reference, which stays
  /// valid. When the mesh deforms, `T::follow(*this, change)` or `T::follow(surface(), change)` is
  /// called; a T without either is made anew in its place.
  template <class T>
  const T& prepared() const {
    Preparation& preparation = preparation_for(typeid(T));
    std::call_once(preparation.once, [&] {
      auto value = std::make_shared<T>(make<T>());
      preparation.value = value;
      const std::lock_guard lock(mutex_);
      followers_.emplace_back([value](const Body& body, const SurfaceChange& change) {
        if constexpr (requires { value->follow(body, change); })
          value->follow(body, change);
        else if constexpr (requires { value->follow(body.surface_, change); })
          value->follow(body.surface_, change);
        else if (!change.moved.empty())
          *value = body.make<T>();
      });
    });
    return *static_cast<const T*>(preparation.value.get());
  }

  /// Gives the mesh new vertices; its triangles stay. All preparations follow, each after those it
  /// builds on. Nobody may read the body meanwhile. Methods of `make_method` find the new set in
  /// their next search. A step costs by the moved part. The first costs as much as preparing the
  /// mesh, as does one in which flat faces of several triangles form, bend or border on moved ones;
  /// a step without motion counts as first.
  /// @param vertices one for each of the mesh's, in the mesh's frame [m]
  /// @return what changed, valid until the next call
  /// @throws InputError as check_moved_vertices; the body is as it was
  const SurfaceChange& deform(std::span<const Vec3> vertices) {
    check_moved_vertices(name_, surface_.mesh, vertices);
    if (!mover_) {
      mover_.emplace(surface_);
      box_at_rest_ = bounding_box(surface_.mesh);
    }
    const SurfaceChange& change = mover_->move(vertices, surface_);
    ++deformations_;
    for (const auto& follow : followers_) follow(*this, change);
    return change;
  }
  /// How often the mesh was deformed.
  std::uint32_t deformations() const { return deformations_; }
  /// Of the mesh before it was first deformed, in its frame [m].
  Eigen::AlignedBox3d box_at_rest() const {
    return deformations_ == 0 ? bounding_box(surface_.mesh) : box_at_rest_;
  }

 private:
  template <class T>
  T make() const {
    if constexpr (requires { T::of(*this); })
      return T::of(*this);  // It builds on other preparations.
    else
      return T::of(surface_);
  }
  struct Preparation {
    std::once_flag once;
    std::shared_ptr<const void> value;
  };
  Preparation& preparation_for(std::type_index type) const {
    const std::lock_guard lock(mutex_);
    return preparations_[type];  // A map's elements stay where they are when others are added.
  }

  std::string name_;
  Surface surface_;
  double diagonal_;
  std::optional<SurfaceMover> mover_;
  Eigen::AlignedBox3d box_at_rest_;  ///< Once the mesh was deformed.
  std::uint32_t deformations_ = 0;
  mutable std::mutex mutex_;
  mutable std::map<std::type_index, Preparation> preparations_;
  /// How each preparation follows a deformation, in the order in which they were finished.
  mutable std::vector<std::function<void(const Body&, const SurfaceChange&)>> followers_;
};

}  // namespace lmdbench
