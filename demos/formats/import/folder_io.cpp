// SPDX-License-Identifier: MIT
#include "formats/import/folder_io.hpp"

#include "base/is_below.hpp"
#include "formats/import/file_kind.hpp"

namespace boxstream::imports {
namespace {

namespace fs = std::filesystem;

/// Empty if there is none.
fs::path canonical(const std::string& name) {
  std::error_code error;
  const fs::path place = fs::canonical(name, error);
  return error ? fs::path() : place;
}

}  // namespace

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

}  // namespace boxstream::imports
