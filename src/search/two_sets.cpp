// SPDX-License-Identifier: MIT
#include "search/two_sets.hpp"

#include <algorithm>
#include <bit>

#include "search/columns.hpp"

namespace boxstream::detail {

template <class S>
bool CrossSearch::join_few(const BoxSource<S>& few, const BoxSource<S>& many, bool few_first) {
  FewBoxes columns;
  columns.valid = few.load(0, few.size(), columns.columns);
  const auto size = static_cast<std::size_t>(std::popcount(columns.valid));
  std::size_t valid = size;
  for (std::size_t begin = 0; begin < many.size(); begin += load_block) {
    BoxColumns block;
    valid +=
        static_cast<std::size_t>(std::popcount(many.load(begin, std::min(load_block, many.size() - begin), block)));
    if (!compare_few(columns, block, static_cast<std::uint32_t>(begin), few_first, pairs)) return false;
  }
  ++stats.cells;
  stats.invalid += few.size() + many.size() - valid;
  stats.records += valid;
  stats.tests += size * (valid - size);
  return true;
}

template <class S>
bool CrossSearch::join(const BoxSource<S>& a, const BoxSource<S>& b, Tree& tree) {
  if (a.size() != 0 && b.size() != 0 && std::min(a.size(), b.size()) <= load_block)
    return a.size() <= b.size() ? join_few(a, b, true) : join_few(b, a, false);
  return tree.join_cross(a, b, {});
}

template bool CrossSearch::join(const BoxSource<float>&, const BoxSource<float>&, Tree&);
template bool CrossSearch::join(const BoxSource<double>&, const BoxSource<double>&, Tree&);

}  // namespace boxstream::detail
