// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "oracle.hpp"

namespace boxstream::tests {

/// Compares whole sorted lists, duplicates included. `scene` and `seed` name the input in the message.
template <class S>
bool expect_same_pairs(const Pairs& found, const Pairs& expected, const Boxes<S>& a, const Boxes<S>& b,
                       const std::string& scene, std::uint64_t seed) {
  const std::string difference = first_difference(found, expected, a, b);
  EXPECT_TRUE(difference.empty()) << "scene " << scene << ", seed " << seed << ", sizes " << a.size() << " and "
                                  << b.size() << ", " << (sizeof(S) == 4 ? "float" : "double") << ": " << difference;
  return difference.empty();
}

template <class S>
bool expect_same_pairs(const Pairs& found, const Pairs& expected, const Boxes<S>& boxes, const std::string& scene,
                       std::uint64_t seed) {
  return expect_same_pairs(found, expected, boxes, boxes, scene, seed);
}

}  // namespace boxstream::tests
