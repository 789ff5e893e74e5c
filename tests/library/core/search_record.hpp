// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "oracle.hpp"

namespace boxstream::tests {

/// All that four searches gave: one set and two, collected and streamed; pairs in their order, and counts.
struct SearchRecord {
  Pairs pairs[4];
  Stats stats[4];
};

template <class S>
SearchRecord search_all(Detector& detector, const Boxes<S>& a, const Boxes<S>& b) {
  SearchRecord record;
  const auto append_to = [](Pairs& pairs) {
    return [&pairs](Span<const Pair> more) {
      pairs.insert(pairs.end(), more.begin(), more.end());
      return true;
    };
  };
  record.stats[0] = detector.find_pairs(a, record.pairs[0]);
  record.stats[1] = detector.find_pairs(a, b, record.pairs[1]);
  record.stats[2] = detector.stream_pairs(a, append_to(record.pairs[2]));
  record.stats[3] = detector.stream_pairs(a, b, append_to(record.pairs[3]));
  return record;
}

inline void expect_same_search(const SearchRecord& found, const SearchRecord& expected) {
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(i % 2 == 0 ? "one set" : "two sets");
    SCOPED_TRACE(i < 2 ? "collected" : "streamed");
    ASSERT_EQ(found.pairs[i].size(), expected.pairs[i].size());
    const auto [f, e] = std::mismatch(found.pairs[i].begin(), found.pairs[i].end(), expected.pairs[i].begin());
    if (f != found.pairs[i].end()) {
      Pairs one = found.pairs[i], other = expected.pairs[i];
      std::sort(one.begin(), one.end());
      std::sort(other.begin(), other.end());
      FAIL() << (one == other ? "same pairs, but their order differs" : "pairs differ") << " from position "
             << f - found.pairs[i].begin() << " on: (" << f->a << ", " << f->b << ") instead of (" << e->a << ", "
             << e->b << ")";
    }
    const Stats &s = found.stats[i], &t = expected.stats[i];
    EXPECT_EQ(s.boxes, t.boxes);
    EXPECT_EQ(s.invalid, t.invalid);
    EXPECT_EQ(s.pairs, t.pairs);
    EXPECT_EQ(s.pairs, found.pairs[i].size());
    EXPECT_EQ(s.nodes, t.nodes);
    EXPECT_EQ(s.cells, t.cells);
    EXPECT_EQ(s.records, t.records);
    EXPECT_EQ(s.tests, t.tests);
    EXPECT_EQ(s.over_budget, t.over_budget);
  }
}

}  // namespace boxstream::tests
