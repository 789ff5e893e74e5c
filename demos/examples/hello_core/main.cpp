// SPDX-License-Identifier: MIT
// All pairs of boxes that touch, within one set and between two.
#include <boxstream/boxstream.hpp>

#include <cstdio>
#include <vector>

int main() {
  const std::vector<boxstream::Aabb> crates = {
      {{0, 0, 0}, {1, 1, 1}},  // min, max
      {{1, 0, 0}, {2, 1, 1}},  // shares a face with the first: touching counts
      {{5, 5, 5}, {6, 6, 6}},
  };
  const std::vector<boxstream::Aabb> shelves = {{{0, 0, 1}, {9, 9, 2}}};

  boxstream::Detector detector;  // keeps its memory from search to search
  std::vector<boxstream::Pair> pairs;
  detector.find_pairs(crates, pairs);
  for (const auto [a, b] : pairs) std::printf("crates %u and %u touch\n", a, b);
  detector.find_pairs(crates, shelves, pairs);
  for (const auto [a, b] : pairs) std::printf("crate %u touches shelf %u\n", a, b);
}
