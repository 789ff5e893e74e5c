// SPDX-License-Identifier: MIT
#include "formats/import/mesh_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "base/read_file.hpp"
#include "formats/import/file_kind.hpp"

namespace boxstream::imports {
namespace {

/// Lets assimp open one file, and beside it what lies in its folder or below, wherever names and symbolic links lead:
/// files of others may name any file of the machine.
class FolderIo final : public Assimp::DefaultIOSystem {
 public:
  explicit FolderIo(const std::string& file);

  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* name, const char* mode) override;

  /// The first file outside that was requested; empty: none.
  const std::string& refused() const { return refused_; }

 private:
  bool may_open(const std::string& name) const;

  std::string folder_;
  std::filesystem::path file_;
  mutable std::string refused_;
};

namespace fs = std::filesystem;

/// Empty if there is none.
fs::path canonical(const std::string& name) {
  std::error_code error;
  const fs::path place = fs::canonical(name, error);
  return error ? fs::path() : place;
}

FolderIo::FolderIo(const std::string& file)
    : folder_(fs::absolute(file).parent_path().string()), file_(canonical(file)) {}

bool FolderIo::may_open(const std::string& name) const {
  const fs::path place = canonical(name);
  if (!place.empty() && (place == file_ || files::is_below(folder_, name))) return true;
  if (!place.empty() && refused_.empty()) refused_ = name;
  return false;
}

bool FolderIo::Exists(const char* name) const {
  return may_open(name) && DefaultIOSystem::Exists(name);
}

Assimp::IOStream* FolderIo::Open(const char* name, const char* mode) {
  if (!may_open(name)) return nullptr;
  check_is_file(name);
  return DefaultIOSystem::Open(name, mode);
}

/// Otherwise some forty other readers would try a file that the one for its kind refuses.
void keep_readers_of(const std::string& kind, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::istringstream kinds(importer.GetImporterInfo(i)->mFileExtensions);
    const std::istream_iterator<std::string> first(kinds), last;
    if (std::find(first, last, kind) == last) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

}  // namespace

RawMesh read_by_assimp(const std::string& path, UpAxis up) {
  auto* const io = new FolderIo(path);
  Assimp::Importer importer;
  importer.SetIOHandler(io);  // which owns it
  keep_readers_of(file_kind(path), importer);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, up == UpAxis::left_alone);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* const scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr && !io->refused().empty())
    throw std::runtime_error("names a file outside of its folder: " + io->refused());
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  RawMesh raw;
  std::uint32_t faces = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    const auto first = static_cast<std::uint32_t>(raw.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      raw.vertices.push_back({mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z});
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      raw.faces.push_back(faces++);
      const unsigned* const corner = face.mIndices;
      if (std::any_of(corner, corner + 3, [&](unsigned c) { return c >= mesh.mNumVertices; }))
        throw std::runtime_error("a triangle with a vertex that is not there");
      raw.triangles.push_back({first + corner[0], first + corner[1], first + corner[2]});
    }
  }
  return raw;
}

}  // namespace boxstream::imports
