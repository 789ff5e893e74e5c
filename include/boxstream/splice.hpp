// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

namespace boxstream {

/// Removals and insertions of an array: `removed` are indices before, `inserted` indices after; both ascending, without
/// duplicates. Other elements keep their order.
struct Splice {
  Span<const std::uint32_t> removed;
  Span<const std::uint32_t> inserted;

  bool empty() const { return removed.empty() && inserted.empty(); }
};

/// Calls `visit(from, count, to)` for each run of remaining elements of an array of `size`, in order.
template <class Visit>
void for_each_run(std::size_t size, const Splice& splice, Visit&& visit) {
  std::size_t begin = 0, less = 0, more = 0;
  while (true) {
    const std::size_t leaves = less < splice.removed.size() ? splice.removed[less] : size;
    const std::size_t place = more < splice.inserted.size() ? splice.inserted[more] + less - more : size;
    const std::size_t end = std::min(leaves, place);
    if (begin < end) visit(begin, end - begin, begin + more - less);
    begin = end;
    if (more < splice.inserted.size() && place <= leaves) {
      ++more;
    } else if (less < splice.removed.size()) {
      ++less;
      ++begin;
    } else {
      return;
    }
  }
}

/// As for_each_run for runs that move, in an order in which no run overwrites another one that is still to be moved.
template <class Move>
void move_runs(std::size_t size, const Splice& splice, Move&& move) {
  for_each_run(size, splice, [&](std::size_t from, std::size_t count, std::size_t to) {
    if (to < from) move(from, count, to);
  });
  std::size_t end = size, less = splice.removed.size(), more = splice.inserted.size();
  while (less != 0 || more != 0) {
    const std::size_t left = less != 0 ? splice.removed[less - 1] + std::size_t{1} : 0;
    const std::size_t place = more != 0 ? splice.inserted[more - 1] + less - (more - 1) : 0;
    const std::size_t begin = std::max(left, place);
    if (more > less && begin < end) move(begin, end - begin, begin + more - less);
    const bool came = more != 0 && place >= left;
    came ? --more : --less;
    end = came ? begin : left - 1;
  }
}

/// Splices in place; each element is moved at most once. Elements at `inserted` are unspecified: the caller overwrites
/// them. std::bad_alloc leaves the array unchanged, if elements move without exceptions.
template <class T>
void splice(std::vector<T>& elements, const Splice& splice) {
  const std::size_t size = elements.size();
  const std::size_t next_size = size + splice.inserted.size() - splice.removed.size();
  if (next_size > size) elements.resize(next_size);
  move_runs(size, splice, [&](std::size_t from, std::size_t count, std::size_t to) {
    T* const first = elements.data() + from;
    if (to < from)
      std::move(first, first + count, elements.data() + to);
    else
      std::move_backward(first, first + count, elements.data() + to + count);
  });
  if (next_size < size) elements.resize(next_size);
}

}  // namespace boxstream
