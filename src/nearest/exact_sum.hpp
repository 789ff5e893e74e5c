// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

namespace boxstream::detail {

/// A finite double as an integer multiple of 2^-1074: three digits of 32 bits, the lowest at place `place`.
struct Digits {
  std::uint64_t digit[3];
  int place;
  int sign;

  explicit Digits(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    constexpr std::uint64_t hidden = std::uint64_t{1} << 52;
    const auto exponent = static_cast<int>(bits >> 52 & 0x7ff);
    const std::uint64_t whole = (bits & (hidden - 1)) | (exponent == 0 ? 0 : hidden);
    // value = whole * 2^(shift - 1074); denormals have the exponent of the least normal numbers.
    int shift = exponent == 0 ? 0 : exponent - 1;
    place = shift / 32;
    shift %= 32;
    const std::uint64_t low = whole << shift, high = shift == 0 ? 0 : whole >> (64 - shift);
    digit[0] = low & 0xffffffffu;
    digit[1] = low >> 32;
    digit[2] = high;
    sign = bits >> 63 ? -1 : 1;
  }
};

/// A sum of products of doubles, without rounding. It is kept in digits that may be as large as 63 bits and of either
/// sign, so that carries wait until the end.
class ExactSum {
 public:
  /// Adds `times` * a * b.
  void add(const Digits& a, const Digits& b, int times) {
    const std::int64_t factor = times * a.sign * b.sign;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const std::uint64_t product = a.digit[i] * b.digit[j];
        const int at = a.place + b.place + i + j;
        digit_[at] += factor * static_cast<std::int64_t>(product & 0xffffffffu);
        digit_[at + 1] += factor * static_cast<std::int64_t>(product >> 32);
      }
  }

  /// -1, 0 or 1.
  int sign() const {
    std::int64_t carry = 0;
    bool zero = true;
    for (const std::int64_t digit : digit_) {
      const std::int64_t value = digit + carry;
      zero = zero && (value & 0xffffffff) == 0;
      carry = value >> 32;  // rounds down
    }
    // What is left above all digits decides, unless it is zero.
    return carry < 0 ? -1 : carry > 0 || !zero ? 1 : 0;
  }

 private:
  // The highest place of a double is 63 + 2, hence that of a product 130 + 1.
  std::int64_t digit_[132] = {};
};

}  // namespace boxstream::detail
