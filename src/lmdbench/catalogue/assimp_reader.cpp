// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/child_process.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/assimp_reader.h>
#include <lmdbench/catalogue/gltf_check.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <assimp/BaseImporter.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/Logger.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

constexpr const char* GLTF_REMEDY =
    "files beside a .gltf are not read: export as .glb, or with embedded buffers";
constexpr const char* FORMAT_REMEDY = "check that it is a mesh file; convert it to OFF, PLY, OBJ or STL";
constexpr const char* DAMAGED_REMEDY = "the file is damaged: get or export it again";

/// Name of their reader in assimp.
constexpr std::string_view READER = "glTF2 Importer";

// Keeps assimp silent and remembers its first error: several of its readers log one, guess at the
// data and go on.
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

// The logger is global in assimp: one import at a time, then the default logger again.
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

// Shows assimp one file in memory and nothing of the disk. Files that it refers to do not exist.
class OneFile final : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {}
  bool Exists(const char* file) const override { return name_ == file; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (!Exists(file) || std::string_view(mode).find('r') == std::string_view::npos) return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size(),
                                      false);
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::string_view bytes_;
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

  std::int64_t triangle_count() const {
    std::int64_t count = 0;
    for (unsigned int m = 0; m < scene_.mNumMeshes; ++m)
      count +=
          std::count_if(scene_.mMeshes[m]->mFaces, scene_.mMeshes[m]->mFaces + scene_.mMeshes[m]->mNumFaces,
                        [](const aiFace& face) { return face.mNumIndices == 3; });
    return count;
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

// Everything that the child does: from bytes to triangles.
TriangleMesh read_here(std::string_view bytes, std::string_view extension, const std::string& file) {
  const std::int64_t promised = check_gltf(bytes, file);
  const AssimpSession session;
  Assimp::Importer importer;
  std::vector<std::unique_ptr<Assimp::BaseImporter>> unused;
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string_view name = importer.GetImporterInfo(i)->mName;
    if (name == READER) continue;
    unused.emplace_back(importer.GetImporter(i));
    importer.UnregisterLoader(unused.back().get());
  }
  const std::string name = fmt::format("mesh.{}", extension);
  importer.SetIOHandler(new OneFile(name, bytes));  // owned by assimp from here on
  // No post-processing: it aborts the program where a reader left faces without corners (truncated
  // files), and its clean-up steps would drop or reorder triangles.
  const aiScene* scene = importer.ReadFile(name, 0);
  // It tells a limit of memory as an error of the file.
  const std::string error = importer.GetErrorString();
  const auto says = [&](const char* words) { return error.find(words) != std::string::npos; };
  if (scene == nullptr && says("bad_alloc")) throw std::bad_alloc();
  if (scene == nullptr)
    throw InputError(file, "", error, says("open referenced file") ? GLTF_REMEDY : FORMAT_REMEDY);
  if (!session.first_error().empty()) throw InputError(file, "", session.first_error(), DAMAGED_REMEDY);
  SceneMerger merger(*scene, file);
  merger.check_indices();
  // assimp drops those that name vertices which are not there.
  if (const std::int64_t kept = merger.triangle_count(); kept < promised)
    throw InputError(
        file, "",
        fmt::format("{} of {} triangles name vertices that are not there", promised - kept, promised),
        DAMAGED_REMEDY);
  return merger.merge();
}

// First bytes of the child; that many vertices and triangles, or characters, follow.
struct Answer {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t message_length = 0;  ///< 0 without an error
};

template <typename Item>
std::span<const std::byte> bytes_of(const std::vector<Item>& items) {
  return std::as_bytes(std::span<const Item>(items));
}

void answer(const ChildProcess::Send& send, std::string_view bytes, std::string_view extension,
            const std::string& file) {
  TriangleMesh mesh;
  std::string message;
  try {
    mesh = read_here(bytes, extension, file);
  } catch (const InputError& error) {
    message = error.what();
  }
  const Answer head{mesh.vertices.size(), mesh.triangles.size(), message.size()};
  send(std::as_bytes(std::span<const Answer>(&head, 1)));
  if (!message.empty()) return send(std::as_bytes(std::span<const char>(message)));
  send(bytes_of(mesh.vertices));
  send(bytes_of(mesh.triangles));
}

}  // namespace

TriangleMesh read_with_assimp(std::string_view bytes, std::string_view extension, const std::string& file) {
  const ChildLimits limits{limit_of(Limit::IMPORT_SECONDS), limit_of(Limit::IMPORT_BYTES)};
  ChildProcess child([&](const ChildProcess::Send& send) { answer(send, bytes, extension, file); }, limits);
  Answer head;
  TriangleMesh mesh;
  std::string message;
  bool complete = child.receive(std::as_writable_bytes(std::span<Answer>(&head, 1)));
  if (complete && head.triangles > static_cast<std::uint64_t>(limit_of(Limit::TRIANGLES)))
    throw InputError(
        file, "",
        fmt::format("has {} triangles, above the limit of {}", head.triangles, limit_of(Limit::TRIANGLES)),
        "decimate the mesh, or " + raise_remedy(Limit::TRIANGLES));
  if (complete) {
    mesh.vertices.resize(head.vertices);
    mesh.triangles.resize(head.triangles);
    message.resize(head.message_length);
    complete = child.receive(std::as_writable_bytes(std::span<char>(message))) &&
               child.receive(std::as_writable_bytes(std::span<Vec3>(mesh.vertices))) &&
               child.receive(std::as_writable_bytes(std::span<std::array<std::int32_t, 3>>(mesh.triangles)));
  }
  if (!complete)
    throw InputError(file, "", fmt::format("the process that reads it {}", child.end_in_words()),
                     fmt::format("the file is likely damaged: get or export it again; otherwise {}, or "
                                 "--limit import-bytes=NUMBER",
                                 raise_remedy(Limit::IMPORT_SECONDS)));
  // The child composed it, with place and remedy.
  if (!message.empty()) throw InputError("", "", message, "");
  return mesh;
}

}  // namespace lmdbench
