// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/scene/instance_tree.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/mesh_pair.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lmdbench {

/// The LMD sets of several moving meshes. Objects are numbered: the movers first, then what stands.
struct MoverContacts {
  /// A pair of objects with an LMD.
  struct Pair {
    std::uint32_t mover = 0;           ///< Its points are `Lmd::point_moving`.
    std::uint32_t other = 0;           ///< A higher number than the mover's; also `Lmd::fixed_body`.
    std::size_t begin = 0, count = 0;  ///< In `lmds`.
  };
  std::vector<Pair> pairs;  ///< By mover, then by other.
  LmdSet lmds;              ///< World coordinates; those of a pair by `lmd_less`.

  std::span<const Lmd> of(const Pair& pair) const {
    return std::span<const Lmd>(lmds).subspan(pair.begin, pair.count);
  }
};

/// Several moving meshes, each against each other and against instances that stand: a pile, an assembly line. Any number of objects may
/// share a mesh.
///
/// Every mover has an *anchor*, a pose that it had, and around it a box that holds it as long as no point of it is farther than its *slack*
/// from where it was there, grown by half the reach. Movers whose boxes are apart are out of reach of each other, whatever they do within
/// their slack. The others are *candidates*, with the *room* that they had at their anchors; a frame looks at those whose room the motions of
/// both have used up, and asks a method of their own, in the frame of the mesh with the higher number. What leaves its slack is anchored
/// where it is, alone: its box, its candidates. So neither what is far nor what rests costs more than a comparison (PROOF.md, W4).
///
/// Of a pair the mover with the lower number is the moving mesh: numbers are names, and who numbers the movers otherwise swaps these roles
/// and with them roundings. The order of what stands and of the trees takes no part.
class MoverGroup {
 public:
  /// Swept by `lmdbench-study worlds --part pile-slack`.
  struct Tuning {
    double slack = 0.25;  ///< Over the mover's radius: less anchors more often, more has more candidates.
    double pack_share =
        0.1;  ///< Where more of the movers leave their slack in a frame, the tree is packed anew.
  };

  /// What frames cost.
  struct Work {
    std::uint64_t anchored = 0;        ///< Movers that left their slack.
    std::uint64_t pairs_touched = 0;   ///< Pairs whose bounds were placed, or whose room was found used up.
    std::uint64_t pairs_searched = 0;  ///< Pairs whose meshes were searched.
    WorkCounters of_methods;
  };

  /// @param make a method for a scene of two meshes, neither placed nor far from its origin, that searches in every frame
  ///             (`!tracks_locally`); methods/registry.h: `method_maker`
  MoverGroup(const std::vector<std::shared_ptr<const Body>>& movers, const std::vector<FixedBody>& standing,
             double cutoff, MeshPair::Make make)
      : MoverGroup(movers, standing, cutoff, std::move(make), Tuning{}) {}
  MoverGroup(const std::vector<std::shared_ptr<const Body>>& movers, const std::vector<FixedBody>& standing,
             double cutoff, MeshPair::Make make, const Tuning& tuning);

  /// Calls ask(mover, other, method, place) for each pair that may be within reach, by mover, then by other. Where a body has deformed since, everything is made anew.
  /// @param poses X_WM of each mover
  /// @param work  is added to
  /// @throws UsageError for another number of poses, and for one that is not finite or no rotation
  using Ask = std::function<void(std::uint32_t mover, std::uint32_t other, Method&, const PlacedPair& place)>;
  void for_each_near(std::span<const Pose> poses, Work& work, const Ask& ask);

  /// The sets of all pairs that have an LMD.
  void search(std::span<const Pose> poses, MoverContacts& contacts, Work& work);

  std::size_t mover_count() const { return mover_count_; }
  std::size_t object_count() const { return objects_.size(); }
  /// Pairs that are kept: those that motion within the slack can bring within reach.
  std::size_t candidate_count() const { return pairs_.size(); }
  /// Methods that were made: of pairs that are or were near.
  std::size_t method_count() const;

 private:
  struct Object {
    std::shared_ptr<const Body> body;
    const MeshBounds* bounds;
    const MeshOutline* outline;
    Pose anchor;
    Eigen::AlignedBox3d box;  ///< At the anchor.
    double slack = 0.0;       ///< [m]; 0 of what stands.
    double motion = 0.0;      ///< Since the anchor [m]; 0 of what stands.
  };
  struct Candidate {
    std::uint32_t mover, other;
    double room;                       ///< [m]
    bool by_outline = false;           ///< The room is what outlines tell.
    MeshPair* meshes = nullptr;        ///< Once the pair has been near.
    std::unique_ptr<Method> method{};  ///< Its own, where methods keep something.
  };

  void begin();
  void look_for_deformation();
  bool is_mover(std::uint32_t object) const { return object < mover_count_; }
  Eigen::AlignedBox3d grown_box(const Object& mover, double more) const;
  void anchor(std::span<const Pose> poses, Work& work);
  void find_candidates(std::uint32_t mover, Work& work);
  void merge_found();
  double rounding_of(const Object& a, const Object& b) const;
  double room_of(const Object& a, const Object& b) const;
  double room_by_outline(const Object& a, const Object& b) const;
  bool is_near(Candidate& candidate, Work& work) const;
  Method& method_of(Candidate& candidate);

  std::size_t mover_count_;
  double cutoff_, reach_ = 0.0;
  MeshPair::Make make_;
  Tuning tuning_;
  std::vector<Object> objects_;
  std::optional<InstanceTree> moving_tree_;  ///< Of the movers' grown boxes.
  std::optional<InstanceTree> standing_tree_;
  std::vector<Eigen::AlignedBox3d> grown_;  ///< One a mover: what the tree has.
  std::vector<bool> is_stale_;              ///< One a mover: it is anchored in this frame.
  std::vector<std::uint32_t> stale_;
  std::vector<Candidate> pairs_;  ///< By mover and other.
  std::vector<Candidate> found_, merged_;
  std::vector<std::uint32_t> touching_;
  std::map<std::pair<const Body*, const Body*>, MeshPair> meshes_;
  std::vector<std::shared_ptr<const Body>> bodies_;  ///< Each once.
  std::uint64_t deformations_ = 0;                   ///< Of all bodies, that are taken in.
  LmdSet lmds_;
};

}  // namespace lmdbench
