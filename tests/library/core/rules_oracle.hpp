// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <boxstream/detector.hpp>

#include "oracle.hpp"

namespace boxstream::tests {

using Ids = std::vector<std::uint32_t>;

/// By the definition of the rules. A difference of two coordinates has to fit a long double.
template <class S>
bool may_pair(const BasicAabb<S>& a, const BasicAabb<S>& b, bool touching, double tolerance) {
  for (int d = 0; d < 3; ++d) {
    if (tolerance == 0 && touching && !(a.min[d] <= b.max[d] && b.min[d] <= a.max[d])) return false;
    if (tolerance == 0 && !touching && !(a.min[d] < b.max[d] && b.min[d] < a.max[d])) return false;
    if (tolerance == 0) continue;
    using Wide = long double;
    const Wide gap = std::max(Wide(a.min[d]) - Wide(b.max[d]), Wide(b.min[d]) - Wide(a.max[d]));
    if (touching ? gap > Wide(tolerance) : gap >= Wide(tolerance)) return false;
  }
  return true;
}

template <class A, class B>
Pairs brute(const std::vector<BasicAabb<A>>& a, const std::vector<BasicAabb<B>>& b, bool self, const PairRules& rules) {
  Pairs pairs;
  const auto id = [&](Span<const std::uint32_t> ids, std::size_t i, std::uint32_t none) {
    return ids.empty() ? none : ids[i];
  };
  const auto filters = [](Span<const Filter> f) { return Filters(f.begin(), f.end()); };
  const Filters fa = filters(rules.filters), fb = self ? fa : filters(rules.filters_b);
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (!makes_sense(a[i])) continue;
    for (std::uint32_t j = self ? i + 1 : 0; j < b.size(); ++j) {
      if (!makes_sense(b[j]) || !permitted(fa, i, fb, j)) continue;
      if (id(rules.ids, i, 0) == id(self ? rules.ids : rules.ids_b, j, 1)) continue;
      using S = std::conditional_t<std::is_same_v<A, B>, A, double>;
      const auto as = [](const auto& box) {
        BasicAabb<S> out;
        for (int d = 0; d < 3; ++d) {
          out.min[d] = static_cast<S>(box.min[d]);
          out.max[d] = static_cast<S>(box.max[d]);
        }
        return out;
      };
      if (may_pair(as(a[i]), as(b[j]), rules.touching, rules.tolerance)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

}  // namespace boxstream::tests
