// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// The installed library (`find_package(lmdbench)`, target `lmdbench::lmdbench`): the set of local
/// minimum distance pairs of two meshes in a pose, by a method given by name. This header and its
/// includes are the whole interface; it keeps its meaning within a major version. Lengths: metres.
///
///     const lmdbench::PreparedMesh peg("peg.off");
///     const lmdbench::PreparedMesh hole("hole.stl");
///     lmdbench::LmdSearch search(peg, hole, 0.002);
///     for (const lmdbench::Lmd& lmd : search.at(X_WM)) ...
namespace lmdbench {

class Body;

/// A mesh ready for searches: immutable, cheap to copy, shared by any number of searches and
/// threads. What else a method needs (a hierarchy) is made once, by the first such search.
class PreparedMesh {
 public:
  /// Reads a mesh file: OFF, PLY, OBJ, STL; with component `formats` (assimp) also glTF 2. Welds
  /// vertices of one position and drops those without triangles, as `lmdbench query` does: indices
  /// of features count the vertices and triangles of `mesh()`.
  /// @param planar_tolerance how far vertices may be off their plane and still be put back into
  ///        it: "auto" (rounding of single-precision coordinates; nothing for others), "off",
  ///        metres ("1e-6"), or a share of the diagonal ("0.0001%")
  /// @throws InputError for a missing file or one without a mesh, UsageError for a bad tolerance
  explicit PreparedMesh(const std::filesystem::path& file, const std::string& planar_tolerance = "auto");

  /// Takes a mesh from memory: indices of features count its vertices and triangles. Corners that
  /// are to be one vertex must be one. Vertices without triangles count for nothing: in `mesh()`
  /// they stand at a corner of a triangle. Planes are put back as above. A triangle without area
  /// that closes a T junction is flipped with the one beside it, one with a side as short as
  /// rounding collapses, and all keep their numbers: `mesh()` has their corners, `findings()` how
  /// many there were.
  /// @param name of the mesh, for messages
  /// @throws InputError naming the vertex or triangle: no triangle, an index out of range, a
  ///         coordinate that is not finite or too large, a planar tolerance that is no length, more
  ///         triangles than the limits allow
  explicit PreparedMesh(TriangleMesh mesh, const std::string& planar_tolerance = "auto",
                        const std::string& name = "mesh");

  const TriangleMesh& mesh() const;

  /// Corners (v, w), v < w, of the mesh's edges, in the order that a FeatureId of kind EDGE counts.
  std::vector<std::array<std::int32_t, 2>> edges() const;

  /// What weakens its LMDs: open borders, triangles without area, and the like, and how many were
  /// collapsed and flipped; one clause each.
  std::vector<std::string> findings() const;

  const std::shared_ptr<const Body>& body() const { return body_; }

 private:
  std::string repairs_;  ///< Before `body_`, which is made with it.
  std::shared_ptr<const Body> body_;
};

/// Searches the LMDs of a pair of meshes with one method. For one thread at a time, since it holds
/// the method's scratch memory; further searches share the meshes' memory. One that was moved from,
/// as a moved-from `PreparedMesh`, may only be destroyed or given another value.
class LmdSearch {
 public:
  /// @param moving  frame M, placed by the pose
  /// @param fixed   in world coordinates
  /// @param cutoff  LMDs up to this distance, > 0 [m]
  /// @param method  a name of `method_names()`
  /// @param options of the method: JSON object, e.g. {"visibility": "off"}; the rest is default
  /// @throws UsageError for a bad cutoff, method or option; EnvironmentError for a method that this
  ///         build of the library does not have
  LmdSearch(const PreparedMesh& moving, const PreparedMesh& fixed, double cutoff,
            const std::string& method = "certified", const std::string& options = "{}");

  /// The same with several fixed meshes; `Lmd::fixed_body` counts them.
  LmdSearch(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed, double cutoff,
            const std::string& method = "certified", const std::string& options = "{}");

  /// The same with fixed meshes in frames of their own. Copies of one `PreparedMesh` share its
  /// memory: thousands of instances cost some 200 bytes each.
  /// @param X_WF pose of each fixed mesh in the world
  /// @throws UsageError also for a wrong number of poses, and a pose not finite or no rotation
  LmdSearch(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed, const std::vector<Pose>& X_WF,
            double cutoff, const std::string& method = "certified", const std::string& options = "{}");
  ~LmdSearch();
  LmdSearch(LmdSearch&&) noexcept;
  LmdSearch& operator=(LmdSearch&&) noexcept;

  /// The LMD set of one pose: world coordinates, by rising distance. A method may reuse work of the
  /// last call; `certified` does not with the option {"frame_coherence": false}.
  /// @param X_WM pose of the moving mesh; its quaternion is brought to unit length
  /// @throws UsageError for a pose that is not finite or no rotation
  LmdSet at(const Pose& X_WM);

  double cutoff() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The methods of this build, in the order of reports. What they do: `lmdbench query --help`.
std::vector<std::string> method_names();

/// "1.0.0"
std::string library_version();

}  // namespace lmdbench
