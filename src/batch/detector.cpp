// SPDX-License-Identifier: MIT
#include <boxstream/detector.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "base/arena.hpp"
#include "base/empty_or_whole.hpp"
#include "base/in_use.hpp"
#include "base/thresholds.hpp"
#include "batch/many_sets.hpp"
#include "batch/one_search.hpp"
#include "batch/parallel/run_tasks.hpp"
#include "batch/parallel/task_pool.hpp"

namespace boxstream {

namespace {

using detail::Input;
using detail::ManyInputs;
using detail::Parallel;
using detail::SinkThread;
using detail::thresholds;

template <class S>
void check(Span<const BasicAabb<S>> boxes, Span<const Filter> filters) {
  if (boxes.size() >= UINT32_MAX) throw std::length_error("boxstream: more than 2^32 - 2 boxes in a set");
  if (!filters.empty() && filters.size() != boxes.size())
    throw std::invalid_argument("boxstream: there must be no filters, or one for each box");
}

template <class S>
void check(const Input<S>& input) {
  check(input.a, input.filters_a);
  check(input.b, input.filters_b);
}

template <class S>
void check(const ManyInputs<S>& inputs) {
  check(inputs.all);
  detail::check_offsets(inputs.offsets_a, inputs.all.a.size());
  detail::check_offsets(inputs.offsets_b, inputs.all.b.size());
  if (inputs.offsets_a.size() != inputs.offsets_b.size())
    throw std::invalid_argument("boxstream: there must be as many offsets of sets `b` as of sets `a`");
}

// Scratch of a sweep of the whole input. Small inputs get room for that whatever their plan was, because the plan for
// other boxes of the same number may be another. Larger ones are swept whole only if they cannot be split.
// Doubles may be copied with all bits there.
template <class S>
constexpr std::size_t sweep_bytes_per_box = sizeof(S) == 4 ? 160 : 160 + 64;
constexpr std::size_t most_boxes_of_a_leaf = 65536;

auto append_to(std::vector<Pair>& out) {
  return [&out](Span<const Pair> pairs) {
    out.insert(out.end(), pairs.begin(), pairs.end());
    return true;
  };
}

}  // namespace

struct Detector::Impl {
  DetectorOptions options;
  detail::Arena arena;
  detail::TaskPool pool;
  detail::InUse in_use;

  /// Calls `search` with what it takes to use more than one thread, or null. Memory is kept for another search like it,
  /// of as many boxes, of which the largest set has `largest`.
  template <class S, class Search>
  void search_with(std::size_t most_held, SinkThread sink_thread, std::uint64_t boxes, std::uint64_t largest,
                   const Search& search) {
    std::optional<Parallel> parallel;
    const auto [threads, least_boxes] = detail::sharing_for(options.executor, boxes);
    if (threads > 1) parallel.emplace(Parallel{*options.executor, threads, least_boxes, pool, most_held, sink_thread});
    search(parallel ? &*parallel : nullptr);
    const auto swept_as_one = std::min<std::uint64_t>(largest, most_boxes_of_a_leaf) * sweep_bytes_per_box<S>;
    arena.settle(std::max<std::size_t>(arena.peak(), swept_as_one));
    pool.settle();
  }

  template <class S>
  void set_method(Input<S>& input) const {
    input.method = options.method;
    input.cutoff = options.cutoff;
  }

  /// `most_held` bounds how many pairs parallel tasks may hold back together.
  template <class S>
  Stats run(Input<S> input, std::size_t most_held, PairSink sink, SinkThread sink_thread) {
    check(input);
    set_method(input);
    Stats stats;
    stats.boxes = input.boxes();
    if (detail::is_small(input))
      detail::search_small(input, sink, stats);
    else
      search_with<S>(most_held, sink_thread, stats.boxes, stats.boxes,
                     [&](const Parallel* parallel) { detail::search_large(input, arena, parallel, sink, stats); });
    return stats;
  }

  template <class S>
  Stats run(ManyInputs<S> inputs, std::size_t most_held, PairSink sink, SinkThread sink_thread) {
    check(inputs);
    set_method(inputs.all);
    Stats stats;
    stats.boxes = inputs.boxes();
    search_with<S>(most_held, sink_thread, stats.boxes, inputs.largest(),
                   [&](const Parallel* parallel) { detail::search_many(inputs, arena, parallel, sink, stats); });
    return stats;
  }

  /// Of an Input, or of ManyInputs.
  template <class In>
  Stats stream(const In& input, PairSink sink) {
    const detail::InUse::Change change(in_use);
    return run(input, thresholds.most_waiting + input.boxes(), sink, SinkThread::calling);
  }

  template <class In>
  Stats find(const In& input, std::vector<Pair>& out) {
    const detail::InUse::Change change(in_use);
    detail::EmptyOrWhole output(out);
    const Stats stats = run(input, SIZE_MAX, append_to(out), SinkThread::any_one);
    output.is_whole();
    return stats;
  }

  template <class S>
  Stats find(const ManyInputs<S>& inputs, PairsOfSets& out) {
    const detail::InUse::Change change(in_use);
    detail::EmptyOrWhole output(out.pairs, out.offsets);
    out.offsets.reserve(inputs.offsets_a.size());
    const Stats stats = run(inputs, SIZE_MAX, append_to(out.pairs), SinkThread::any_one);
    out.offsets.resize(inputs.offsets_a.size());
    find_pair_offsets(inputs, out);
    output.is_whole();
    return stats;
  }

 private:
  template <class S>
  void find_pair_offsets(const ManyInputs<S>& inputs, PairsOfSets& out) {
    const std::size_t parts = detail::sharing_for(options.executor, inputs.boxes()).threads;
    const auto do_part = [&](std::size_t part) {
      detail::find_pair_offsets(out.pairs, inputs.offsets_a, part, parts, out.offsets);
    };
    if (parts == 1)
      do_part(0);
    else
      detail::run_tasks(*options.executor, parts, do_part);
  }
};

Detector::Detector(DetectorOptions options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

Stats Detector::find_pairs(Span<const Aabb> boxes, std::vector<Pair>& out, Span<const Filter> filters) {
  return impl_->find(Input<float>{boxes, boxes, filters, filters, true}, out);
}

Stats Detector::find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& out, Span<const Filter> filters) {
  return impl_->find(Input<double>{boxes, boxes, filters, filters, true}, out);
}

Stats Detector::find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& out, Span<const Filter> filters_a,
                           Span<const Filter> filters_b) {
  return impl_->find(Input<float>{a, b, filters_a, filters_b, false}, out);
}

Stats Detector::find_pairs(Span<const Aabb64> a, Span<const Aabb64> b, std::vector<Pair>& out,
                           Span<const Filter> filters_a, Span<const Filter> filters_b) {
  return impl_->find(Input<double>{a, b, filters_a, filters_b, false}, out);
}

Stats Detector::stream_pairs(Span<const Aabb> boxes, PairSink sink, Span<const Filter> filters) {
  return impl_->stream(Input<float>{boxes, boxes, filters, filters, true}, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> boxes, PairSink sink, Span<const Filter> filters) {
  return impl_->stream(Input<double>{boxes, boxes, filters, filters, true}, sink);
}

Stats Detector::stream_pairs(Span<const Aabb> a, Span<const Aabb> b, PairSink sink, Span<const Filter> filters_a,
                             Span<const Filter> filters_b) {
  return impl_->stream(Input<float>{a, b, filters_a, filters_b, false}, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> a, Span<const Aabb64> b, PairSink sink, Span<const Filter> filters_a,
                             Span<const Filter> filters_b) {
  return impl_->stream(Input<double>{a, b, filters_a, filters_b, false}, sink);
}

Stats Detector::find_pairs(Span<const Aabb> boxes, SetOffsets sets, PairsOfSets& out, Span<const Filter> filters) {
  return impl_->find(ManyInputs<float>{{boxes, boxes, filters, filters, true}, sets, sets}, out);
}

Stats Detector::find_pairs(Span<const Aabb64> boxes, SetOffsets sets, PairsOfSets& out, Span<const Filter> filters) {
  return impl_->find(ManyInputs<double>{{boxes, boxes, filters, filters, true}, sets, sets}, out);
}

Stats Detector::find_pairs(Span<const Aabb> a, SetOffsets sets_a, Span<const Aabb> b, SetOffsets sets_b,
                           PairsOfSets& out, Span<const Filter> filters_a, Span<const Filter> filters_b) {
  return impl_->find(ManyInputs<float>{{a, b, filters_a, filters_b, false}, sets_a, sets_b}, out);
}

Stats Detector::find_pairs(Span<const Aabb64> a, SetOffsets sets_a, Span<const Aabb64> b, SetOffsets sets_b,
                           PairsOfSets& out, Span<const Filter> filters_a, Span<const Filter> filters_b) {
  return impl_->find(ManyInputs<double>{{a, b, filters_a, filters_b, false}, sets_a, sets_b}, out);
}

Stats Detector::stream_pairs(Span<const Aabb> boxes, SetOffsets sets, PairSink sink, Span<const Filter> filters) {
  return impl_->stream(ManyInputs<float>{{boxes, boxes, filters, filters, true}, sets, sets}, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> boxes, SetOffsets sets, PairSink sink, Span<const Filter> filters) {
  return impl_->stream(ManyInputs<double>{{boxes, boxes, filters, filters, true}, sets, sets}, sink);
}

Stats Detector::stream_pairs(Span<const Aabb> a, SetOffsets sets_a, Span<const Aabb> b, SetOffsets sets_b,
                             PairSink sink, Span<const Filter> filters_a, Span<const Filter> filters_b) {
  return impl_->stream(ManyInputs<float>{{a, b, filters_a, filters_b, false}, sets_a, sets_b}, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> a, SetOffsets sets_a, Span<const Aabb64> b, SetOffsets sets_b,
                             PairSink sink, Span<const Filter> filters_a, Span<const Filter> filters_b) {
  return impl_->stream(ManyInputs<double>{{a, b, filters_a, filters_b, false}, sets_a, sets_b}, sink);
}

std::size_t Detector::scratch_bytes() const {
  return impl_->arena.capacity() + impl_->pool.capacity();
}

namespace {

template <class S>
std::vector<Pair> find_once(Span<const BasicAabb<S>> a) {
  std::vector<Pair> pairs;
  const Input<S> input{a, a, {}, {}, true};
  Stats stats;
  if (detail::is_small(input))
    detail::search_small(input, append_to(pairs), stats);
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
