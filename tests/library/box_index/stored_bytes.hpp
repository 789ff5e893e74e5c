// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace boxstream::tests {

using StoredBytes = std::vector<std::uint8_t>;

inline void set_number(StoredBytes& bytes, std::size_t at, std::uint64_t x, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.at(at + i) = static_cast<std::uint8_t>(x >> (8 * i));
}

/// The checksum of all but itself, computed for bytes that a test has made.
inline void sign(StoredBytes& bytes) {
  StoredBytes rest(bytes.begin(), bytes.begin() + 32);
  rest.insert(rest.end(), bytes.begin() + 40, bytes.end());
  rest.resize((rest.size() + 7) / 8 * 8);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < rest.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = 8; k-- > 0;) word = word << 8 | rest[i + k];
    sum = (sum ^ word) * 0x9e3779b97f4a7c15;
    sum ^= sum >> 32;
  }
  set_number(bytes, 32, sum, 8);
}

}  // namespace boxstream::tests
