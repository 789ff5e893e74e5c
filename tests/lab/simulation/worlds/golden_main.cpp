// SPDX-License-Identifier: MIT
#include <cstdio>

#include "golden.hpp"

/// Prints the lines of golden.txt that this program is for, as they are now.
int main() {
  for (const std::string& name : boxstream::worlds_test::golden_names())
    std::printf("%s\n", boxstream::worlds_test::golden_line(name).c_str());
}
