// SPDX-License-Identifier: MIT
// fault_switch.hpp is included before everything else.

#include <cstdlib>

namespace boxstream::mutants {

namespace {

int from_environment() {
  const char* const text = std::getenv("BOXSTREAM_FAULT");
  return text == nullptr ? 0 : std::atoi(text);
}

}  // namespace

int fault = from_environment();

}  // namespace boxstream::mutants
