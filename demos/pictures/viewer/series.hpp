// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace boxstream::view {

/// Numbers through time, coded as what is left when they are foretold, in whole quanta. Whoever decodes them foretells
/// the same, and comes within half a quantum of each. What rests within it costs nothing.
///
/// Numbers are given and kept in sixteenths of a quantum, `at`, with a speed for each. A number is foretold to stay
/// where it is, or, in a series that goes on and with a speed of a quantum or more, to go on by its speed. What is left
/// is a step, -126 to 126: it moves `at` by 16 times, and changes the speed by 8 times itself. With a step of 0, the
/// speed of what was foretold to stay is halved, towards 0. A longer way, one from or to what is no number, and the
/// first of all are leaps: `at` becomes the nearest quantum, and the speed the way there, or 0 after no number.
///
/// Code: a byte for each number, sign in the lowest bit (2s, or -2s - 1), or 255 for a leap; then the leaps in LEB128:
/// quanta, sign in the lowest bit, or 2^28 for no number. The first numbers are leaps without those bytes.
class Series {
 public:
  static constexpr std::int32_t fine = 16;
  static constexpr std::int32_t not_a_number = INT32_MIN;
  static constexpr std::int32_t largest = 1 << 29;

  explicit Series(bool goes_on) : goes_on_(goes_on) {}

  /// Appends the code of `values`: sixteenths of a quantum up to `largest` to both sides, or `not_a_number`.
  void code(const std::vector<std::int32_t>& values, std::string& out);
  void restart() { at_.clear(); }
  /// What a decoder has: of the last values coded.
  const std::vector<std::int32_t>& at() const { return at_; }

 private:
  std::uint8_t step(std::size_t i, std::int32_t value);
  void leap(std::size_t i, std::int32_t value);

  bool goes_on_;
  std::vector<std::int32_t> at_, speed_;
  std::string leaps_;
};

/// `value` in LEB128: seven bits a byte, the lowest first.
void append_number(std::string& out, std::uint32_t value);

/// The sign in the lowest bit.
std::uint32_t sign_last(std::int32_t value);

}  // namespace boxstream::view
