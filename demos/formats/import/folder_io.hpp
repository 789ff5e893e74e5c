// SPDX-License-Identifier: MIT
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>

namespace boxstream::imports {

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

}  // namespace boxstream::imports
