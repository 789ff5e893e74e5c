// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/keys.hpp"

namespace boxstream::detail {

/// Monotone map from keys to buckets: about evenly spaced in the caller's coordinates, clamped at the ends. Any
/// monotone map gives the right pairs; an even one gives short runs. All in integers, so that the order of pairs is the
/// same in any floating-point environment.
class Buckets {
 public:
  static constexpr std::uint32_t most = 1u << 15;

  Buckets() = default;  ///< one bucket

  Buckets(KeyKind kind, std::int32_t min_key, std::int32_t max_key, std::uint32_t wanted) {
    switch (kind) {
      case KeyKind::float32:
        set_fraction(23);
        break;
      case KeyKind::float64:
        set_fraction(20);
        break;
      case KeyKind::linear:
        break;
    }
    if (wanted <= 1 || min_key >= max_key) return;
    min_key_ = min_key;
    max_key_ = max_key;
    if (exponent_shift_ < 31) top_ = std::max(exponent(min_key), exponent(max_key));
    first_ = fixed_point(min_key);
    const std::uint32_t range = static_cast<std::uint32_t>(fixed_point(max_key)) - static_cast<std::uint32_t>(first_);
    // Positions of 16 bits and a factor of at most 2^32 / 2^16 buckets: their product is the bucket's number times
    // 2^16.
    while ((range >> shift_) >= 1u << 16) ++shift_;
    count_ = std::min(wanted, most);
    factor_ = ((count_ << 16) - 1) / ((range >> shift_) + 1);
  }

  std::uint32_t count() const { return count_; }

  std::uint32_t operator()(std::int32_t key) const {
    const std::int32_t at = fixed_point(std::min(std::max(key, min_key_), max_key_));
    const std::uint32_t position = (static_cast<std::uint32_t>(at) - static_cast<std::uint32_t>(first_)) >> shift_;
    return position * factor_ >> 16;
  }

 private:
  void set_fraction(int bits) {
    hidden_bit_ = 1 << bits;
    fraction_mask_ = hidden_bit_ - 1;
    headroom_ = 29 - bits;
    exponent_shift_ = bits;
    negate_ = -1;
  }

  // An order key is sign and magnitude; the magnitude of a floating-point number is exponent and fraction. Numbers too
  // small for a hidden bit get one too, which keeps their order. A linear key is halved: it has no exponent, and what
  // is left of it is its fraction. One formula for all, so that vectors need not compute two.
  std::int32_t exponent(std::int32_t key) const { return (key ^ (key >> 31)) >> exponent_shift_; }
  std::int32_t fixed_point(std::int32_t key) const {
    const std::int32_t sign = key >> 31, magnitude = key ^ sign;
    const std::int32_t fraction = ((magnitude & fraction_mask_) | hidden_bit_) << headroom_;
    const std::int32_t below_top = std::min(top_ - (magnitude >> exponent_shift_), 31);
    return (fraction >> below_top ^ sign) - (sign & negate_);
  }

  std::int32_t fraction_mask_ = INT32_MAX, hidden_bit_ = 0, negate_ = 0;
  int headroom_ = 0, exponent_shift_ = 31;
  std::int32_t top_ = 1;  // exponent of the largest magnitude
  std::int32_t min_key_ = 0, max_key_ = 0;
  std::int32_t first_ = 0;
  int shift_ = 0;
  std::uint32_t factor_ = 0;
  std::uint32_t count_ = 1;
};

}  // namespace boxstream::detail
