// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/off_file.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/Logger.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <mutex>
#include <numeric>

namespace lmdbench {

namespace {

constexpr const char* FORMAT_REMEDY = "check that it is a mesh file; convert it to OFF, PLY, OBJ or STL";

// Keeps assimp silent and remembers its first complaint: several of its readers log an error, mend the data
// by guess and go on.
class ErrorCollector final : public Assimp::Logger {
 public:
  void OnDebug(const char*) override {}
  void OnVerboseDebug(const char*) override {}
  void OnInfo(const char*) override {}
  void OnWarn(const char*) override {}
  void OnError(const char* message) override {
    if (first_error_.empty()) first_error_ = message;
  }
  bool attachStream(Assimp::LogStream*, unsigned int) override { return true; }
  bool detachStream(Assimp::LogStream*, unsigned int) override { return true; }
  const std::string& first_error() const { return first_error_; }

 private:
  std::string first_error_;
};

// The logger is global in assimp: one import at a time, and it is put back.
class AssimpSession {
 public:
  AssimpSession() : lock_(mutex()) {
    logger_ = new ErrorCollector;  // owned by assimp from here on
    Assimp::DefaultLogger::set(logger_);
  }
  ~AssimpSession() { Assimp::DefaultLogger::kill(); }
  AssimpSession(const AssimpSession&) = delete;
  AssimpSession& operator=(const AssimpSession&) = delete;
  const std::string& first_error() const { return logger_->first_error(); }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
  ErrorCollector* logger_;
};

using Transform = Eigen::Matrix<double, 3, 4>;

Transform to_transform(const aiMatrix4x4& m) {
  Transform transform;
  transform << static_cast<double>(m.a1), m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return transform;
}

class SceneMerger {
 public:
  SceneMerger(const aiScene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

  // Before anything else of assimp works on the faces.
  void check_indices() const {
    for (unsigned int m = 0; m < scene_.mNumMeshes; ++m) {
      const aiMesh& mesh = *scene_.mMeshes[m];
      for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        for (unsigned int k = 0; k < face.mNumIndices; ++k)
          if (face.mIndices[k] >= mesh.mNumVertices)
            throw InputError(
                file_, place(m, "face", f),
                fmt::format("names vertex {}, but there are {} vertices",
                            static_cast<std::int64_t>(static_cast<std::int32_t>(face.mIndices[k])),
                            mesh.mNumVertices),
                "correct the index or export the mesh again");
      }
    }
  }

  bool has_polygons() const {
    for (unsigned int m = 0; m < scene_.mNumMeshes; ++m) {
      const aiMesh& mesh = *scene_.mMeshes[m];
      if (std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                      [](const aiFace& f) { return f.mNumIndices > 3; }))
        return true;
    }
    return false;
  }

  TriangleMesh merge() {
    if (scene_.mRootNode != nullptr) add_node(*scene_.mRootNode, aiMatrix4x4());
    return std::move(merged_);
  }

 private:
  std::string place(unsigned int mesh, const char* kind, std::size_t index) const {
    const std::string item = fmt::format("{} {}", kind, index);
    return scene_.mNumMeshes > 1 ? fmt::format("mesh {}, {}", mesh, item) : item;
  }

  void add_node(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned int i = 0; i < node.mNumMeshes; ++i) add_mesh(node.mMeshes[i], transform);
    for (unsigned int i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], transform);
  }

  void add_mesh(unsigned int number, const aiMatrix4x4& node_transform) {
    const aiMesh& mesh = *scene_.mMeshes[number];
    const bool moves = !(node_transform == aiMatrix4x4());
    const Transform transform = to_transform(node_transform);
    const bool mirrors = moves && transform.leftCols<3>().determinant() < 0.0;
    const auto first = static_cast<std::int32_t>(merged_.vertices.size());
    for (unsigned int v = 0; v < mesh.mNumVertices; ++v) {
      Vec3 vertex(mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z);
      if (moves) vertex = transform.leftCols<3>() * vertex + transform.col(3);
      merged_.vertices.push_back(vertex);
    }
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      std::array<std::int32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const unsigned int index = face.mIndices[k];
        corners[k] = first + static_cast<std::int32_t>(index);
        if (!merged_.vertices[static_cast<std::size_t>(corners[k])].allFinite())
          throw InputError(file_, place(number, "vertex", index), "has a coordinate that is not finite",
                           "correct or remove it");
      }
      if (mirrors) std::swap(corners[1], corners[2]);
      merged_.triangles.push_back(corners);
    }
  }

  const aiScene& scene_;
  std::string file_;
  TriangleMesh merged_;
};

TriangleMesh import_with_assimp(const std::filesystem::path& file) {
  const AssimpSession session;
  Assimp::Importer importer;
  // No post-processing yet: it ends the program by an assertion where a reader left faces without corners
  // (files cut short), and its clean-up steps would drop or reorder triangles.
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene == nullptr) throw InputError(file.string(), "", importer.GetErrorString(), FORMAT_REMEDY);
  if (!session.first_error().empty())
    throw InputError(file.string(), "", session.first_error(), "the file is damaged: get or export it again");
  SceneMerger(*scene, file.string()).check_indices();
  if (SceneMerger(*scene, file.string()).has_polygons()) {
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr || !session.first_error().empty())
      throw InputError(file.string(), "", fmt::format("polygons cannot be cut: {}", session.first_error()),
                       "triangulate the mesh where it was made");
  }
  return SceneMerger(*scene, file.string()).merge();
}

bool has_extension_off(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".off";
}

std::array<double, 3> position_key(const Vec3& p) {
  return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
}

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(position_key(mesh.vertices[a]), a) < std::pair(position_key(mesh.vertices[b]), b);
  });
  std::vector<std::size_t> first(count);  // first vertex at the same position
  for (std::size_t i = 0; i < count; ++i) {
    const bool same =
        i > 0 && position_key(mesh.vertices[order[i]]) == position_key(mesh.vertices[order[i - 1]]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  std::vector<bool> used(count, false);
  for (const auto& corners : mesh.triangles)
    for (const std::int32_t corner : corners) used[first[static_cast<std::size_t>(corner)]] = true;

  TriangleMesh result;
  std::vector<std::int32_t> number(count, -1);
  for (std::size_t v = 0; v < count; ++v) {
    if (!used[v]) continue;
    number[v] = static_cast<std::int32_t>(result.vertices.size());
    result.vertices.push_back(mesh.vertices[v]);
  }
  result.triangles = mesh.triangles;
  for (auto& corners : result.triangles)
    for (std::int32_t& corner : corners) corner = number[first[static_cast<std::size_t>(corner)]];
  return result;
}

TriangleMesh import_mesh(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw InputError(file.string(), "", "there is no such mesh file", "check the name");
  if (std::filesystem::is_directory(status))
    throw InputError(file.string(), "", "is a directory, not a mesh file", "name a file");
  std::optional<TriangleMesh> mesh;
  if (has_extension_off(file)) mesh = read_off(file);
  if (!mesh) mesh = import_with_assimp(file);
  if (mesh->triangles.empty())
    throw InputError(file.string(), "", "holds no triangle",
                     "point clouds and lines have no surface: name a mesh");
  return welded(*mesh);
}

}  // namespace lmdbench
