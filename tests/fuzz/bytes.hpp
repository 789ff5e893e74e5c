// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>

#include <boxstream/aabb.hpp>

namespace boxstream::fuzz {

/// An input as a stream of choices. After its end it goes on with zeros, so that every input means something.
///
/// A number begins with a code:
///   00-9f  a whole multiple of 1/2 from -16 on: touching is the rule among few values
///   a0-bf  one that arithmetic dislikes (table below)
///   c0-df  the number before, one ulp up (even) or down (odd)
///   e0-f7  any power of two of the type: the exponent in the next two bytes
///   f8-ff  any bits: the next 4 or 8 bytes
/// A box has three times a lower bound and a code for the upper one:
///   00-9f  the code in quarters more
///   a0-bf  the same; or with odd codes one ulp more
///   c0-ef  a number of its own, which may make the box inside out
///   f0-ff  infinite
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  bool empty() const { return at_ == end_; }
  std::uint8_t byte() { return at_ == end_ ? std::uint8_t{0} : *at_++; }
  unsigned two_bytes() {
    const unsigned low = byte();
    return low | static_cast<unsigned>(byte()) << 8;
  }
  unsigned below(unsigned count) { return byte() % count; }

  template <class S>
  S number() {
    const unsigned code = byte();
    if (code < 0xa0)
      last_ = static_cast<S>(code) / 2 - 16;
    else if (code < 0xc0)
      last_ = static_cast<double>(disliked<S>(code));
    else if (code < 0xe0)
      last_ = static_cast<double>(
          std::nextafter(static_cast<S>(last_), code % 2 == 0 ? Limits<S>::infinity() : -Limits<S>::infinity()));
    else if (code < 0xf8)
      last_ = static_cast<double>(std::ldexp(code % 2 == 0 ? S(1) : S(-1), exponent<S>()));
    else
      return any_bits<S>();
    return static_cast<S>(last_);
  }

  template <class S>
  BasicAabb<S> box() {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = number<S>();
      const unsigned code = byte();
      if (code < 0xa0)
        box.max[d] = box.min[d] + static_cast<S>(code) / 4;
      else if (code < 0xc0)
        box.max[d] = code % 2 == 0 ? box.min[d] : std::nextafter(box.min[d], Limits<S>::infinity());
      else if (code < 0xf0)
        box.max[d] = number<S>();
      else
        box.max[d] = Limits<S>::infinity();
    }
    return box;
  }

 private:
  template <class S>
  using Limits = std::numeric_limits<S>;

  template <class S>
  static S disliked(unsigned code) {
    const S table[] = {Limits<S>::quiet_NaN(),
                       Limits<S>::infinity(),
                       -Limits<S>::infinity(),
                       S(0),
                       -S(0),
                       Limits<S>::denorm_min(),
                       -Limits<S>::denorm_min(),
                       Limits<S>::min(),
                       -Limits<S>::min(),
                       std::nextafter(Limits<S>::min(), S(0)),
                       Limits<S>::max(),
                       -Limits<S>::max(),
                       Limits<S>::max() / 2,
                       Limits<S>::epsilon(),
                       S(1e18),
                       S(-1e18)};
    return table[code % std::size(table)];
  }

  template <class S>
  int exponent() {
    const int range = Limits<S>::max_exponent - Limits<S>::min_exponent + Limits<S>::digits;
    return Limits<S>::min_exponent - Limits<S>::digits + static_cast<int>(two_bytes()) % range;
  }

  template <class S>
  S any_bits() {
    unsigned char raw[sizeof(S)];
    for (unsigned char& part : raw) part = byte();
    S value;
    std::memcpy(&value, raw, sizeof value);
    return value;
  }

  const std::uint8_t* at_;
  const std::uint8_t* end_;
  double last_ = 0;
};

/// A small box on a grid of integers, by the generator's next numbers.
template <class S>
BasicAabb<S> drawn_box(std::minstd_rand& random, unsigned cells) {
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = static_cast<S>((random() >> 8) % cells);
    box.max[d] = box.min[d] + static_cast<S>((random() >> 8) % 4) / 2;
  }
  return box;
}

}  // namespace boxstream::fuzz
