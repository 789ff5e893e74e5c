// SPDX-License-Identifier: MIT
// Prints golden_order.txt anew, for when the order is changed on purpose:
//   boxstream_golden_order > tests/library/core/golden_order.txt
#include <cstdio>

#include "golden_order.hpp"

int main() {
  for (const std::string& line : boxstream::tests::golden_order(nullptr)) std::puts(line.c_str());
}
