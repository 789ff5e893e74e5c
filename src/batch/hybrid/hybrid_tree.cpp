// SPDX-License-Identifier: MIT
#include "batch/hybrid/hybrid_tree.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <optional>
#include <utility>

#include "base/thresholds.hpp"
#include "batch/hybrid/hybrid_sample.hpp"
#include "batch/leaf/ranked_lows.hpp"

namespace boxstream::detail {

namespace {

// An approximate median takes three points.
constexpr std::size_t fewest_to_cut = 3;

using Scans = HybridRules::Scans;

/// Moves the records that `goes_first` picks to the front and counts them; in an order that is the same everywhere.
template <class Predicate>
std::size_t bring_forward(Record* records, std::size_t size, Predicate&& goes_first) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < size; ++i)
    if (goes_first(records[i])) std::swap(records[i], records[first++]);
  return first;
}

Span<const Record> points_of(const HybridTree::Set& set) {
  return {set.records, set.points};
}
Span<const Record> others_of(const HybridTree::Set& set) {
  return {set.records + set.points, set.others};
}
Span<const Record> all_of(const HybridTree::Set& set) {
  return {set.records, set.size()};
}

Span<Record> copied(Span<const Record> records, Arena& arena) {
  auto* const to = arena.allocate<Record>(records.size());
  std::copy_n(records.data(), records.size(), to);
  return {to, records.size()};
}

/// A Frame, or none where the allocations are to outlive the call.
class OptionalFrame {
 public:
  explicit OptionalFrame(Arena* arena) {
    if (arena != nullptr) frame_.emplace(*arena);
  }

 private:
  std::optional<Arena::Frame> frame_;
};

/// What is left of a scan over its budget.
struct RestOfScan {
  bool is_self;
  SweepContext& sweep;
  Stats& stats;
  bool operator()(Span<const Record> a, Span<const Record> b) const {
    return join_bounded(a, b, is_self, sweep, stats);
  }
};

/// How many pairs a scan of a node may compare: those with a point.
std::uint64_t pairs_of(const HybridTree::Node& node) {
  const auto of = [](std::size_t a, std::size_t b) { return std::uint64_t{a} * b; };
  const HybridTree::Set &a = node.set[0], &b = node.set[1];
  if (node.sets == 1) return of(a.points, a.points) / 2 + of(a.points, a.others);
  return of(a.points, b.size()) + of(a.others, b.points);
}

}  // namespace

bool HybridTree::join_self(Span<Record> records) {
  return begin_axis({{{records.data(), records.size(), 0}, {}}, 1}, 2);
}

bool HybridTree::join_cross(Span<Record> a, Span<Record> b) {
  return begin_axis({{{a.data(), a.size(), 0}, {b.data(), b.size(), 0}}, 2}, 2);
}

/// Whether a point can meet anything.
bool HybridTree::has_pairs(const Node& node) const {
  const Set &a = node.set[0], &b = node.set[1];
  if (node.sets == 1) return a.points > 0 && a.size() > 1;
  return (a.points > 0 && b.size() > 0) || (b.points > 0 && a.size() > 0);
}

bool HybridTree::is_scanned(const Node& node) const {
  const Set &a = node.set[0], &b = node.set[1];
  switch (rules_.scans) {
    case Scans::bounded:
      return node.size() <= thresholds.bounded_leaf;
    case Scans::below_cutoff: {
      // In both views, each of which alone would be enough for one of the paper's two trees.
      const auto is_small = [&](const Set& intervals, const Set& points) {
        return intervals.size() < rules_.cutoff || points.points < rules_.cutoff;
      };
      return node.sets == 1 ? is_small(a, a) : is_small(a, b) && is_small(b, a);
    }
    case Scans::sampled:
      break;
  }
  return tests_of_scan(node) <= thresholds.tests_of_cut * node.size();
}

/// As a sample tells them; no sample is taken where all pairs are few.
std::uint64_t HybridTree::tests_of_scan(const Node& node) const {
  const std::uint64_t all = pairs_of(node);
  if (all <= thresholds.tests_of_cut * node.size()) return all;
  const OverlapSample sample = node.sets == 1
                                   ? OverlapSample(points_of(node.set[0]), all_of(node.set[0]), rules_.axis[0])
                                   : OverlapSample(all_of(node.set[0]), all_of(node.set[1]), rules_.axis[0]);
  return all / sample.pairs() * sample.overlapping() + all % sample.pairs() * sample.overlapping() / sample.pairs();
}

bool HybridTree::sweep_self(Span<const Record> records, SweepPlan plan) {
  if (records.size() < 2) return true;
  ++stats_.cells;
  stats_.records += records.size();
  const RestOfScan do_rest{true, sweep_, stats_};
  const SweepPlan::Rest rest = do_rest;
  if (rules_.scans == Scans::sampled) {
    plan.most_tests = records.size() * thresholds.tests_of_cut * thresholds.wrong_by;
    plan.rest = &rest;
  }
  return detail::sweep_self(records, plan, sweep_);
}

bool HybridTree::sweep_cross(Span<const Record> a, Span<const Record> b, SweepPlan plan) {
  if (a.empty() || b.empty()) return true;
  ++stats_.cells;
  stats_.records += a.size() + b.size();
  const RestOfScan do_rest{false, sweep_, stats_};
  const SweepPlan::Rest rest = do_rest;
  if (rules_.scans == Scans::sampled) {
    plan.most_tests = (a.size() + b.size()) * thresholds.tests_of_cut * thresholds.wrong_by;
    plan.rest = &rest;
  }
  return detail::sweep_cross(a, b, plan, sweep_);
}

/// Along the axis of the last dimension, on which no node is small. Others do not meet others: where these are many
/// they are not compared either.
bool HybridTree::scan(const Node& node) {
  if (!has_pairs(node)) return true;
  SweepPlan plan;
  plan.axis = rules_.axis[0];
  const Set &a = node.set[0], &b = node.set[1];
  if (node.others() <= node.points() || rules_.scans == Scans::bounded)
    return node.sets == 1 ? sweep_self(all_of(a), plan) : sweep_cross(all_of(a), all_of(b), plan);
  if (node.sets == 1) return sweep_self(points_of(a), plan) && sweep_cross(points_of(a), others_of(a), plan);
  return sweep_cross(points_of(a), points_of(b), plan) && sweep_cross(points_of(a), others_of(b), plan) &&
         sweep_cross(others_of(a), points_of(b), plan);
}

bool HybridTree::hand_out(const Node& node, int dimension, int levels_left) {
  Task* const task = new (arena_.allocate<Task>(1)) Task{node, dimension, levels_left, nullptr};
  (last_task_ == nullptr ? first_task_ : last_task_->next) = task;
  last_task_ = task;
  return true;
}

bool HybridTree::do_task(const Task& task) {
  const Arena::Frame frame(arena_);
  Node node = task.node;
  for (Set& set : node.set) set.records = copied(all_of(set), arena_).data();
  return task.levels_left == Task::not_begun ? begin_axis(node, task.dimension)
                                             : go_on(node, task.dimension, task.levels_left);
}

/// Goes on with a dimension, for boxes that overlap in all above.
bool HybridTree::begin_axis(Node node, int dimension) {
  if (is_task(node) || (is_collecting() && dimension == 0)) return hand_out(node, dimension, Task::not_begun);
  if (is_scanned(node)) return scan(node);
  const int axis = rules_.axis[dimension];
  for (Set& set : node.set) {
    const std::size_t points =
        bring_forward(set.records, set.size(), [axis](const Record& r) { return (r.before >> axis & 1) == 0; });
    set = {set.records, points, set.size() - points};
  }
  // Approximate medians may fail repeatedly on adversarial input: then exact medians are used.
  return dimension == 0 ? scan_last(node) : cut(node, dimension, 2 * std::bit_width(node.points()) + 8);
}

/// What overlaps in the last dimension is a pair, if the region owns it there: others do not meet others. There are
/// two sets, for those that span a node were joined with its points twice.
bool HybridTree::scan_last(const Node& node) {
  using First = SweepPlan::First;
  const auto plan = [this](First first) {
    SweepPlan scan;
    scan.axis = rules_.axis[0];
    scan.sorted = rules_.scans == Scans::bounded;
    scan.first = first;
    return scan;
  };
  const Set &a = node.set[0], &b = node.set[1];
  return sweep_cross(points_of(a), points_of(b), plan(First::either)) &&
         sweep_cross(points_of(a), others_of(b), plan(First::b)) &&
         sweep_cross(others_of(a), points_of(b), plan(First::a));
}

bool HybridTree::cut(Node node, int dimension, int levels_left) {
  const int axis = rules_.axis[dimension];
  const bool is_bounded = rules_.scans == Scans::bounded;
  if (!join_spanning(node, dimension)) return false;
  if (!has_pairs(node)) return true;
  if (is_bounded ? is_scanned(node) : node.points() < fewest_to_cut)
    return is_collecting() ? hand_out(node, dimension, levels_left) : scan(node);

  const OptionalFrame frame(is_collecting() ? nullptr : &arena_);
  const std::uint64_t cut_at = is_bounded || levels_left <= 0 ? exact_median(node, axis) : ApproxMedian(node, axis)();
  Node right{{}, node.sets};
  std::uint32_t first_rank = 0;
  for (int s = 0; s < node.sets; ++s) {
    Set& set = node.set[s];
    const std::size_t points = set.points;
    right.set[s] = take_right(set, axis, cut_at, first_rank, key_of(cut_at));
    first_rank += static_cast<std::uint32_t>(points);
  }
  ++stats_.nodes;
  return go_on(node, dimension, levels_left - 1) && go_on(right, dimension, levels_left - 1);
}

bool HybridTree::go_on(const Node& node, int dimension, int levels_left) {
  if (is_task(node)) return hand_out(node, dimension, levels_left);
  if (rules_.scans != Scans::bounded && is_scanned(node)) return scan(node);
  return cut(node, dimension, levels_left);
}

/// Takes out the others that reach beyond the last point, and those that end before the first.
bool HybridTree::join_spanning(Node& node, int dimension) {
  const int axis = rules_.axis[dimension];
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
    const OptionalFrame frame(is_collecting() ? nullptr : &arena_);
    const Set p = copy(points.records, points.points), s = copy(span.data(), span.size());
    return begin_axis(points_first ? Node{{p, s}, 2} : Node{{s, p}, 2}, dimension - 1);
  };
  if (node.sets == 1) return join(node.set[0], spanning[0], true);
  return join(node.set[0], spanning[1], true) && join(node.set[1], spanning[0], false);
}

/// The ranked low end of the first point of the right half. Points rank by low end and, among equals, by place.
std::uint64_t HybridTree::exact_median(const Node& node, int axis) {
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
HybridTree::Set HybridTree::take_right(Set& set, int axis, std::uint64_t median, std::uint32_t first_rank,
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

HybridTree::Set HybridTree::copy(const Record* records, std::size_t size) {
  return {copied({records, size}, arena_).data(), size, 0};
}

bool join_bounded(Span<const Record> a, Span<const Record> b, bool is_self, SweepContext& sweep, Stats& stats) {
  const Arena::Frame frame(sweep.arena);
  ++stats.over_budget;
  HybridTree tree(sweep, stats);
  const Span<Record> first = copied(a, sweep.arena);
  return is_self ? tree.join_self(first) : tree.join_cross(first, copied(b, sweep.arena));
}

void choose_axes(Span<const Record> a, Span<const Record> b, HybridRules& rules) {
  if (a.empty() || b.empty()) return;
  std::pair<std::uint64_t, int> overlap[3];
  for (int axis = 0; axis < 3; ++axis) overlap[axis] = {OverlapSample(a, b, axis).overlapping(), axis};
  std::sort(overlap, overlap + 3);
  rules.axis[0] = overlap[0].second;
  rules.axis[2] = overlap[1].second;
  rules.axis[1] = overlap[2].second;
}

}  // namespace boxstream::detail
