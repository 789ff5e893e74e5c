// SPDX-License-Identifier: MIT
// Included before everything else in the shadow tree of tests/mutants/shadow.py, and nowhere else.
#pragma once

// For what is in place of the right code in some faults.
#include <cmath>
#include <limits>

namespace boxstream::mutants {

/// Which fault is switched on; 0: none. Set once, before main, from the environment variable BOXSTREAM_FAULT.
extern int fault;

/// What the compiler computes is always right.
constexpr bool is_on(int number) {
  return !__builtin_is_constant_evaluated() && fault == number;
}

}  // namespace boxstream::mutants
