// SPDX-License-Identifier: MIT
#include "pictures/viewer/shell.hpp"

namespace boxstream::view {

std::string_view shell() {
  return {};
}

}  // namespace boxstream::view
