// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>

namespace boxstream::detail {

/// Where part `i` of `parts` even parts of `size` things begins; with i == parts, `size`. The product has 64 bits
/// where sizes have 32.
constexpr std::size_t begin_of_part(std::size_t size, std::size_t i, std::size_t parts) {
  assert(i <= parts && parts != 0);
  return static_cast<std::size_t>(std::uint64_t{size} * i / parts);
}

}  // namespace boxstream::detail
