// SPDX-License-Identifier: MIT
#include <boxstream/detector.hpp>

#include <algorithm>
#include <bit>
#include <new>
#include <optional>
#include <stdexcept>

#include "base/arena.hpp"
#include "base/in_use.hpp"
#include "batch/classes.hpp"
#include "batch/columns.hpp"
#include "batch/delivery.hpp"
#include "batch/parallel/task_pool.hpp"
#include "batch/search.hpp"
#include "batch/search_team.hpp"
#include "batch/tree.hpp"
#include "batch/two_sets.hpp"

namespace boxstream {

namespace {

using detail::Classes;
using detail::CrossSearch;
using detail::DeliveringBuffer;
using detail::Input;
using detail::Search;
using detail::SearchTeam;
using detail::SinkThread;
using detail::TaskPool;
using detail::Tree;

template <class S>
void check(Span<const BasicAabb<S>> boxes, Span<const Filter> filters) {
  if (boxes.size() >= UINT32_MAX) throw std::length_error("boxstream: more than 2^32 - 2 boxes in a set");
  if (!filters.empty() && filters.size() != boxes.size())
    throw std::invalid_argument("boxstream: there must be no filters, or one for each box");
}

// Scratch of a sweep of the whole input. Small inputs get room for that whatever their plan was, because the plan for
// other boxes of the same number may be another. Larger ones are swept whole only if they cannot be split.
constexpr std::size_t sweep_bytes_per_box = 160;
constexpr std::size_t most_boxes_of_a_leaf = 65536;

// Pairs that the tasks of a stream may hold back together, beside one for each box: 16 MiB, so that what a task of a
// small search with very many pairs finds still fits.
constexpr std::size_t least_room = std::size_t{1} << 21;

}  // namespace

auto append_to(std::vector<Pair>& out) {
  return [&out](Span<const Pair> pairs) {
    out.insert(out.end(), pairs.begin(), pairs.end());
    return true;
  };
}

/// Few boxes, all with all: nothing is set up before.
template <class S>
Stats run_small(const Input<S>& input, PairSink sink) {
  check(input.a, input.filters_a);
  Stats stats;
  const std::size_t size = input.a.size();
  DeliveringBuffer<S> buffer(input, sink);
  const std::uint64_t valid = detail::compare_small(input.a.data(), size, buffer);
  buffer.flush();
  stats.boxes = size;
  stats.records = static_cast<std::uint64_t>(std::popcount(valid));
  stats.invalid = size - stats.records;
  stats.pairs = buffer.delivered();
  stats.cells = stats.records < 2 ? 0 : 1;
  stats.tests = size * (size - 1) / 2;
  return stats;
}

struct Detector::Impl {
  DetectorOptions options;
  detail::Arena arena;
  TaskPool pool;
  detail::InUse in_use;

  /// In the arena, for it is large; null where filters are none, or save nothing.
  template <class S>
  const Classes* worthwhile_classes(const Input<S>& input, bool self) {
    if (input.filters_a.empty() && input.filters_b.empty()) return nullptr;
    const auto* classes = new (arena.allocate<Classes>(1))
        Classes(input.filters_a, input.a.size(), input.filters_b, input.b.size(), self, arena);
    return classes->are_worth_it() ? classes : nullptr;
  }

  /// `most_held` bounds how many pairs parallel tasks may hold back together.
  template <class S>
  Stats run(const Input<S>& input, bool self, std::size_t most_held, PairSink sink, SinkThread sink_thread) {
    check(input.a, input.filters_a);
    check(input.b, input.filters_b);
    Stats stats;
    stats.boxes = input.a.size() + (self ? 0 : input.b.size());
    {
      const detail::Arena::Frame frame(arena);
      const Classes* const classes = worthwhile_classes(input, self);
      Input<S> asked = input;
      if (classes != nullptr && !classes->need_filters()) asked.filters_a = asked.filters_b = {};
      DeliveringBuffer<S> buffer(asked, sink);
      const Search<S> search(asked, self);
      std::optional<SearchTeam<S>> team;
      if (options.executor != nullptr && options.executor->concurrency() > 1)
        team.emplace(search, *options.executor, pool, most_held, sink, sink_thread, stats);
      Tree tree = search.make_tree(arena, buffer, stats, team ? &*team : nullptr);
      const detail::BoxSource<S> a(input.a, search.keys), b(input.b, search.keys);
      CrossSearch two_sets{arena, buffer, stats, {search.keys.kind(0), search.keys.kind(1), search.keys.kind(2)}};
      const bool complete = classes != nullptr ? classes->join(a, b, tree, two_sets)
                            : self             ? tree.join_self(a, {})
                                               : two_sets.join(a, b, tree);
      if (complete) buffer.flush();
      stats.pairs += buffer.delivered();
    }
    const auto swept_as_one = std::min<std::uint64_t>(stats.boxes, most_boxes_of_a_leaf) * sweep_bytes_per_box;
    arena.settle(std::max<std::size_t>(arena.peak(), swept_as_one));
    pool.settle();
    return stats;
  }

  template <class S>
  Stats stream(const Input<S>& input, bool self, PairSink sink) {
    const detail::InUse::Change change(in_use);
    if (self && input.a.size() <= detail::most_small) return run_small(input, sink);
    const std::size_t boxes = input.a.size() + (self ? 0 : input.b.size());
    return run(input, self, least_room + boxes, sink, SinkThread::calling);
  }

  template <class S>
  Stats find(const Input<S>& input, bool self, std::vector<Pair>& out) {
    const detail::InUse::Change change(in_use);
    out.clear();
    const auto append = append_to(out);
    try {
      if (self && input.a.size() <= detail::most_small) return run_small<S>(input, append);
      return run<S>(input, self, SIZE_MAX, append, SinkThread::any_one);
    } catch (...) {
      out.clear();
      throw;
    }
  }
};

Detector::Detector(DetectorOptions options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

Stats Detector::find_pairs(Span<const Aabb> boxes, std::vector<Pair>& out, Span<const Filter> filters) {
  return impl_->find<float>({boxes, boxes, filters, filters}, true, out);
}

Stats Detector::find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& out, Span<const Filter> filters) {
  return impl_->find<double>({boxes, boxes, filters, filters}, true, out);
}

Stats Detector::find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& out, Span<const Filter> filters_a,
                           Span<const Filter> filters_b) {
  return impl_->find<float>({a, b, filters_a, filters_b}, false, out);
}

Stats Detector::find_pairs(Span<const Aabb64> a, Span<const Aabb64> b, std::vector<Pair>& out,
                           Span<const Filter> filters_a, Span<const Filter> filters_b) {
  return impl_->find<double>({a, b, filters_a, filters_b}, false, out);
}

Stats Detector::stream_pairs(Span<const Aabb> boxes, PairSink sink, Span<const Filter> filters) {
  return impl_->stream<float>({boxes, boxes, filters, filters}, true, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> boxes, PairSink sink, Span<const Filter> filters) {
  return impl_->stream<double>({boxes, boxes, filters, filters}, true, sink);
}

Stats Detector::stream_pairs(Span<const Aabb> a, Span<const Aabb> b, PairSink sink, Span<const Filter> filters_a,
                             Span<const Filter> filters_b) {
  return impl_->stream<float>({a, b, filters_a, filters_b}, false, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> a, Span<const Aabb64> b, PairSink sink, Span<const Filter> filters_a,
                             Span<const Filter> filters_b) {
  return impl_->stream<double>({a, b, filters_a, filters_b}, false, sink);
}

std::size_t Detector::scratch_bytes() const {
  return impl_->arena.capacity() + impl_->pool.capacity();
}

namespace {

template <class S>
std::vector<Pair> find_once(Span<const BasicAabb<S>> a) {
  std::vector<Pair> pairs;
  if (a.size() <= detail::most_small)
    run_small<S>({a, a, {}, {}}, append_to(pairs));
  else
    Detector().find_pairs(a, pairs);
  return pairs;
}

template <class S>
std::vector<Pair> find_once(Span<const BasicAabb<S>> a, Span<const BasicAabb<S>> b) {
  std::vector<Pair> pairs;
  Detector().find_pairs(a, b, pairs);
  return pairs;
}

}  // namespace

std::vector<Pair> find_pairs(Span<const Aabb> boxes) {
  return find_once(boxes);
}
std::vector<Pair> find_pairs(Span<const Aabb64> boxes) {
  return find_once(boxes);
}
std::vector<Pair> find_pairs(Span<const Aabb> a, Span<const Aabb> b) {
  return find_once(a, b);
}
std::vector<Pair> find_pairs(Span<const Aabb64> a, Span<const Aabb64> b) {
  return find_once(a, b);
}

}  // namespace boxstream
