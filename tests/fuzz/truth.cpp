// SPDX-License-Identifier: MIT
#include "truth.hpp"

namespace boxstream::fuzz {

using tests::Boxes;
using tests::Filters;
using tests::Pairs;

Pairs truth(const Boxes<float>& boxes, const Filters& filters) {
  return tests::brute_force(boxes, filters);
}
Pairs truth(const Boxes<double>& boxes, const Filters& filters) {
  return tests::brute_force(boxes, filters);
}
Pairs truth(const Boxes<float>& a, const Boxes<float>& b, const Filters& filters_a, const Filters& filters_b) {
  return tests::brute_force(a, b, filters_a, filters_b);
}
Pairs truth(const Boxes<double>& a, const Boxes<double>& b, const Filters& filters_a, const Filters& filters_b) {
  return tests::brute_force(a, b, filters_a, filters_b);
}

std::string difference(const Pairs& found, const Pairs& expected, const Boxes<float>& a, const Boxes<float>& b) {
  return tests::first_difference(found, expected, a, b);
}
std::string difference(const Pairs& found, const Pairs& expected, const Boxes<double>& a, const Boxes<double>& b) {
  return tests::first_difference(found, expected, a, b);
}

}  // namespace boxstream::fuzz
