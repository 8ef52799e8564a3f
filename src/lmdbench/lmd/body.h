// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <typeindex>
#include <utility>

namespace lmdbench {

/// A mesh prepared for proximity queries: immutable, shared between methods, instances and
/// threads. What only some methods need (a hierarchy) is theirs: made when the first of them asks
/// for it, once, and kept beside the mesh.
class Body {
 public:
  Body(std::string name, Surface surface) : name_(std::move(name)), surface_(std::move(surface)) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const std::string& name() const { return name_; }
  const Surface& surface() const { return surface_; }

  /// What `T::of(*this)`, or else `T::of(surface())`, makes of the mesh, made at the first call and shared by
  /// all later ones, from any thread. A look-up costs a lock: methods ask once, when they are made, and keep
  /// the reference.
  template <class T>
  const T& prepared() const {
    Preparation& preparation = preparation_for(typeid(T));
    std::call_once(preparation.once, [&] {
      if constexpr (requires(const Body& body) { T::of(body); }) {
        preparation.value = std::make_shared<const T>(T::of(*this));  // It builds on other preparations.
      } else {
        preparation.value = std::make_shared<const T>(T::of(surface_));
      }
    });
    return *static_cast<const T*>(preparation.value.get());
  }

 private:
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
  mutable std::mutex mutex_;
  mutable std::map<std::type_index, Preparation> preparations_;
};

}  // namespace lmdbench
