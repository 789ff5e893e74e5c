// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "papers/hybrid/procedures.hpp"

/// What is true of half-open integer boxes, by nothing but comparisons of each with each.
namespace boxstream::papers::tests {

using Pairs = std::vector<Pair>;

inline bool meet(const Box& a, const Box& b) {
  for (int d = 0; d < 3; ++d)
    if (std::max(a.projections[d].lo, b.projections[d].lo) >= std::min(a.projections[d].hi, b.projections[d].hi))
      return false;
  return true;
}

inline Pairs truth(const std::vector<Box>& boxes) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (meet(boxes[i], boxes[j])) pairs.push_back({i, j});
  return pairs;
}

inline Pairs truth(const std::vector<Box>& a, const std::vector<Box>& b) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (meet(a[i], b[j])) pairs.push_back({i, j});
  return pairs;
}

inline std::string text(const std::vector<Box>& boxes) {
  std::string text;
  for (const Box& box : boxes) {
    for (const Interval& i : box.projections) text += "[" + std::to_string(i.lo) + ", " + std::to_string(i.hi) + ") ";
    text += "; ";
  }
  return text;
}

/// `found` in any order; false, with the first difference reported, when it is not `expected`, each pair once.
inline bool same_pairs(Pairs found, const Pairs& expected, const std::string& what) {
  std::sort(found.begin(), found.end());
  const auto [f, e] = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end());
  const auto show = [](auto it, auto end) {
    return it == end ? std::string("none") : std::to_string(it->a) + " " + std::to_string(it->b);
  };
  EXPECT_TRUE(found == expected) << what << ": " << found.size() << " pairs of " << expected.size()
                                 << "; first difference: found " << show(f, found.end()) << ", expected "
                                 << show(e, expected.end());
  return found == expected;
}

/// The pairs that `search(found)` reports, in its order.
template <class Search>
Pairs collect(const Search& search) {
  Pairs pairs;
  search([&](std::uint32_t a, std::uint32_t b) { pairs.push_back({a, b}); });
  return pairs;
}

/// Every procedure in the complete case.
inline bool check_all(const std::vector<Box>& boxes, const HybridOptions& options, const std::string& what) {
  const Pairs expected = truth(boxes);
  for (const Procedure procedure : procedures())
    if (!same_pairs(collect([&](auto&& found) { run(procedure, Span<const Box>(boxes), options, found); }), expected,
                    std::string(name(procedure)) + ", " + what + (boxes.size() < 6 ? ": " + text(boxes) : "")))
      return false;
  return true;
}

/// Every procedure in the bipartite case.
inline bool check_all(const std::vector<Box>& a, const std::vector<Box>& b, const HybridOptions& options,
                      const std::string& what) {
  const Pairs expected = truth(a, b);
  for (const Procedure procedure : procedures())
    if (!same_pairs(
            collect([&](auto&& found) { run(procedure, Span<const Box>(a), Span<const Box>(b), options, found); }),
            expected,
            std::string(name(procedure)) + ", " + what +
                (a.size() + b.size() < 6 ? ": " + text(a) + " and " + text(b) : "")))
      return false;
  return true;
}

}  // namespace boxstream::papers::tests
