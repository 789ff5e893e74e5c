// SPDX-License-Identifier: MIT
#include <boxstream/detector.hpp>

#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>

#include "arena.hpp"
#include "delivery.hpp"
#include "task_pool.hpp"
#include "tree.hpp"

namespace boxstream {

namespace {

using detail::DeliveringBuffer;
using detail::Input;
using detail::TaskPool;
using detail::Tree;

template <class S>
void check(Span<const BasicAabb<S>> boxes, Span<const Filter> filters) {
  if (boxes.size() >= UINT32_MAX) throw std::length_error("boxstream: more than 2^32 - 2 boxes in a set");
  if (!filters.empty() && filters.size() != boxes.size())
    throw std::invalid_argument("boxstream: there must be no filters, or one for each box");
}

/// One search, as its parts see it.
template <class S>
struct Search {
  Input<S> input;
  bool self;
  detail::KeyMap<S> keys;

  Search(const Input<S>& in, bool is_self) : input(in), self(is_self) {
    keys.fit(input.a);
    if (!self) keys.fit(input.b);
  }

  Tree make_tree(detail::Arena& arena, detail::PairBuffer& buffer, Stats& stats,
                 detail::ChildRunner* runner = nullptr) const {
    const auto order = self ? detail::PairOrder::smaller_first : detail::PairOrder::first_set_first;
    return Tree(arena, buffer, {keys.kind(0), keys.kind(1), keys.kind(2)}, order, stats, runner);
  }
};

void add_work(Stats& total, const Stats& part) {
  total.nodes += part.nodes;
  total.cells += part.cells;
  total.records += part.records;
  total.tests += part.tests;
}

/// Children of the root as tasks: each collects its pairs, which are then passed on in order. A task whose pairs exceed
/// the room stops, and is done again on the calling thread, which streams what comes after those it has.
template <class S>
class ParallelRunner final : public detail::ChildRunner {
 public:
  ParallelRunner(const Search<S>& search, std::size_t most_pairs_per_task, Executor& executor, TaskPool& pool,
                 PairSink sink, Stats& stats)
      : search_(search),
        most_pairs_(most_pairs_per_task),
        executor_(executor),
        pool_(pool),
        sink_(sink),
        stats_(stats) {}

  bool run(std::size_t count, FunctionRef<bool(Tree&, std::size_t)> child) override {
    pool_.prepare(count, executor_.concurrency());
    executor_.parallel_for(count, [&](std::size_t i) {
      TaskPool::Task& task = pool_.task(i);
      task.error = nullptr;
      try {
        collect(task, i, child);
      } catch (...) {
        task.error = std::current_exception();
      }
    });
    for (std::size_t i = 0; i < count; ++i)
      if (pool_.task(i).error) std::rethrow_exception(pool_.task(i).error);
    for (std::size_t i = 0; i < count; ++i)
      if (!deliver(pool_.task(i), i, child)) return false;
    return true;
  }

 private:
  void collect(TaskPool::Task& task, std::size_t i, FunctionRef<bool(Tree&, std::size_t)> child) {
    task.pairs.clear();
    task.stats = {};
    auto append = [&](Span<const Pair> pairs) {
      if (pairs.size() > most_pairs_ - task.pairs.size()) return false;
      task.pairs.insert(task.pairs.end(), pairs.begin(), pairs.end());
      return true;
    };
    TaskPool::Lease lease(pool_);
    DeliveringBuffer<S> buffer(search_.input, append);
    Tree tree = search_.make_tree(lease.arena(), buffer, task.stats);
    task.complete = child(tree, i) && buffer.flush();
  }

  bool deliver(TaskPool::Task& task, std::size_t i, FunctionRef<bool(Tree&, std::size_t)> child) {
    if (!task.pairs.empty()) {
      stats_.pairs += task.pairs.size();
      if (!sink_(Span<const Pair>(task.pairs.data(), task.pairs.size()))) return false;
    }
    if (task.complete) {
      add_work(stats_, task.stats);
      return true;
    }
    TaskPool::Lease lease(pool_);
    DeliveringBuffer<S> buffer(search_.input, sink_);
    buffer.skip(task.pairs.size());
    Tree tree = search_.make_tree(lease.arena(), buffer, stats_);
    const bool going_on = child(tree, i) && buffer.flush();
    stats_.pairs += buffer.delivered();
    return going_on;
  }

  const Search<S>& search_;
  std::size_t most_pairs_;
  Executor& executor_;
  TaskPool& pool_;
  PairSink sink_;
  Stats& stats_;
};

// Scratch of a sweep of the whole input. Small inputs get room for that whatever their plan was, because the plan for
// other boxes of the same number may be another. Larger ones are swept whole only if they cannot be split.
constexpr std::size_t sweep_bytes_per_box = 160;
constexpr std::size_t most_boxes_of_a_leaf = 65536;

// Below, handing out tasks costs more than they save.
constexpr std::size_t least_parallel_boxes = 16384;

}  // namespace

struct Detector::Impl {
  DetectorOptions options;
  detail::Arena arena;
  TaskPool pool;

  /// `most_pairs_per_task` bounds what parallel tasks may hold back.
  template <class S>
  Stats run(const Input<S>& input, bool self, std::size_t most_pairs_per_task, PairSink sink) {
    check(input.a, input.filters_a);
    check(input.b, input.filters_b);
    Stats stats;
    stats.boxes = input.a.size() + (self ? 0 : input.b.size());
    {
      const detail::Arena::Frame frame(arena);
      DeliveringBuffer<S> buffer(input, sink);
      const bool parallel =
          options.executor != nullptr && options.executor->concurrency() > 1 && stats.boxes >= least_parallel_boxes;
      std::optional<ParallelRunner<S>> runner;
      const Search<S> search(input, self);
      if (parallel) runner.emplace(search, most_pairs_per_task, *options.executor, pool, sink, stats);
      Tree tree = search.make_tree(arena, buffer, stats, parallel ? &*runner : nullptr);
      const detail::BoxSource<S> a(input.a, search.keys), b(input.b, search.keys);
      if (self ? tree.join_self(a, {}) : tree.join_cross(a, b, {})) buffer.flush();
      stats.pairs += buffer.delivered();
    }
    const auto swept_as_one = std::min<std::uint64_t>(stats.boxes, most_boxes_of_a_leaf) * sweep_bytes_per_box;
    arena.settle(std::max<std::size_t>(arena.peak(), swept_as_one));
    pool.settle();
    return stats;
  }

  template <class S>
  Stats stream(const Input<S>& input, bool self, PairSink sink) {
    const std::size_t room =
        65536 + (input.a.size() + input.b.size()) / 16;  // of 8 bytes, for each of 64 tasks or fewer
    return run(input, self, room, sink);
  }

  template <class S>
  Stats find(const Input<S>& input, bool self, std::vector<Pair>& out) {
    out.clear();
    try {
      return run(input, self, SIZE_MAX, [&out](Span<const Pair> pairs) {
        out.insert(out.end(), pairs.begin(), pairs.end());
        return true;
      });
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
