// SPDX-License-Identifier: MIT
#include "batch/segment_tree.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/thresholds.hpp"
#include "batch/ranked_lows.hpp"

namespace boxstream::detail {

namespace {

constexpr std::size_t leaf = thresholds.segment_tree_leaf;

/// Brings the records that `goes_first` picks to the front, in an order that no library decides, and counts them.
template <class Predicate>
std::size_t bring_forward(Record* records, std::size_t size, Predicate&& goes_first) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < size; ++i)
    if (goes_first(records[i])) std::swap(records[i], records[first++]);
  return first;
}

}  // namespace

SegmentTree::Set SegmentTree::copy(const Record* records, std::size_t size) {
  auto* const to = arena_.allocate<Record>(size);
  std::copy_n(records, size, to);
  return {to, size, 0};
}

bool SegmentTree::join_self(Span<const Record> records) {
  const Arena::Frame frame(arena_);
  return begin_axis({{copy(records.data(), records.size()), {}}, 1}, 7);
}

bool SegmentTree::join_cross(Span<const Record> a, Span<const Record> b) {
  const Arena::Frame frame(arena_);
  return begin_axis({{copy(a.data(), a.size()), copy(b.data(), b.size())}, 2}, 7);
}

/// Whether a point can meet anything.
bool SegmentTree::has_pairs(const Node& node) const {
  const Set &a = node.set[0], &b = node.set[1];
  if (node.sets == 1) return a.points > 0 && a.size() > 1;
  return (a.points > 0 && b.size() > 0) || (b.points > 0 && a.size() > 0);
}

bool SegmentTree::sweep_self(Span<const Record> records, const SweepPlan& plan) {
  if (records.size() < 2) return true;
  ++stats_.cells;
  stats_.records += records.size();
  return detail::sweep_self(records, plan, sweep_);
}

bool SegmentTree::sweep_cross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan) {
  if (a.empty() || b.empty()) return true;
  ++stats_.cells;
  stats_.records += a.size() + b.size();
  return detail::sweep_cross(a, b, plan, sweep_);
}

bool SegmentTree::sweep_leaf(const Node& node, int axis) {
  SweepPlan plan;
  plan.axis = axis;
  const Set &a = node.set[0], &b = node.set[1];
  if (node.sets == 1) return sweep_self({a.records, a.size()}, plan);
  return sweep_cross({a.records, a.size()}, {b.records, b.size()}, plan);
}

/// Goes on with the next of `axes`, for boxes that overlap on all others.
bool SegmentTree::begin_axis(Node node, unsigned axes) {
  const int axis = std::countr_zero(axes);
  if (node.size() <= leaf) return sweep_leaf(node, axis);
  for (Set& set : node.set) {
    const std::size_t points =
        bring_forward(set.records, set.size(), [axis](const Record& r) { return (r.before >> axis & 1) == 0; });
    set = {set.records, points, set.size() - points};
  }
  return axes == 1u << axis ? sweep_last(node, axis) : cut(node, {axis, axes});
}

/// What overlaps on the last axis is a pair, if the region owns it on that axis: others do not meet others. There are
/// two sets, for those that span a node were joined with its points twice.
bool SegmentTree::sweep_last(const Node& node, int axis) {
  using First = SweepPlan::First;
  const auto points = [](const Set& set) { return Span<const Record>(set.records, set.points); };
  const auto others = [](const Set& set) { return Span<const Record>(set.records + set.points, set.others); };
  const auto plan = [axis](First first) {
    SweepPlan sorted;
    sorted.axis = axis;
    sorted.sorted = true;
    sorted.first = first;
    return sorted;
  };
  const Set &a = node.set[0], &b = node.set[1];
  return sweep_cross(points(a), points(b), plan(First::either)) && sweep_cross(points(a), others(b), plan(First::b)) &&
         sweep_cross(others(a), points(b), plan(First::a));
}

bool SegmentTree::cut(Node node, Axes axes) {
  if (!join_spanning(node, axes)) return false;
  if (!has_pairs(node)) return true;
  if (node.size() <= leaf) return sweep_leaf(node, axes.current);

  const Arena::Frame frame(arena_);
  const std::uint64_t cut_at = median(node, axes.current);
  Node right{{}, node.sets};
  std::uint32_t first_rank = 0;
  for (int s = 0; s < node.sets; ++s) {
    Set& set = node.set[s];
    const std::size_t points = set.points;
    right.set[s] = take_right(set, axes.current, cut_at, first_rank, key_of(cut_at));
    first_rank += static_cast<std::uint32_t>(points);
  }
  return cut(node, axes) && cut(right, axes);
}

/// Takes out the others that reach beyond the last point, and those that end before the first.
bool SegmentTree::join_spanning(Node& node, Axes axes) {
  const int axis = axes.current;
  std::int32_t first = INT32_MAX, last = INT32_MIN;
  for (const Set& set : node.set)
    for (const Record* r = set.records; r != set.records + set.points; ++r) {
      first = std::min(first, r->lo[axis]);
      last = std::max(last, r->lo[axis]);
    }
  Span<const Record> spanning[2];
  for (int s = 0; s < node.sets; ++s) {
    Set& set = node.set[s];
    Record* const others = set.records + set.points;
    const std::size_t ending = bring_forward(others, set.others, [&](const Record& r) { return r.hi[axis] < last; });
    spanning[s] = {others + ending, set.others - ending};
    set.others = bring_forward(others, ending, [&](const Record& r) { return r.hi[axis] >= first; });
  }
  const auto join = [&](const Set& points, Span<const Record> span, bool points_first) {
    if (points.points == 0 || span.empty()) return true;
    const Arena::Frame frame(arena_);
    const Set p = copy(points.records, points.points), s = copy(span.data(), span.size());
    const unsigned left = axes.left & ~(1u << axis);
    return points_first ? begin_axis({{p, s}, 2}, left) : begin_axis({{s, p}, 2}, left);
  };
  if (node.sets == 1) return join(node.set[0], spanning[0], true);
  return join(node.set[0], spanning[1], true) && join(node.set[1], spanning[0], false);
}

/// The ranked low end of the first point of the right half. Points rank by low end and, among equals, by place.
std::uint64_t SegmentTree::median(const Node& node, int axis) {
  const Arena::Frame frame(arena_);
  const std::size_t n = node.points();
  auto* const ranks = arena_.allocate<std::uint64_t>(n);
  std::size_t rank = 0;
  for (const Set& set : node.set)
    for (std::size_t i = 0; i < set.points; ++i, ++rank) ranks[rank] = ranked(set.records[i].lo[axis], rank);
  std::nth_element(ranks, ranks + n / 2, ranks + n);
  return ranks[n / 2];
}

/// Leaves the left half in `set`, and gives the right one: its points, and as others those that reach it. So the two
/// halves together take no more than the right one's room beyond what there was.
SegmentTree::Set SegmentTree::take_right(Set& set, int axis, std::uint64_t median, std::uint32_t first_rank,
                                         std::int32_t right_begin) {
  Set right{arena_.allocate<Record>(set.size()), 0, 0};
  std::size_t left_points = 0;
  for (std::size_t i = 0; i < set.points; ++i) {
    const Record r = set.records[i];
    if (ranked(r.lo[axis], first_rank + i) < median)
      set.records[left_points++] = r;
    else
      right.records[right.points++] = r;
  }
  const auto add_if_reaches = [&](Record r) {
    if (r.hi[axis] < right_begin) return;
    r.before |= 1u << axis;
    right.records[right.points + right.others++] = r;
  };
  for (std::size_t i = 0; i < left_points; ++i) add_if_reaches(set.records[i]);
  for (std::size_t i = set.points; i < set.size(); ++i) {
    add_if_reaches(set.records[i]);
    set.records[left_points + i - set.points] = set.records[i];
  }
  set.points = left_points;
  return right;
}

}  // namespace boxstream::detail
