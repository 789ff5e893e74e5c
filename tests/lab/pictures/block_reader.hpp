// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boxstream/pair.hpp>

namespace boxstream::view_test {

/// Takes blocks of frames apart as their description says, and not as the encoder's code does.
class BlockReader {
 public:
  struct Contact {
    Pair objects;
    std::array<std::int64_t, 3> place;  ///< quanta
    std::array<std::uint32_t, 2> normal;
  };
  struct Frame {
    std::vector<double> places, rotations, boxes;  ///< in units and quanta, NaN for no number
    std::vector<double> islands, moods;
    std::vector<Pair> pairs;
    std::vector<bool> touching;
    std::optional<std::vector<Contact>> contacts;
  };

  BlockReader(const std::string& block, std::size_t objects, std::size_t nodes, std::size_t turning);

  bool is_at_end() const { return at_ == block_.size(); }
  /// Throws std::out_of_range if the block ends within the frame.
  Frame next();

 private:
  /// Numbers in quanta; `at` and `speed` as the description has them, but not in sixteenths.
  struct Series {
    bool goes_on;
    std::size_t count;
    std::vector<double> at{}, speed{};
  };

  const std::vector<double>& numbers(Series& series);
  void leap(Series& series, std::size_t i);
  std::uint32_t leb128();
  std::vector<std::size_t> places();
  std::vector<Pair> new_pairs();
  void read_pairs(Frame& frame);
  std::optional<std::vector<Contact>> contacts(const std::vector<Pair>& pairs);

  const std::string& block_;
  std::size_t at_ = 0;
  Series places_, rotations_, boxes_, islands_, moods_;
  std::vector<Pair> pairs_;
  std::vector<bool> touching_;
};

}  // namespace boxstream::view_test
