// SPDX-License-Identifier: MIT
#include "search/two_sets.hpp"

#include <algorithm>

#include "search/columns.hpp"
#include "search/cull.hpp"

namespace boxstream::detail {

namespace {

// To compare a box with one block of few takes no longer than to see whether it can be culled: a tenth of a nanosecond
// for each.
constexpr std::size_t few = load_block;

}  // namespace

template <class S>
bool CrossSearch::join_few(const BoxSource<S>& few_boxes, const BoxSource<S>& many, bool few_first) {
  FewAndMany valid;
  if (!compare_few(few_boxes.boxes(), many.boxes(), few_first, pairs, valid)) return false;
  ++stats.cells;
  stats.invalid += few_boxes.size() - valid.few + many.size() - valid.many;
  stats.records += valid.few + valid.many;
  stats.tests += valid.few * valid.many;
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
