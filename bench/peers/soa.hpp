// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

namespace boxstream::bench {

/// Boxes as one array per side, in whatever order they were added.
struct BoxArrays {
  std::vector<float> low[3], high[3];
  std::vector<std::uint32_t> id;

  void resize(std::size_t n) {
    for (int d = 0; d < 3; ++d) {
      low[d].resize(n);
      high[d].resize(n);
    }
    id.resize(n);
  }

  void set(std::size_t i, const Aabb& box, std::uint32_t index) {
    for (int d = 0; d < 3; ++d) {
      low[d][i] = box.min[d];
      high[d][i] = box.max[d];
    }
    id[i] = index;
  }

  /// Appends the pairs of box i with each of [first, last). The comparisons have no branch, so compilers vectorise
  /// them.
  void match(std::size_t i, std::size_t first, std::size_t last, std::vector<Pair>& pairs) const {
    constexpr std::size_t block = 64;
    const float *x0 = low[0].data(), *x1 = high[0].data(), *y0 = low[1].data(), *y1 = high[1].data(),
                *z0 = low[2].data(), *z1 = high[2].data();
    const float ax0 = x0[i], ax1 = x1[i], ay0 = y0[i], ay1 = y1[i], az0 = z0[i], az1 = z1[i];
    std::int32_t hits[block];
    for (std::size_t start = first; start < last; start += block) {
      const std::size_t count = last - start < block ? last - start : block;
      std::int32_t any = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t j = start + k;
        hits[k] = (x0[j] <= ax1) & (ax0 <= x1[j]) & (y0[j] <= ay1) & (ay0 <= y1[j]) & (z0[j] <= az1) & (az0 <= z1[j]);
        any |= hits[k];
      }
      if (!any) continue;
      for (std::size_t k = 0; k < count; ++k)
        if (hits[k]) {
          const std::uint32_t a = id[i], b = id[start + k];
          pairs.push_back(a < b ? Pair{a, b} : Pair{b, a});
        }
    }
  }
};

}  // namespace boxstream::bench
