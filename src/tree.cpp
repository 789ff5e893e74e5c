// SPDX-License-Identifier: MIT
#include "tree.hpp"

#include <algorithm>

#include "partition.hpp"

namespace boxstream::detail {

namespace {

// Up to here a plan takes longer than the comparisons it saves, unless all boxes overlap on the first axis.
constexpr std::size_t no_plan_below = 160;
// A node this deep is swept whatever its size. Each level parts the boxes at quantiles or blocks an axis, so only input
// made to defeat sampling comes here.
constexpr int deepest = 24;
// A child meant to be a leaf may be this much larger than planned before it is planned anew.
constexpr double leaf_tolerance = 2.0;

/// Whether a node follows its parent's plan and is swept without one of its own.
bool is_leaf(double boxes, const Tree::Context& context) {
  if (boxes <= no_plan_below || context.depth >= deepest) return true;
  return context.parent != nullptr && context.parent->children_are_leaves &&
         boxes <= leaf_tolerance * context.parent->leaf_size;
}

SweepPlan leaf_plan(const Tree::Context& context) {
  return context.parent != nullptr ? context.parent->sweep : SweepPlan{};
}

/// Splitting has to leave less than there was, or it would neither end nor keep memory linear: with children of at most
/// 3/4 of the size, at most 4 copies of a box and one list of large boxes, a path of the recursion holds at most 20
/// records a box. Only a step to large boxes may keep the size, and it blocks an axis: at most three such steps
/// make 80.
bool makes_progress(std::size_t boxes, std::size_t copies, std::size_t largest_slab) {
  return largest_slab * 4 <= boxes * 3 && copies <= boxes * 4;
}

/// Sources as contiguous valid records.
Span<const Record> records_of(const RecordSource& source, Arena&) {
  return source.size() == 0 ? Span<const Record>() : Span<const Record>(&source[0], source.size());
}

template <class S>
Span<const Record> records_of(const BoxSource<S>& source, Arena& arena) {
  const std::size_t n = source.size();
  auto* records = arena.allocate<Record>(n + load_block);
  std::size_t size = 0;
  for (std::size_t begin = 0; begin < n; begin += load_block) {
    const std::size_t count = std::min(load_block, n - begin);
    const std::uint64_t valid = source.load(begin, count, records + size).valid;
    if (valid == ~std::uint64_t{0} >> (load_block - count)) {
      size += count;
    } else {
      const Record* const block = records + size;
      for (std::size_t i = 0; i < count; ++i)
        if ((valid >> i & 1) != 0) records[size++] = block[i];
    }
  }
  return {records, size};
}

template <class Source>
std::uint64_t count_invalid(const Source& source) {
  std::uint64_t invalid = 0;
  for (std::size_t i = 0; i < source.size(); ++i) invalid += source.valid(i) ? 0 : 1;
  return invalid;
}

}  // namespace

template <class Source>
bool Tree::sweep(const Source& boxes, const SweepPlan& plan) {
  Arena::Frame frame(arena_);
  const Span<const Record> records = records_of(boxes, arena_);
  stats_.invalid += boxes.size() - records.size();
  if (records.size() < 2) return true;
  ++stats_.cells;
  stats_.records += records.size();
  return sweep_self(records, plan, sweep_);
}

template <class Source>
bool Tree::sweep(const Source& a, const Source& b, const SweepPlan& plan) {
  Arena::Frame frame(arena_);
  const Span<const Record> records_a = records_of(a, arena_), records_b = records_of(b, arena_);
  stats_.invalid += a.size() - records_a.size() + b.size() - records_b.size();
  if (records_a.empty() || records_b.empty()) return true;
  ++stats_.cells;
  stats_.records += records_a.size() + records_b.size();
  return sweep_cross(records_a, records_b, plan, sweep_);
}

/// Children go to the team as tasks, but for those so large that one thread would be busy with them when all others are
/// done: these use the team themselves.
bool Tree::run_children(std::size_t count, FunctionRef<std::size_t(std::size_t)> size_of, const Context& context,
                        Team* team, FunctionRef<bool(Tree&, std::size_t)> child) {
  if (team == nullptr) {
    for (std::size_t i = 0; i < count; ++i)
      if (!child(*this, i)) return false;
    return true;
  }
  std::size_t total = 0;
  for (std::size_t i = 0; i < count; ++i) total += size_of(i);
  const auto is_shared = [&](std::size_t i) {
    const std::size_t size = size_of(i);
    return team_for(size) != nullptr && size * 2 * team->threads() > total &&
           !is_leaf(static_cast<double>(size), context);
  };
  if (!sweep_.pairs.flush()) return false;  // the team passes pairs on by another way
  for (std::size_t begin = 0, end; begin < count; begin = end) {
    end = begin + 1;
    if (is_shared(begin)) {
      if (!child(*this, begin) || !sweep_.pairs.flush()) return false;
      continue;
    }
    while (end < count && !is_shared(end)) ++end;
    if (!team->run_children(begin, end, child)) return false;
  }
  return true;
}

template <class Source>
bool Tree::join_self(const Source& boxes, Context context) {
  if (boxes.size() < 2) {
    stats_.invalid += count_invalid(boxes);
    return true;
  }
  const auto n = static_cast<double>(boxes.size());
  if (is_leaf(n, context)) return sweep(boxes, leaf_plan(context));

  Arena::Frame frame(arena_);
  Plan plan;
  {
    Arena::Frame sample_frame(arena_);
    Sample sample(arena_);
    sample.draw(boxes, Sample::wanted(boxes.size()));
    plan = make_plan(sample, {n, n * (n - 1) / 2}, context.blocked, context.depth, sweep_.kinds, arena_);
  }
  if (plan.slabs.axis < 0) return sweep(boxes, plan.sweep);

  Team* const team = team_for(boxes.size());
  Partition parts(boxes, plan.slabs, arena_, team);
  if (!makes_progress(parts.boxes(), parts.copies(), parts.largest_slab())) return sweep(boxes, plan.sweep);
  parts.scatter(boxes, arena_, team);
  ++stats_.nodes;
  stats_.invalid += boxes.size() - parts.boxes();
  const Context child{context.blocked, context.depth + 1, &plan};
  if (!run_children(
          parts.slabs(), [&](std::size_t s) { return parts.slab(s).size(); }, child, team,
          [&](Tree& tree, std::size_t s) { return tree.join_self(RecordSource(parts.slab(s)), child); }))
    return false;

  // Large boxes span most slabs: this axis has little more to tell about them.
  if (parts.large().empty()) return true;
  const Context large{context.blocked | 1u << plan.slabs.axis, context.depth + 1, nullptr};
  const RecordSource large_boxes(parts.large());
  return join_self(large_boxes, large) && join_cross(large_boxes, RecordSource(parts.gather_small()), large);
}

template <class Source>
bool Tree::join_cross(const Source& a, const Source& b, Context context) {
  if (a.size() == 0 || b.size() == 0) {
    stats_.invalid += count_invalid(a) + count_invalid(b);
    return true;
  }
  const auto size_a = static_cast<double>(a.size()), size_b = static_cast<double>(b.size());
  if (is_leaf(size_a + size_b, context)) return sweep(a, b, leaf_plan(context));

  Arena::Frame frame(arena_);
  Plan plan;
  {
    Arena::Frame sample_frame(arena_);
    Sample sample(arena_);
    const auto wanted = static_cast<double>(Sample::wanted(a.size() + b.size()));
    sample.draw(a, static_cast<std::size_t>(wanted * size_a / (size_a + size_b)) + 1);
    sample.draw(b, static_cast<std::size_t>(wanted * size_b / (size_a + size_b)) + 1);
    plan = make_plan(sample, {size_a + size_b, size_a * size_b}, context.blocked, context.depth, sweep_.kinds, arena_);
  }
  if (plan.slabs.axis < 0) return sweep(a, b, plan.sweep);

  Team* const team = team_for(a.size() + b.size());
  Partition parts_a(a, plan.slabs, arena_, team);
  Partition parts_b(b, plan.slabs, arena_, team);
  if (!makes_progress(parts_a.boxes() + parts_b.boxes(), parts_a.copies() + parts_b.copies(),
                      parts_a.largest_slab() + parts_b.largest_slab()))
    return sweep(a, b, plan.sweep);
  parts_a.scatter(a, arena_, team);
  parts_b.scatter(b, arena_, team);
  ++stats_.nodes;
  stats_.invalid += a.size() - parts_a.boxes() + b.size() - parts_b.boxes();
  const Context child{context.blocked, context.depth + 1, &plan};
  if (!run_children(
          parts_a.slabs(), [&](std::size_t s) { return parts_a.slab(s).size() + parts_b.slab(s).size(); }, child, team,
          [&](Tree& tree, std::size_t s) {
            return tree.join_cross(RecordSource(parts_a.slab(s)), RecordSource(parts_b.slab(s)), child);
          }))
    return false;

  if (parts_a.large().empty() && parts_b.large().empty()) return true;
  const Context large{context.blocked | 1u << plan.slabs.axis, context.depth + 1, nullptr};
  const RecordSource large_a(parts_a.large()), large_b(parts_b.large());
  const RecordSource small_a(parts_a.gather_small()), small_b(parts_b.gather_small());
  return join_cross(large_a, large_b, large) && join_cross(large_a, small_b, large) &&
         join_cross(small_a, large_b, large);
}

template bool Tree::join_self(const BoxSource<float>&, Context);
template bool Tree::join_self(const BoxSource<double>&, Context);
template bool Tree::join_cross(const BoxSource<float>&, const BoxSource<float>&, Context);
template bool Tree::join_cross(const BoxSource<double>&, const BoxSource<double>&, Context);

}  // namespace boxstream::detail
