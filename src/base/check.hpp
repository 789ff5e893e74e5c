// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace boxstream::detail {

/// Of an invariant.
inline void check(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace boxstream::detail
