// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "random.hpp"

namespace boxstream::tests {

/// Many sets of boxes in one array, with a filter for each box.
template <class S>
struct ManySets {
  Boxes<S> boxes;
  std::vector<std::uint64_t> offsets{0};
  Filters filters;

  void add(const Boxes<S>& set, Random& random) {
    boxes.insert(boxes.end(), set.begin(), set.end());
    while (filters.size() < boxes.size())
      filters.push_back(
          {static_cast<std::uint32_t>(random.integer(1, 3)), static_cast<std::uint32_t>(random.integer(1, 3))});
    offsets.push_back(boxes.size());
  }

  std::size_t size() const { return offsets.size() - 1; }
  Boxes<S> set(std::size_t i) const { return part(boxes, i); }
  Filters filters_of(std::size_t i) const { return part(filters, i); }

 private:
  template <class T>
  std::vector<T> part(const std::vector<T>& all, std::size_t i) const {
    return {all.begin() + static_cast<std::ptrdiff_t>(offsets[i]),
            all.begin() + static_cast<std::ptrdiff_t>(offsets[i + 1])};
  }
};

/// One set of each of the sizes, each of a family of its own.
template <class S>
ManySets<S> make_many(const std::vector<std::size_t>& sizes, std::uint64_t seed) {
  Random random(seed);
  ManySets<S> sets;
  const auto& families = box_sets<S>();
  for (const std::size_t size : sizes) {
    const BoxSet<S>& family = families[random.index(families.size())];
    sets.add(family.make(std::min(size, family.largest), random.index(1000)), random);
  }
  return sets;
}

/// Mostly small ones, some of them empty.
inline std::vector<std::size_t> uneven_sizes(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::size_t> sizes(count);
  for (std::size_t& size : sizes) {
    constexpr std::size_t most[] = {0, 1, 3, 12, 12, 70, 150, 400};
    size = random.index(most[random.index(8)] + 1);
  }
  return sizes;
}

/// What searches of their own find, one after the other. Without filters if not `filtered`.
template <class S>
PairsOfSets search_each(const ManySets<S>& sets, bool filtered) {
  PairsOfSets all{{}, {0}};
  Detector detector;
  Pairs pairs;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    detector.find_pairs(sets.set(i), pairs, filtered ? sets.filters_of(i) : Filters());
    const auto first = static_cast<std::uint32_t>(sets.offsets[i]);
    for (const Pair p : pairs) all.pairs.push_back({p.a + first, p.b + first});
    all.offsets.push_back(all.pairs.size());
  }
  return all;
}

template <class S>
PairsOfSets search_each(const ManySets<S>& a, const ManySets<S>& b, bool filtered) {
  PairsOfSets all{{}, {0}};
  Detector detector;
  Pairs pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (filtered)
      detector.find_pairs(a.set(i), b.set(i), pairs, a.filters_of(i), b.filters_of(i));
    else
      detector.find_pairs(a.set(i), b.set(i), pairs);
    for (const Pair p : pairs)
      all.pairs.push_back(
          {p.a + static_cast<std::uint32_t>(a.offsets[i]), p.b + static_cast<std::uint32_t>(b.offsets[i])});
    all.offsets.push_back(all.pairs.size());
  }
  return all;
}

inline void expect_same_sets(const PairsOfSets& found, const PairsOfSets& expected, const std::string& what) {
  EXPECT_EQ(found.offsets, expected.offsets) << what;
  ASSERT_EQ(found.pairs.size(), expected.pairs.size()) << what;
  const auto [f, e] = std::mismatch(found.pairs.begin(), found.pairs.end(), expected.pairs.begin());
  if (f == found.pairs.end()) return;
  ADD_FAILURE() << what << ": pair " << f - found.pairs.begin() << " is (" << f->a << ", " << f->b << "), not (" << e->a
                << ", " << e->b << ")";
}

}  // namespace boxstream::tests
