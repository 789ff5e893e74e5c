// SPDX-License-Identifier: MIT
#include <cstdio>

#include "golden.hpp"

/// Prints the lines of golden.txt that this program is for, as they are now.
int main() {
  for (const std::string& name : worlds_tests::golden_names())
    std::printf("%s\n", worlds_tests::golden_line(name).c_str());
}
