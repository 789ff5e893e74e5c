// SPDX-License-Identifier: MIT
#include "source_path.hpp"

namespace boxstream::tests {

std::string source_path(std::string_view path) {
  return std::string(BOXSTREAM_SOURCES "/").append(path);
}

}  // namespace boxstream::tests
