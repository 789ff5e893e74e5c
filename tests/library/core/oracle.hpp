// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/pair.hpp>

/// The truth that every search is compared with: all pairs, tested one by one. It uses nothing of the library but its
/// value types, so that a fault in `overlaps` or `is_valid` cannot hide itself.
namespace boxstream::tests {

template <class S>
using Boxes = std::vector<BasicAabb<S>>;
using Pairs = std::vector<Pair>;
using Filters = std::vector<Filter>;

template <class S>
bool makes_sense(const BasicAabb<S>& box) {
  for (int d = 0; d < 3; ++d)
    if (!(box.min[d] <= box.max[d])) return false;
  return true;
}

template <class S>
bool touch(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  for (int d = 0; d < 3; ++d)
    if (a.max[d] < b.min[d] || b.max[d] < a.min[d]) return false;
  return true;
}

inline bool permit(Filter a, Filter b) {
  return (a.group & b.mask) != 0u && (b.group & a.mask) != 0u;
}

inline bool permitted(const Filters& fa, std::size_t i, const Filters& fb, std::size_t j) {
  return permit(fa.empty() ? Filter{1, 0xffffffffu} : fa[i], fb.empty() ? Filter{1, 0xffffffffu} : fb[j]);
}

/// Pairs within one set, sorted.
template <class S>
Pairs brute_force(const Boxes<S>& boxes, const Filters& filters = {}) {
  Pairs pairs;
  const auto n = static_cast<std::uint32_t>(boxes.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!makes_sense(boxes[i])) continue;
    for (std::uint32_t j = i + 1; j < n; ++j)
      if (touch(boxes[i], boxes[j]) && makes_sense(boxes[j]) && permitted(filters, i, filters, j))
        pairs.push_back({i, j});
  }
  return pairs;
}

/// Pairs between two sets, sorted.
template <class S>
Pairs brute_force(const Boxes<S>& a, const Boxes<S>& b, const Filters& fa = {}, const Filters& fb = {}) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (!makes_sense(a[i])) continue;
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (touch(a[i], b[j]) && makes_sense(b[j]) && permitted(fa, i, fb, j)) pairs.push_back({i, j});
  }
  return pairs;
}

template <class S>
std::size_t count_invalid(const Boxes<S>& boxes) {
  return static_cast<std::size_t>(
      std::count_if(boxes.begin(), boxes.end(), [](const BasicAabb<S>& box) { return !makes_sense(box); }));
}

/// All six bounds, in decimal that reads back exactly and in hexadecimal.
template <class S>
std::string describe(const BasicAabb<S>& box) {
  std::string text;
  char buffer[128];
  for (int d = 0; d < 3; ++d) {
    const double lo = static_cast<double>(box.min[d]), hi = static_cast<double>(box.max[d]);
    std::snprintf(buffer, sizeof buffer, "%s[%.17g, %.17g] (%a, %a)", d != 0 ? " x " : "", lo, hi, lo, hi);
    text += buffer;
  }
  return text;
}

/// Says how the found pairs (in any order) differ from the sorted truth, by the first difference; empty if they do not.
/// For one set pass the same boxes twice.
template <class S>
std::string first_difference(Pairs found, const Pairs& expected, const Boxes<S>& a, const Boxes<S>& b) {
  std::sort(found.begin(), found.end());
  if (found == expected) return {};
  const auto [f, e] = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end());
  Pair pair{};
  std::string kind;
  if (f != found.begin() && f != found.end() && *f == *(f - 1)) {
    pair = *f;
    kind = "duplicate";
  } else if (e == expected.end() || (f != found.end() && *f < *e)) {
    pair = *f;
    kind = "extra";
  } else {
    pair = *e;
    kind = "missing";
  }
  std::string text = kind + " pair (" + std::to_string(pair.a) + ", " + std::to_string(pair.b) + "); found " +
                     std::to_string(found.size()) + " pairs, expected " + std::to_string(expected.size());
  if (pair.a < a.size() && pair.b < b.size()) text += "\n  a: " + describe(a[pair.a]) + "\n  b: " + describe(b[pair.b]);
  return text;
}

}  // namespace boxstream::tests
