// SPDX-License-Identifier: MIT
// Prints golden_order.txt anew, for when the order is changed on purpose:
//   boxstream_golden_order > tests/core/golden_order.txt
#include <cstdio>

#include "golden_order.hpp"

int main() {
  boxstream::Detector detector;
  for (const std::string& line : boxstream::tests::golden_order(detector)) std::puts(line.c_str());
}
