// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

#include <filesystem>

#include "base/read_file.hpp"

namespace boxstream::scenes {
namespace {

namespace fs = std::filesystem;

fs::path beside(const Node& node) {
  const std::string folder = folder_of(node);
  const fs::path path = fs::path(folder) / node.text();
  if (!files::is_below(folder, path.string())) node.fail("outside of the scene's folder: " + path.string());
  return path;
}

}  // namespace

std::string folder_of(const Node& node) {
  const fs::path folder = fs::path(node.file()).parent_path();
  return folder.empty() ? "." : folder.string();
}

std::string file_beside(const Node& file) {
  const fs::path path = beside(file);
  std::error_code missing;
  if (!fs::is_regular_file(path, missing)) file.fail("no such file: " + path.string());
  return path.string();
}

std::string folder_beside(const Node& folder) {
  const fs::path path = beside(folder);
  std::error_code missing;
  if (!fs::is_directory(path, missing)) folder.fail("no such folder: " + path.string());
  return path.string();
}

}  // namespace boxstream::scenes
