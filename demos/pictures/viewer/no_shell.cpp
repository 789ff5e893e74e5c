// SPDX-License-Identifier: MIT
#include "pictures/viewer/shell.hpp"

namespace boxstream::view {

std::string_view shell() {
  return {};
}

std::string_view accuracy_shell() {
  return {};
}

}  // namespace boxstream::view
