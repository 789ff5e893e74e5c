// SPDX-License-Identifier: MIT
#include MAIN_HEADER

#include <boxstream/version.hpp>

static_assert(BOXSTREAM_VERSION_MAJOR == EXPECTED_MAJOR, "version.hpp and CMakeLists.txt differ");
static_assert(BOXSTREAM_VERSION_MINOR == EXPECTED_MINOR, "version.hpp and CMakeLists.txt differ");
static_assert(BOXSTREAM_VERSION_PATCH == EXPECTED_PATCH, "version.hpp and CMakeLists.txt differ");

// That this program compiles and links is the test.
int main() {
  return 0;
}
