// SPDX-License-Identifier: MIT
#include "view/shell.hpp"

namespace boxstream::view {

std::string_view shell() {
  return {};
}

}  // namespace boxstream::view
