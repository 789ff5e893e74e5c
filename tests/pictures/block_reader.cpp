// SPDX-License-Identifier: MIT
#include "block_reader.hpp"

#include <algorithm>
#include <set>

namespace boxstream::view_test {

std::vector<std::int32_t> BlockReader::numbers(Member member, std::size_t count, std::size_t bytes, bool straight) {
  std::vector<std::int32_t> values;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t coded = 0;
    for (std::size_t byte = 0; byte < bytes; ++byte)
      coded += std::uint64_t{static_cast<std::uint8_t>(block_.at(at_ + byte * count + i))} << (8 * byte);
    std::int64_t value = static_cast<std::int64_t>(coded / 2);
    if (coded % 2 == 1) value = -value - 1;
    const std::size_t age = frames_.size();
    if (age > 0) value += (frames_[age - 1].*member)[i];
    if (age > 1 && straight) value += std::int64_t{(frames_[age - 1].*member)[i]} - (frames_[age - 2].*member)[i];
    values.push_back(static_cast<std::int32_t>(static_cast<std::uint32_t>(value)));
  }
  at_ += bytes * count;
  return values;
}

std::uint32_t BlockReader::leb128() {
  std::uint32_t value = 0;
  for (int shift = 0;; shift += 7) {
    const auto byte = static_cast<std::uint8_t>(block_.at(at_++));
    value |= std::uint32_t{byte & 0x7FU} << shift;
    if (byte < 0x80) return value;
  }
}

std::vector<Pair> BlockReader::pairs() {
  std::vector<Pair> list(leb128());
  Pair last{0, 0};
  for (Pair& pair : list) {
    pair.a = last.a + leb128();
    pair.b = (pair.a == last.a ? last.b : pair.a) + leb128();
    last = pair;
  }
  return list;
}

BlockReader::Frame BlockReader::next() {
  Frame frame;
  frame.places = numbers(&Frame::places, 3 * (objects_ + nodes_), 4, true);
  frame.rotations = numbers(&Frame::rotations, 4 * objects_, 3, true);
  frame.corners = numbers(&Frame::corners, 6 * objects_, 4, true);
  frame.islands = numbers(&Frame::islands, objects_, 4, false);
  frame.moods = numbers(&Frame::moods, objects_, 1, false);
  std::set<Pair> held;
  if (!frames_.empty()) held = {frames_.back().pairs.begin(), frames_.back().pairs.end()};
  for (const Pair& pair : pairs()) held.erase(pair);
  const std::vector<Pair> begun = pairs();
  held.insert(begun.begin(), begun.end());
  frame.pairs.assign(held.begin(), held.end());
  frames_.push_back(frame);
  return frame;
}

}  // namespace boxstream::view_test
