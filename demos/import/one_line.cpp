// SPDX-License-Identifier: MIT
#include "import/one_line.hpp"

#include "scene/scene_error.hpp"

namespace boxstream::imports {

void fail(const std::string& file, const std::string& reason) {
  static const char digits[] = "0123456789abcdef";
  // Readers like to end their messages with a line break.
  const std::size_t end = reason.find_last_not_of(" \n\r\t");
  std::string line;
  for (const char c : file + ": " + reason.substr(0, end == std::string::npos ? 0 : end + 1)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f)
      line += c;
    else
      (line += "\\x") += {digits[code >> 4], digits[code & 15]};
  }
  throw scenes::SceneError(line);
}

}  // namespace boxstream::imports
