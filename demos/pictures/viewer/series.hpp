// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace boxstream::view {

/// Time series, coded as residuals of a linear predictor in whole quanta. A decoder makes the same predictions, and
/// comes within half a quantum of each number. Numbers that change by less cost nothing once the stream is compressed.
///
/// Values are given and kept in sixteenths of a quantum, `at`, with a speed for each. The prediction is the last value,
/// or, in a series that goes on and with a speed of a quantum or more, the last value plus the speed. The residual is a
/// step, -126 to 126: it moves `at` by 16 times, and changes the speed by 8 times itself. With a step of 0, the speed
/// of a number that was predicted to stay is halved, towards 0. A larger residual, a change from or to "no number", and
/// the first value are leaps: `at` becomes the nearest quantum, and the speed the difference, or 0 after no number.
///
/// Code: a byte for each number, zigzag coded (2s, or -2s - 1), or 255 for a leap; then the leaps in LEB128: quanta,
/// zigzag coded, or 2^28 for no number. The first numbers are leaps without those bytes.
class Series {
 public:
  static constexpr std::int32_t fine = 16;
  static constexpr std::int32_t not_a_number = INT32_MIN;
  static constexpr std::int32_t largest = 1 << 29;

  explicit Series(bool goes_on) : goes_on_(goes_on) {}

  /// Appends the code of `values`: sixteenths of a quantum up to `largest` to both sides, or `not_a_number`.
  void code(const std::vector<std::int32_t>& values, std::string& out);
  void restart() { at_.clear(); }
  /// The last values as a decoder has them.
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
