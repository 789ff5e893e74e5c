// SPDX-License-Identifier: MIT
#include "batch/cuts/wide_tree.hpp"

#include <algorithm>
#include <functional>

#include "base/thresholds.hpp"
#include "batch/cuts/partition.hpp"
#include "batch/parallel/steps.hpp"
#include "batch/records/records_of.hpp"

namespace boxstream::detail {

namespace {

/// Whether a node follows its parent's plan and is swept without one of its own.
bool is_leaf(double boxes, const WideTree::Context& context) {
  if (boxes <= thresholds.no_plan_below) return true;
  return context.parent != nullptr && context.parent->children_are_leaves &&
         boxes <= thresholds.leaf_tolerance * context.parent->leaf_size;
}

SweepPlan leaf_plan(const WideTree::Context& context) {
  return context.parent != nullptr ? context.parent->sweep : SweepPlan{};
}

/// Whether slabs of this size leave less than there was: then the recursion ends. Only a step to large boxes may keep
/// the size, and it blocks an axis.
bool makes_progress(std::size_t boxes, std::size_t largest_cell) {
  return largest_cell * 4 <= boxes * 3;
}

/// The boxes that the nodes below get, of both sets together: those of the slabs, and, if any are large, the large ones
/// once among themselves and once more with the small ones.
std::size_t boxes_below(std::size_t boxes, std::size_t copies, std::size_t large) {
  return copies + (large == 0 ? 0 : large + boxes);
}

/// What WideTree::split works on: the boxes of a node, of one set or two, and their partition.
template <class Source, std::size_t sets>
class Parts {
 public:
  template <class... Sources>
  Parts(const Grid& grid, std::size_t threads, Arena& arena, const Sources&... sources)
      : sources_{&sources...}, of_{Partition(sources.size(), grid, threads, Source::is_in_memory, arena)...} {}

  std::size_t ranges() const { return sum_of(&Partition::ranges); }
  void count(std::size_t range) {
    const std::size_t s = set_of(range);
    of_[s].count(*sources_[s], range);
  }
  /// After all have been counted.
  void sum() {
    for (Partition& set : of_) set.sum();
  }
  std::size_t boxes() const { return sum_of(&Partition::boxes); }
  std::size_t large() const { return sum_of(&Partition::large_count); }
  std::size_t largest_cell() const { return sum_of(&Partition::largest_cell); }
  void make_room(Arena& arena) {
    for (Partition& set : of_) set.make_room(arena);
  }
  void scatter(std::size_t range) {
    const std::size_t s = set_of(range);
    of_[s].scatter(*sources_[s], range);
  }

  std::size_t cells() const { return of_[0].cells(); }
  std::size_t copies() const { return sum_of(&Partition::copies); }
  std::size_t size(std::size_t cell) const {
    return sum_of([cell](const Partition& set) { return set.cell(cell).size(); });
  }
  bool join(WideTree& tree, std::size_t cell, const WideTree::Context& context) const {
    const RecordSource first(of_[0].cell(cell));
    if constexpr (sets == 1)
      return tree.join_self(first, context);
    else
      return tree.join_cross(first, RecordSource(of_[1].cell(cell)), context);
  }

  std::size_t invalid() const { return sum_of(&Partition::invalid); }
  Partition& operator[](std::size_t set) { return of_[set]; }

 private:
  template <class Number>
  std::size_t sum_of(const Number& number) const {
    std::size_t sum = 0;
    for (const Partition& set : of_) sum += std::invoke(number, set);
    return sum;
  }

  /// The set that `range` belongs to; `range` becomes its number within that set.
  std::size_t set_of(std::size_t& range) const {
    if (range < of_[0].ranges()) return 0;
    range -= of_[0].ranges();
    return 1;
  }

  const Source* sources_[sets];
  Partition of_[sets];
};

/// The small boxes of a partition; by the team, if there is one.
template <class Source>
RecordSource gather_small(Partition& parts, const Source& source, Team* team) {
  const auto gather = [&](std::size_t range) { parts.gather_small(source, range); };
  if (team != nullptr)
    team->run_parts(parts.ranges(), gather);
  else
    for (std::size_t range = 0; range < parts.ranges(); ++range) gather(range);
  return RecordSource(parts.small());
}

template <class Source>
std::uint64_t count_invalid(const Source& source) {
  std::uint64_t invalid = 0;
  for (std::size_t i = 0; i < source.size(); ++i) invalid += source.valid(i) ? 0 : 1;
  return invalid;
}

}  // namespace

template <class... Sources>
bool WideTree::sweep(SweepPlan plan, const Context& context, const Sources&... sources) {
  constexpr bool is_self = sizeof...(sources) == 1;
  Arena::Frame frame(arena_);
  const Span<const Record> records[2] = {records_of(sources, arena_)...};
  std::size_t size = 0;
  for (const Span<const Record> set : records) size += set.size();
  stats_.invalid += (sources.size() + ...) - size;
  if (is_self ? size < 2 : records[0].empty() || records[1].empty()) return true;
  const auto do_rest = [this](Span<const Record> a, Span<const Record> b) {
    return join_bounded(a, b, is_self, sweep_, stats_);
  };
  const SweepPlan::Rest rest = do_rest;
  plan.rest = &rest;
  plan.most_tests = most_tests(size, context);
  ++stats_.cells;
  stats_.records += size;
  if constexpr (is_self)
    return sweep_self(records[0], plan, sweep_);
  else
    return sweep_cross(records[0], records[1], plan, sweep_);
}

template <class Parts>
WideTree::Split WideTree::split(Parts& parts, Context& context, Team* team, std::size_t most_copies) {
  const auto make_room = [&] {
    parts.sum();
    const std::size_t boxes = parts.boxes(), below = boxes_below(boxes, parts.copies(), parts.large());
    if (!makes_progress(boxes, parts.largest_cell()) || parts.copies() / most_copies > boxes ||
        context.copies * boxes < below * one_copy)
      return false;
    if (below != 0) context.copies = context.copies * boxes / below;
    parts.make_room(arena_);
    return true;
  };
  if (team == nullptr) {
    for (std::size_t range = 0; range < parts.ranges(); ++range) parts.count(range);
    if (!make_room()) return Split::no_progress;
    for (std::size_t range = 0; range < parts.ranges(); ++range) parts.scatter(range);
    ++stats_.nodes;
    stats_.invalid += parts.invalid();
    for (std::size_t s = 0; s < parts.cells(); ++s)
      if (!parts.join(*this, s, context)) return Split::stopped;
    return Split::done;
  }

  // Children go to the team as tasks, but for those so large that one thread would be busy with them when all others
  // are done: these use the team themselves.
  const auto is_shared = [&](std::size_t s) {
    const std::size_t size = parts.size(s);
    return team_for(size) != nullptr && size * 2 * team->threads() > parts.copies() &&
           !is_leaf(static_cast<double>(size), context);
  };
  const auto end_of_tasks = [&](std::size_t s) {
    while (s < parts.cells() && !is_shared(s)) ++s;
    return s;
  };

  if (!sweep_.pairs.flush()) return Split::stopped;  // the team passes pairs on by another way
  enum { counting, copying, joining };
  bool has_progress = false;
  std::size_t tasks = 0;
  const auto first_tasks = [&](WideTree& tree, std::size_t i) { return parts.join(tree, i, context); };
  // Both are named because Steps refers to them for as long as it lives.
  const auto begin_step = [&](std::size_t step) -> std::size_t {
    if (step == counting) return parts.ranges();
    if (step == copying) {
      has_progress = make_room();
      return has_progress ? parts.ranges() : 0;
    }
    team->begin_children(end_of_tasks(0));
    tasks = end_of_tasks(0);
    return tasks;
  };
  const auto work_on = [&](std::size_t step, std::size_t i) {
    if (step == counting)
      parts.count(i);
    else if (step == copying)
      parts.scatter(i);
    else
      team->work_on_child(i, first_tasks);
  };
  const Span<Steps::Taken> taken(arena_.allocate<Steps::Taken>(2 * parts.ranges()), 2 * parts.ranges());
  Steps steps(team->threads(), taken, begin_step, work_on);
  team->run_parts(team->threads(), [&](std::size_t worker) { steps.work(worker); });
  steps.rethrow();
  if (!has_progress) return Split::no_progress;
  ++stats_.nodes;
  stats_.invalid += parts.invalid();
  if (tasks != 0 && !team->finish_children(first_tasks)) return Split::stopped;

  for (std::size_t begin = tasks; begin < parts.cells();) {
    if (!parts.join(*this, begin, context) || !sweep_.pairs.flush()) return Split::stopped;
    const std::size_t first = ++begin;
    begin = end_of_tasks(first);
    if (begin == first) continue;
    const auto more_tasks = [&](WideTree& tree, std::size_t i) { return parts.join(tree, first + i, context); };
    team->begin_children(begin - first);
    team->run_parts(begin - first, [&](std::size_t i) { team->work_on_child(i, more_tasks); });
    if (!team->finish_children(more_tasks)) return Split::stopped;
  }
  return Split::done;
}

template <class Source>
bool WideTree::join_self(const Source& boxes, Context context) {
  if (boxes.size() < 2) {
    stats_.invalid += count_invalid(boxes);
    return true;
  }
  const auto n = static_cast<double>(boxes.size());
  if (is_leaf(n, context)) return sweep(leaf_plan(context), context, boxes);

  Arena::Frame frame(arena_);
  Plan plan;
  {
    Arena::Frame sample_frame(arena_);
    Sample sample(arena_);
    sample.draw(boxes, Sample::wanted(boxes.size()));
    plan = make_plan(sample, {n, n * (n - 1) / 2}, context.blocked, context.depth, sweep_.kinds, by_hand_, arena_);
  }
  return plan.grid.rows.axis < 0 ? sweep(plan.sweep, context, boxes) : cut_self(boxes, plan, context);
}

template <class Source>
bool WideTree::cut_self(const Source& boxes, Plan& plan, const Context& context) {
  Arena::Frame frame(arena_);
  Team* const team = team_for(boxes.size());
  Parts<Source, 1> set(plan.grid, team == nullptr ? 1 : team->threads(), arena_, boxes);
  Context below{context.blocked, context.depth + 1, &plan, context.copies};
  const Split result = split(set, below, team, plan.grid.is_simple() ? SIZE_MAX : thresholds.most_unforeseen_copies);
  if (result == Split::no_progress)
    return plan.grid.simplify() ? cut_self(boxes, plan, context) : sweep(plan.sweep, context, boxes);
  if (result == Split::stopped) return false;
  Partition& parts = set[0];

  // Large boxes span most slabs: this axis has little more to tell about them.
  if (parts.large().empty()) return true;
  const Context large{context.blocked | 1u << plan.grid.rows.axis, context.depth + 1, nullptr, below.copies};
  const RecordSource large_boxes(parts.large());
  return join_self(large_boxes, large) && join_cross(large_boxes, gather_small(parts, boxes, team), large);
}

template <class Source>
bool WideTree::join_cross(const Source& a, const Source& b, Context context) {
  if (a.size() == 0 || b.size() == 0) {
    stats_.invalid += count_invalid(a) + count_invalid(b);
    return true;
  }
  const auto size_a = static_cast<double>(a.size()), size_b = static_cast<double>(b.size());
  if (is_leaf(size_a + size_b, context)) return sweep(leaf_plan(context), context, a, b);

  Arena::Frame frame(arena_);
  Plan plan;
  {
    Arena::Frame sample_frame(arena_);
    Sample sample(arena_);
    const std::uint64_t n = a.size() + b.size(), wanted = Sample::wanted(a.size() + b.size());
    sample.draw(a, static_cast<std::size_t>(wanted * a.size() / n) + 1);
    sample.draw(b, static_cast<std::size_t>(wanted * b.size() / n) + 1);
    plan = make_plan(sample, {size_a + size_b, size_a * size_b}, context.blocked, context.depth, sweep_.kinds, by_hand_,
                     arena_);
  }
  return plan.grid.rows.axis < 0 ? sweep(plan.sweep, context, a, b) : cut_cross(a, b, plan, context);
}

template <class Source>
bool WideTree::cut_cross(const Source& a, const Source& b, Plan& plan, const Context& context) {
  Arena::Frame frame(arena_);
  Team* const team = team_for(a.size() + b.size());
  Parts<Source, 2> sets(plan.grid, team == nullptr ? 1 : team->threads(), arena_, a, b);
  Context below{context.blocked, context.depth + 1, &plan, context.copies};
  const Split result = split(sets, below, team, plan.grid.is_simple() ? SIZE_MAX : thresholds.most_unforeseen_copies);
  if (result == Split::no_progress)
    return plan.grid.simplify() ? cut_cross(a, b, plan, context) : sweep(plan.sweep, context, a, b);
  if (result == Split::stopped) return false;
  Partition &parts_a = sets[0], &parts_b = sets[1];

  if (parts_a.large().empty() && parts_b.large().empty()) return true;
  const Context large{context.blocked | 1u << plan.grid.rows.axis, context.depth + 1, nullptr, below.copies};
  const RecordSource large_a(parts_a.large()), large_b(parts_b.large());
  const RecordSource small_a = gather_small(parts_a, a, team), small_b = gather_small(parts_b, b, team);
  return join_cross(large_a, large_b, large) && join_cross(large_a, small_b, large) &&
         join_cross(small_a, large_b, large);
}

template bool WideTree::join_self(const BoxSource<float>&, Context);
template bool WideTree::join_self(const BoxSource<double>&, Context);
template bool WideTree::join_self(const RecordSource&, Context);
template bool WideTree::join_cross(const BoxSource<float>&, const BoxSource<float>&, Context);
template bool WideTree::join_cross(const BoxSource<double>&, const BoxSource<double>&, Context);
template bool WideTree::join_cross(const RecordSource&, const RecordSource&, Context);

}  // namespace boxstream::detail
