// SPDX-License-Identifier: MIT
#include "golden.hpp"

#include <cinttypes>
#include <cstdio>

namespace boxstream::worlds_test {

std::string golden_line(const std::string& name, const char* precision, int steps, const Fold& pairs,
                        const Fold& states) {
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, " %d %016" PRIx64 " %016" PRIx64, steps, pairs.hash(), states.hash());
  return name + ' ' + precision + numbers;
}

}  // namespace boxstream::worlds_test
