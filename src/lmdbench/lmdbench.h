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

/// The installed library (`find_package(lmdbench)`, target `lmdbench::lmdbench`): two meshes, a method by its name, a pose,
/// and the set of local minimum distance pairs there. This header and those that it includes are the whole interface;
/// what stands in it keeps its meaning within a minor version. Lengths are metres, in the meshes' own coordinates.
///
///     const lmdbench::PreparedMesh peg("peg.off");
///     const lmdbench::PreparedMesh hole("hole.stl");
///     lmdbench::LmdSearch search(peg, hole, 0.002);
///     for (const lmdbench::Lmd& lmd : search.at(X_WM)) ...
namespace lmdbench {

class Body;

/// A mesh made ready for searches: immutable, cheap to copy, shared by any number of searches and threads. What a
/// method prepares beyond that (a hierarchy) is made once, by the first search that needs it.
class PreparedMesh {
 public:
  /// Reads a mesh file: OFF; PLY, OBJ, STL and glTF 2 where the library was built with assimp (component `formats`).
  /// Vertices of one position are welded and those without triangles left out, as `lmdbench query` does: indices of
  /// features count the vertices and triangles of `mesh()`.
  /// @param planar_tolerance how far vertices of one plane may have left it, and are put back into it: "auto" (what
  ///                         single-precision coordinates leave, nothing for others), "off", metres ("1e-6"), or a
  ///                         share of the diagonal ("0.0001%")
  /// @throws InputError for a file that is missing or no mesh, UsageError for a tolerance that is none
  explicit PreparedMesh(const std::filesystem::path& file, const std::string& planar_tolerance = "auto");

  /// Takes a mesh from memory as it is: vertices and triangles keep their numbers, so that indices of features count the
  /// caller's. Corners that are to be one vertex must be one. Planes are put back as above.
  /// @param name of the mesh, for messages
  /// @throws InputError naming the vertex or triangle: no triangle, an index out of range, a coordinate that is not
  ///         finite or too large, more triangles than the limits allow
  explicit PreparedMesh(TriangleMesh mesh, const std::string& planar_tolerance = "auto",
                        const std::string& name = "mesh");

  const TriangleMesh& mesh() const;

  /// Corners (v, w), v < w, of the mesh's edges, in the order that a FeatureId of kind EDGE counts.
  std::vector<std::array<std::int32_t, 2>> edges() const;

  /// What a reader of its LMDs should know: open borders, triangles without area, and the like; one clause each.
  std::vector<std::string> findings() const;

  const std::shared_ptr<const Body>& body() const { return body_; }

 private:
  std::shared_ptr<const Body> body_;
};

/// Searches the LMDs of a pair of meshes with one method. Used by one thread at a time, since it keeps the method's scratch
/// memory; a copy of the meshes in another search costs nothing.
class LmdSearch {
 public:
  /// @param moving  frame M, placed by the pose
  /// @param fixed   in world coordinates
  /// @param cutoff  LMDs up to this distance, > 0 [m]
  /// @param method  a name of `method_names()`
  /// @param options of the method: a JSON object, such as {"visibility": "off"}; those left out keep their defaults
  /// @throws UsageError for a cutoff, method or option that is none; EnvironmentError for a method that the library was
  ///         built without
  LmdSearch(const PreparedMesh& moving, const PreparedMesh& fixed, double cutoff,
            const std::string& method = "certified", const std::string& options = "{}");

  /// The same with several fixed meshes; `Lmd::fixed_body` counts them.
  LmdSearch(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed, double cutoff,
            const std::string& method = "certified", const std::string& options = "{}");

  /// The same with fixed meshes in frames of their own: copies of one `PreparedMesh` share its memory, so that thousands of
  /// instances cost some 200 bytes each.
  /// @param X_WF pose of each fixed mesh in the world
  /// @throws UsageError also for another number of poses, and for one that is not finite or no rotation (a pose has no scale)
  LmdSearch(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed, const std::vector<Pose>& X_WF,
            double cutoff, const std::string& method = "certified", const std::string& options = "{}");
  ~LmdSearch();
  LmdSearch(LmdSearch&&) noexcept;
  LmdSearch& operator=(LmdSearch&&) noexcept;

  /// The LMD set of one pose, from scratch, in world coordinates, by rising distance. Empty beyond the cutoff.
  /// @param X_WM pose of the moving mesh; its quaternion has unit length
  /// @throws UsageError for a pose that is not finite or no rotation
  LmdSet at(const Pose& X_WM);

  double cutoff() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The methods of this build, in the order of reports. What they do: `lmdbench query --help`.
std::vector<std::string> method_names();

/// "0.1.0"
std::string library_version();

}  // namespace lmdbench
