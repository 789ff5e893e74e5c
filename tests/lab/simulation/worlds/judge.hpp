// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "plain_world.hpp"

namespace boxstream::worlds_test {

/// Which broad-phases must meet a criterion; the values of the others are only shown.
enum class Asked {
  of_all,
  of_boxstream,  ///< it promises what Bullet's own broad-phases do not
  of_none
};

/// One criterion of one world has come out: fails the test if it was not met, unless Bullet is known not to meet it
/// whatever finds the pairs; then it fails if it was met. Prints a line for table.py. `size` is what depends on how
/// much of the world is run.
void judge(const std::string& world, const std::string& criterion, Kind kind, double value, bool passed,
           Asked asked = Asked::of_all, const std::string& size = {});

/// The ends of tests' names.
std::string test_name(Kind kind);

}  // namespace boxstream::worlds_test
