// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include <boxstream/span.hpp>

#include "papers/hybrid/problem.hpp"

/// Scans need their sets in the order of the low ends in dimension 0. Section 4 has two methods for that.
namespace boxstream::papers {

template <class Access, class Element>
void sort_by_low_end(const Problem<Access>& problem, Span<Element> elements) {
  std::sort(elements.begin(), elements.end(),
            [&](const Element& a, const Element& b) { return problem.lo(a, 0) < problem.lo(b, 0); });
}

/// Option 2: sets are parted as Quicksort parts them, and sorted just before a scan. No memory beside the sets.
struct SortToScan {
  /// Moves the elements that satisfy `belongs` to the front and returns their number.
  template <class Element, class Belongs>
  std::size_t part(Span<Element> elements, const Belongs& belongs) const {
    return static_cast<std::size_t>(std::partition(elements.begin(), elements.end(), belongs) - elements.begin());
  }
  template <class Access, class Element>
  void before_scan(const Problem<Access>& problem, Span<Element> elements) const {
    sort_by_low_end(problem, elements);
  }
  /// What follows when the two parts that `part` made are done with.
  template <class Access, class Element>
  void join(const Problem<Access>&, Span<Element>, std::size_t) const {}
};

/// Option 1: sets are sorted once, parted in a stable way, and merged again (the paper's step 8). `temporary` has room
/// for the larger one of the two initial sets; no call leaves anything in it.
template <class Element>
struct KeepSorted {
  Element* temporary;

  template <class Belongs>
  std::size_t part(Span<Element> elements, const Belongs& belongs) const {
    Element* front = elements.begin();
    Element* back = temporary;
    for (const Element e : elements) *(belongs(e) ? front++ : back++) = e;
    std::copy(temporary, back, front);
    return static_cast<std::size_t>(front - elements.begin());
  }
  template <class Access>
  void before_scan(const Problem<Access>&, Span<Element>) const {}
  template <class Access>
  void join(const Problem<Access>& problem, Span<Element> elements, std::size_t front) const {
    if (front == 0 || front == elements.size()) return;
    const Element* a = temporary;
    const Element* const a_end = std::copy(elements.begin(), elements.begin() + front, temporary);
    const Element* b = elements.begin() + front;
    Element* to = elements.begin();
    while (a != a_end && b != elements.end()) *to++ = problem.lo(*b, 0) < problem.lo(*a, 0) ? *b++ : *a++;
    std::copy(a, a_end, to);
  }
};

}  // namespace boxstream::papers
