// SPDX-License-Identifier: MIT
#include "formats/import/one_line.hpp"

#include "base/printable.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::imports {

void fail(const std::string& file, const std::string& reason) {
  // Readers like to end their messages with a line break.
  const std::size_t end = reason.find_last_not_of(" \n\r\t");
  throw scenes::SceneError(files::printable(file + ": " + reason.substr(0, end == std::string::npos ? 0 : end + 1)));
}

}  // namespace boxstream::imports
