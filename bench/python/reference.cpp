// SPDX-License-Identifier: MIT
// The searches that bench.py times in C++, and the boxes that it gives to all.
#include <algorithm>
#include <cstdint>
#include <vector>

#include <boxstream/boxstream.hpp>

#include "inputs/batches.hpp"

namespace {

boxstream::Detector detector;
std::vector<boxstream::Pair> pairs;

boxstream::Span<const boxstream::Aabb> boxes_of(const float* boxes, std::size_t count) {
  return {reinterpret_cast<const boxstream::Aabb*>(boxes), count};
}

}  // namespace

extern "C" {

/// `count` boxes of a batch as six floats each.
void boxstream_reference_boxes(const char* name, std::size_t count, float* out) {
  const std::vector<boxstream::Aabb> boxes = boxstream::batches::make(name, count, 1);
  std::copy(boxes.begin(), boxes.end(), reinterpret_cast<boxstream::Aabb*>(out));
}

/// A search with nothing kept from one to the next. Returns the number of pairs.
std::uint64_t boxstream_reference_once(const float* boxes, std::size_t count) {
  return boxstream::find_pairs(boxes_of(boxes, count)).size();
}

/// A search that keeps its memory, that of the pairs too.
std::uint64_t boxstream_reference_kept(const float* boxes, std::size_t count) {
  return detector.find_pairs(boxes_of(boxes, count), pairs).pairs;
}

/// The pairs of the last search that kept its memory, as two indices each.
void boxstream_reference_pairs(std::uint32_t* out) {
  std::copy(pairs.begin(), pairs.end(), reinterpret_cast<boxstream::Pair*>(out));
}
}
