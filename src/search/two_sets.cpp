// SPDX-License-Identifier: MIT
#include "search/two_sets.hpp"

#include <algorithm>
#include <bit>

#include "search/columns.hpp"
#include "search/cull.hpp"

namespace boxstream::detail {

namespace {

// To compare a box with one block of few takes no longer than to see whether it can be culled: a tenth of a nanosecond
// for each.
constexpr std::size_t few = load_block;
// To compare it with so many takes no longer than to join it with them where they are not apart.
constexpr std::size_t most_few = 3 * few;

}  // namespace

template <class S>
bool CrossSearch::join_few(const BoxSource<S>& few_boxes, const BoxSource<S>& many, bool few_first) {
  using Key = decltype(order_key(S()));
  FewBoxes<Key> blocks[most_few / load_block];
  std::size_t count = 0, valid_few = 0, valid = 0;
  for (std::size_t begin = 0; begin < few_boxes.size(); begin += load_block, ++count) {
    FewBoxes<Key>& block = blocks[count];
    block.first_id = static_cast<std::uint32_t>(begin);
    block.valid = few_boxes.load(begin, std::min(load_block, few_boxes.size() - begin), block.columns);
    valid_few += static_cast<std::size_t>(std::popcount(block.valid));
  }
  for (std::size_t begin = 0; begin < many.size(); begin += load_block) {
    BoxColumnsOf<Key> columns;
    const std::size_t size = std::min(load_block, many.size() - begin);
    valid += static_cast<std::size_t>(std::popcount(many.load(begin, size, columns)));
    for (std::size_t i = 0; i < count; ++i)
      if (!compare_few(blocks[i], columns, size, static_cast<std::uint32_t>(begin), few_first, pairs)) return false;
  }
  ++stats.cells;
  stats.invalid += few_boxes.size() - valid_few + many.size() - valid;
  stats.records += valid_few + valid;
  stats.tests += valid_few * valid;
  return true;
}

template <class S>
bool CrossSearch::join(const BoxSource<S>& a, const BoxSource<S>& b, Tree& tree) {
  const std::size_t smaller = std::min(a.size(), b.size());
  if (smaller == 0) return tree.join_cross(a, b, {});
  const auto compare_all = [&] { return a.size() == smaller ? join_few(a, b, true) : join_few(b, a, false); };
  if (smaller <= few) return compare_all();
  bool was_tried = false;
  if (const std::optional<bool> done = join_culled(a, b, tree, was_tried)) return *done;
  return was_tried && smaller <= most_few ? compare_all() : tree.join_cross(a, b, {});
}

bool CrossSearch::join(const RecordSource& a, const RecordSource& b, Tree& tree) {
  bool was_tried = false;
  const std::optional<bool> done = join_culled(a, b, tree, was_tried);
  return done ? *done : tree.join_cross(a, b, {});
}

template <class Source>
std::optional<bool> CrossSearch::join_culled(const Source& a, const Source& b, Tree& tree, bool& was_tried) {
  const Arena::Frame frame(arena);
  const Culled culled = cull(a, b, kinds, arena);
  was_tried = culled.tried;
  if (!culled.worthwhile) return std::nullopt;
  stats.invalid += culled.invalid;
  return tree.join_cross(RecordSource(culled.a), RecordSource(culled.b), {});
}

template bool CrossSearch::join(const BoxSource<float>&, const BoxSource<float>&, Tree&);
template bool CrossSearch::join(const BoxSource<double>&, const BoxSource<double>&, Tree&);

}  // namespace boxstream::detail
