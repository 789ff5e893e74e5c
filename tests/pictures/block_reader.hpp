// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/pair.hpp>

namespace boxstream::view_test {

/// Takes blocks of frames apart as their description says, and not as the encoder's code does.
class BlockReader {
 public:
  struct Frame {
    std::vector<std::int32_t> places, rotations, corners, islands, moods;
    std::vector<Pair> pairs;
  };

  BlockReader(const std::string& block, std::size_t objects, std::size_t nodes)
      : block_(block), objects_(objects), nodes_(nodes) {}

  bool is_at_end() const { return at_ == block_.size(); }
  /// Throws std::out_of_range if the block ends within the frame.
  Frame next();

 private:
  using Member = std::vector<std::int32_t> Frame::*;

  std::vector<std::int32_t> numbers(Member member, std::size_t count, std::size_t bytes, bool straight);
  std::uint32_t leb128();
  std::vector<Pair> pairs();

  const std::string& block_;
  std::size_t objects_, nodes_;
  std::size_t at_ = 0;
  std::vector<Frame> frames_;
};

}  // namespace boxstream::view_test
