// SPDX-License-Identifier: MIT
#include "status.hpp"

#include <cstdio>

#include <boxstream/detector.hpp>
#include <boxstream/version.hpp>

namespace {
thread_local char error_text[256] = "";
}

namespace boxstream::c {

boxstream_status fail(boxstream_status status, const char* text) noexcept {
  std::snprintf(error_text, sizeof error_text, "%s", text);
  return status;
}

}  // namespace boxstream::c

const char* boxstream_error_text(void) {
  return error_text;
}

uint32_t boxstream_version(void) {
  return 10000 * BOXSTREAM_VERSION_MAJOR + 100 * BOXSTREAM_VERSION_MINOR + BOXSTREAM_VERSION_PATCH;
}

const char* boxstream_simd_target(void) {
  return boxstream::simd_target();
}
