// SPDX-License-Identifier: MIT
#include "pictures/viewer/frames.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace boxstream::view {
namespace {

constexpr std::int32_t largest_length = 1 << 30;

void append_number(std::string& out, std::uint32_t value) {
  for (; value >= 0x80; value >>= 7) out += static_cast<char>(value | 0x80);
  out += static_cast<char>(value);
}

void append_pairs(std::string& out, const std::vector<Pair>& pairs) {
  append_number(out, static_cast<std::uint32_t>(pairs.size()));
  Pair last{0, 0};
  for (const Pair& pair : pairs) {
    append_number(out, pair.a - last.a);
    append_number(out, pair.b - (pair.a == last.a ? last.b : pair.a));
    last = pair;
  }
}

/// Differences of any two values wrap around, and so does adding them again.
std::int32_t minus(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

std::uint32_t sign_last(std::int32_t value) {
  return static_cast<std::uint32_t>(value) << 1 ^ static_cast<std::uint32_t>(value >> 31);
}

}  // namespace

std::int32_t FrameEncoder::fixed(float length) const {
  if (std::isnan(length)) return not_a_number;
  const float units = std::round(length / unit_);
  if (units >= static_cast<float>(largest_length)) return largest_length;
  if (units <= static_cast<float>(-largest_length)) return -largest_length;
  return static_cast<std::int32_t>(units);
}

void FrameEncoder::Series::code(const std::vector<std::int32_t>& values, int bytes, bool straight, std::string& out) {
  coded_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::int32_t left = values[i];
    if (age_ > 0) left = minus(left, former_[i]);
    if (age_ > 1 && straight) left = minus(left, minus(former_[i], before_former_[i]));
    coded_[i] = sign_last(left);
  }
  for (int byte = 0; byte < bytes; ++byte) {
    const std::size_t start = out.size();
    out.resize(start + coded_.size());
    std::transform(coded_.begin(), coded_.end(), out.begin() + static_cast<std::ptrdiff_t>(start),
                   [byte](std::uint32_t value) { return static_cast<char>(value >> (8 * byte)); });
  }
  before_former_.swap(former_);
  former_ = values;
  ++age_;
}

void FrameEncoder::add(const Snapshot& snapshot) {
  numbers_.clear();
  for (const Pose& pose : snapshot.poses)
    for (const float x : pose.position) numbers_.push_back(fixed(x));
  for (const Point& node : snapshot.nodes)
    for (const float x : node) numbers_.push_back(fixed(x));
  places_.code(numbers_, 4, true, block_);

  std::vector<std::int32_t> corners;
  corners.reserve(6 * snapshot.boxes.size());
  for (std::size_t i = 0; i < snapshot.boxes.size(); ++i) {
    for (const Point* const corner : {&snapshot.boxes[i].min, &snapshot.boxes[i].max})
      for (std::size_t d = 0; d < 3; ++d) corners.push_back(minus(fixed((*corner)[d]), numbers_[3 * i + d]));
  }

  numbers_.clear();
  for (const Pose& pose : snapshot.poses)
    for (const float x : pose.rotation) {
      const float part = std::isfinite(x) ? std::clamp(x, -1.0F, 1.0F) : 0.0F;
      numbers_.push_back(static_cast<std::int32_t>(std::lround(part / rotation_unit)));
    }
  rotations_.code(numbers_, 3, true, block_);
  corners_.code(corners, 4, true, block_);
  islands_.code(snapshot.islands, 4, false, block_);
  numbers_.clear();
  for (const Mood mood : snapshot.moods) numbers_.push_back(static_cast<std::int32_t>(mood));
  moods_.code(numbers_, 1, false, block_);
  code_pairs(snapshot.pairs);
  ++frames_;
}

void FrameEncoder::code_pairs(const std::vector<Pair>& pairs) {
  std::vector<Pair> ended, begun;
  std::set_difference(former_pairs_.begin(), former_pairs_.end(), pairs.begin(), pairs.end(),
                      std::back_inserter(ended));
  std::set_difference(pairs.begin(), pairs.end(), former_pairs_.begin(), former_pairs_.end(),
                      std::back_inserter(begun));
  append_pairs(block_, ended);
  append_pairs(block_, begun);
  former_pairs_ = pairs;
}

std::string FrameEncoder::take_block() {
  for (Series* const series : {&places_, &rotations_, &corners_, &islands_, &moods_}) series->restart();
  former_pairs_.clear();
  frames_ = 0;
  return std::exchange(block_, {});
}

std::size_t expected_frame_size(std::size_t objects, std::size_t nodes) {
  constexpr std::size_t bytes_of_object = 15;
  constexpr std::size_t bytes_of_node = 5;
  return bytes_of_object * objects + bytes_of_node * nodes;
}

}  // namespace boxstream::view
