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

/// A mesh prepared for proximity queries: shared between methods, instances and threads, and immutable but for `deform`. What
/// only some methods need (a hierarchy) is theirs: made when the first of them asks for it, once, and kept beside the mesh.
class Body {
 public:
  Body(std::string name, Surface surface) : name_(std::move(name)), surface_(std::move(surface)) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const std::string& name() const { return name_; }
  const Surface& surface() const { return surface_; }

  /// What `T::of(*this)`, or else `T::of(surface())`, makes of the mesh, made at the first call and shared by
  /// all later ones, from any thread. A look-up costs a lock: methods ask once, when they are made, and keep
  /// the reference, which stays valid: when the mesh deforms, `T::follow(*this, change)` or `T::follow(surface(), change)`
  /// is called, or where T has neither it is made anew in its place.
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

  /// Gives the mesh new vertices; its triangles stay. All that was prepared follows, what it builds on first. Nobody may
  /// read the body meanwhile. Methods on it, of `make_method`, find the set of the new mesh in their next search.
  ///
  /// A step costs by what moves. The first costs as much as preparing the mesh did, and so does one in which flat faces of several
  /// triangles form, bend or border on what moves; a step that moves nothing counts as the first.
  /// @param vertices one for each of the mesh's, in the mesh's frame [m]
  /// @return what changed, valid until the next call
  /// @throws InputError as check_moved_vertices; the body is as it was
  const SurfaceChange& deform(std::span<const Vec3> vertices) {
    check_moved_vertices(name_, surface_.mesh, vertices);
    if (!mover_) mover_.emplace(surface_);
    const SurfaceChange& change = mover_->move(vertices, surface_);
    ++deformations_;
    for (const auto& follow : followers_) follow(*this, change);
    return change;
  }
  /// How often the mesh was deformed.
  std::uint32_t deformations() const { return deformations_; }

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
  std::optional<SurfaceMover> mover_;
  std::uint32_t deformations_ = 0;
  mutable std::mutex mutex_;
  mutable std::map<std::type_index, Preparation> preparations_;
  /// What each preparation does when the mesh deforms, in the order in which they were finished: what one builds on stands before it.
  mutable std::vector<std::function<void(const Body&, const SurfaceChange&)>> followers_;
};

}  // namespace lmdbench
