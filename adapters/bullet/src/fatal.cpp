// SPDX-License-Identifier: MIT
#include "fatal.hpp"

#include <cstdio>
#include <cstdlib>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

void fatal(const char* reason) {
  std::fprintf(stderr, "boxstream::bullet: %s\n", reason);
  std::abort();
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
