// SPDX-License-Identifier: MIT
#include "formats/import/file_kind.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "base/read_file.hpp"
#include "base/words.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::imports {

std::string file_kind(const std::string& path) {
  std::string kind = std::filesystem::path(path).extension().string();
  if (!kind.empty()) kind.erase(0, 1);
  for (char& c : kind)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return kind;
}

void fail(const std::string& file, const std::string& reason) {
  // Readers like to end their messages with a line break.
  const std::size_t end = reason.find_last_not_of(" \n\r\t");
  throw scenes::SceneError(files::printable(file + ": " + reason.substr(0, end == std::string::npos ? 0 : end + 1)));
}

void check_is_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) fail(path, "no such file");
  if (std::filesystem::file_size(path, error) > (std::uintmax_t{512} << 20)) fail(path, "larger than 512 MiB");
  if (access(path.c_str(), R_OK) != 0) fail(path, std::string("cannot be read: ") + std::strerror(errno));
  files::note_read(path);
}

}  // namespace boxstream::imports
