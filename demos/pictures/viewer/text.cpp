// SPDX-License-Identifier: MIT
#include "pictures/viewer/text.hpp"

#include <cstdint>

namespace boxstream::view {
namespace {

constexpr unsigned digits = 93;
constexpr int bits_of_pair = 13;  // 2^13 < 93^2
constexpr int bits_of_one = 6;    // 2^6 < 93

char digit(std::uint32_t value) {
  const auto character = static_cast<char>('!' + value);
  return static_cast<char>(character < '<' ? character : character + 1);
}

}  // namespace

std::string as_text(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() * 16 / bits_of_pair + 2);
  std::uint32_t held = 0;
  int bits = 0;
  const auto put = [&] {
    const std::uint32_t value = held & ((1U << bits_of_pair) - 1);
    text += digit(value % digits);
    if (bits > bits_of_one) text += digit(value / digits);
    held >>= bits_of_pair;
    bits -= bits_of_pair;
  };
  for (const char byte : bytes) {
    held |= std::uint32_t{static_cast<std::uint8_t>(byte)} << bits;
    bits += 8;
    if (bits >= bits_of_pair) put();
  }
  if (bits > 0) put();
  return text;
}

}  // namespace boxstream::view
