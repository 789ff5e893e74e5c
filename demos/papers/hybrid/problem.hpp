// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include <boxstream/function_ref.hpp>

namespace boxstream::papers {

/// Receives the numbers of two boxes that intersect: complete case, the smaller one first; bipartite case, the one of
/// the first set first.
using Found = FunctionRef<void(std::uint32_t, std::uint32_t)>;

enum class Case { complete, bipartite };

/// The set that a procedure views as intervals: the one that the first initial call views so (A), or the other (B).
enum class View { first, second };

constexpr View other(View view) {
  return view == View::first ? View::second : View::first;
}

/// What all procedures use of boxes, and the one place where ties are decided.
///
/// Property 2 of the paper, "one interval contains the low end of the other", gives two disjoint cases for intervals in
/// general position only; of ties the paper says no more than that they are accounted for. Here boxes of A come before
/// boxes of B with the same low end. In integers that needs no new comparison: A viewed as intervals is used as
/// printed, [lo, hi), and B viewed as intervals as [lo + 1, hi). For any two boxes, exactly one of
///     lo_a <= lo_b < hi_a  and  lo_b < lo_a < hi_b
/// holds when they intersect, and none otherwise.
///
/// In the complete case A = B at the top level, where a tie is therefore met from both sides, as is each box with
/// itself. `report` keeps the one whose interval has the smaller number; deeper levels are bipartite.
template <class Access>
class Problem {
 public:
  /// `top` is the dimension of the outermost call. Only the complete case needs it.
  Problem(Access access, Case kind, int top, Found found) : access_(access), kind_(kind), top_(top), found_(found) {}

  template <class Element>
  std::int32_t lo(const Element& e, int d) const {
    return access_.lo(e, d);
  }
  template <class Element>
  std::int32_t hi(const Element& e, int d) const {
    return access_.hi(e, d);
  }

  /// The first point that `e`, viewed as an interval, contains.
  template <class Element>
  std::int32_t begin(const Element& e, int d, View view) const {
    return access_.lo(e, d) + (view == View::second);
  }

  /// Interval against point.
  template <class Element>
  bool contains(const Element& interval, const Element& point, int d, View view) const {
    return begin(interval, d, view) <= lo(point, d) && lo(point, d) < hi(interval, d);
  }

  /// Interval against interval, in the dimensions `first` .. `last`.
  template <class Element>
  bool intersect(const Element& a, const Element& b, int first, int last) const {
    for (int d = first; d <= last; ++d)
      if (lo(a, d) >= hi(b, d) || lo(b, d) >= hi(a, d)) return false;
    return true;
  }

  template <class Element>
  void report(const Element& interval, const Element& point, View view) const {
    const Element& a = view == View::first ? interval : point;
    const Element& b = view == View::first ? point : interval;
    const std::uint32_t number_a = access_.number(a), number_b = access_.number(b);
    if (kind_ == Case::bipartite) return found_(number_a, number_b);
    if (number_a >= number_b && lo(a, top_) == lo(b, top_)) return;
    found_(std::min(number_a, number_b), std::max(number_a, number_b));
  }

 private:
  Access access_;
  Case kind_;
  int top_;
  Found found_;
};

}  // namespace boxstream::papers
