// SPDX-License-Identifier: MIT
#include "boxstream/shared/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace boxstream::tool {

bool is_terminal(int descriptor) {
  const char* const kind = std::getenv("TERM");
  return isatty(descriptor) == 1 && kind && std::string_view(kind) != "dumb";
}

bool shows_colours(int descriptor) {
  const char* const unwanted = std::getenv("NO_COLOR");
  return is_terminal(descriptor) && (unwanted == nullptr || *unwanted == '\0');
}

}  // namespace boxstream::tool
