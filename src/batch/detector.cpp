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
#include "batch/neighbours.hpp"
#include "batch/one_search.hpp"
#include "batch/parallel/run_tasks.hpp"
#include "batch/parallel/task_pool.hpp"
#include "batch/records/given_boxes.hpp"

namespace boxstream {

namespace {

using detail::GivenSets;
using detail::Input;
using detail::ManyInputs;
using detail::Parallel;
using detail::SinkThread;
using detail::thresholds;

/// What a search is told of many sets.
struct GivenOffsets {
  SetOffsets a, b;
};

void check(const detail::GivenSets& sets, const GivenOffsets& offsets) {
  detail::check_offsets(offsets.a, sets.a.size());
  detail::check_offsets(offsets.b, sets.b.size());
  if (offsets.a.size() != offsets.b.size())
    throw std::invalid_argument("boxstream: there must be as many offsets of sets `b` as of sets `a`");
}

// Scratch of a sweep of the whole input. Small inputs get room for that whatever their plan was, because the plan for
// other boxes of the same number may be another. Larger ones are swept whole only if they cannot be split.
// Doubles may be copied with all bits there.
template <class S>
constexpr std::size_t sweep_bytes_per_box = sizeof(S) == 4 ? 168 : 168 + 64;
constexpr std::size_t most_boxes_of_a_leaf = 65536;
constexpr std::size_t cut_bytes_per_box = 60;

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
  detail::Arena copies;  // of boxes, where they are not compared as they are given
  detail::TaskPool pool;
  std::vector<std::unique_ptr<Pair[]>> pairs_of_rows;
  detail::InUse in_use;

  /// Calls `search` with what it takes to use more than one thread, or null. Memory is kept for another search like it,
  /// of as many boxes, of which the largest set has `largest`.
  template <class S, class Search>
  void search_with(std::size_t most_held, SinkThread sink_thread, std::uint64_t boxes, std::uint64_t largest,
                   const Search& search) {
    std::optional<Parallel> parallel;
    const auto [threads, least_boxes] = detail::sharing_for(options.executor, boxes);
    if (threads > 1) parallel.emplace(Parallel{*options.executor, threads, least_boxes, pool, most_held, sink_thread});
    const auto swept_as_one = std::min<std::uint64_t>(largest, most_boxes_of_a_leaf) * sweep_bytes_per_box<S>;
    // What most searches take, so that the second one finds the memory of the first.
    arena.expect(swept_as_one + (largest - std::min<std::uint64_t>(largest, most_boxes_of_a_leaf)) * cut_bytes_per_box);
    search(parallel ? &*parallel : nullptr);
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
    set_method(inputs.all);
    Stats stats;
    stats.boxes = inputs.boxes();
    search_with<S>(most_held, sink_thread, stats.boxes, inputs.largest(),
                   [&](const Parallel* parallel) { detail::search_many(inputs, arena, parallel, sink, stats); });
    return stats;
  }

  /// Calls `search` with the Input that stands for `sets`.
  template <class Search>
  Stats with_input(const GivenSets& sets, const PairRules& rules, const Search& search) {
    const Stats stats = detail::with_input(sets, rules, copies, search);
    copies.settle(copies.peak());
    return stats;
  }

  Stats stream(const GivenSets& sets, const PairRules& rules, PairSink sink) {
    const detail::InUse::Change change(in_use);
    return with_input(sets, rules, [&](const auto& input) {
      return run(input, thresholds.most_waiting + input.boxes(), sink, SinkThread::calling);
    });
  }

  Stats stream(const GivenSets& sets, const GivenOffsets& offsets, const PairRules& rules, PairSink sink) {
    const detail::InUse::Change change(in_use);
    check(sets, offsets);
    return with_input(sets, rules, [&]<class S>(const Input<S>& input) {
      return run(ManyInputs<S>{input, offsets.a, offsets.b}, thresholds.most_waiting + input.boxes(), sink,
                 SinkThread::calling);
    });
  }

  Stats find(const GivenSets& sets, const PairRules& rules, std::vector<Pair>& out) {
    const detail::InUse::Change change(in_use);
    detail::EmptyOrWhole output(out);
    const Stats stats = with_input(
        sets, rules, [&](const auto& input) { return run(input, SIZE_MAX, append_to(out), SinkThread::any_one); });
    output.is_whole();
    return stats;
  }

  Stats find(const GivenSets& sets, const GivenOffsets& offsets, const PairRules& rules, PairsOfSets& out) {
    const detail::InUse::Change change(in_use);
    detail::EmptyOrWhole output(out.pairs, out.offsets);
    check(sets, offsets);
    out.offsets.reserve(offsets.a.size());
    const Stats stats = with_input(sets, rules, [&]<class S>(const Input<S>& input) {
      return run(ManyInputs<S>{input, offsets.a, offsets.b}, SIZE_MAX, append_to(out.pairs), SinkThread::any_one);
    });
    out.offsets.resize(offsets.a.size());
    find_pair_offsets(stats.boxes, offsets.a, out);
    output.is_whole();
    return stats;
  }

  Stats find_neighbours(const GivenSets& sets, const PairRules& rules, bool both, Neighbours& out) {
    const detail::InUse::Change change(in_use);
    detail::EmptyOrWhole output(out.offsets, out.indices);
    check(sets, rules);
    detail::NeighbourRows rows(out, sets.a.size(), both, pairs_of_rows);
    const auto add = [&](Span<const Pair> pairs) {
      rows.add(pairs);
      return true;
    };
    const Stats stats =
        with_input(sets, rules, [&](const auto& input) { return run(input, SIZE_MAX, add, SinkThread::any_one); });
    rows.fill();
    sort_rows(out, stats.boxes);
    output.is_whole();
    return stats;
  }

 private:
  void sort_rows(Neighbours& rows, std::uint64_t boxes) {
    const std::size_t size = rows.offsets.size() - 1, threads = detail::sharing_for(options.executor, boxes).threads;
    if (threads == 1) return detail::sort_rows(rows, 0, size);
    const std::size_t parts = 4 * threads;
    detail::run_tasks(*options.executor, parts, [&](std::size_t part) {
      detail::sort_rows(rows, detail::begin_of_part(size, part, parts), detail::begin_of_part(size, part + 1, parts));
    });
  }

  void find_pair_offsets(std::uint64_t boxes, SetOffsets sets, PairsOfSets& out) {
    const std::size_t parts = detail::sharing_for(options.executor, boxes).threads;
    const auto do_part = [&](std::size_t part) {
      detail::find_pair_offsets(out.pairs, sets, part, parts, out.offsets);
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

Stats Detector::find_pairs(BoxSpan boxes, std::vector<Pair>& out, const PairRules& rules) {
  return impl_->find({boxes, boxes, true}, rules, out);
}

Stats Detector::find_pairs(BoxSpan a, BoxSpan b, std::vector<Pair>& out, const PairRules& rules) {
  return impl_->find({a, b, false}, rules, out);
}

Stats Detector::stream_pairs(BoxSpan boxes, PairSink sink, const PairRules& rules) {
  return impl_->stream({boxes, boxes, true}, rules, sink);
}

Stats Detector::stream_pairs(BoxSpan a, BoxSpan b, PairSink sink, const PairRules& rules) {
  return impl_->stream({a, b, false}, rules, sink);
}

Stats Detector::find_neighbours(BoxSpan boxes, Neighbours& out, const PairRules& rules, Directions directions) {
  return impl_->find_neighbours({boxes, boxes, true}, rules, directions == Directions::both, out);
}

Stats Detector::find_neighbours(BoxSpan a, BoxSpan b, Neighbours& out, const PairRules& rules) {
  return impl_->find_neighbours({a, b, false}, rules, false, out);
}

Stats Detector::find_pairs(BoxSpan boxes, SetOffsets sets, PairsOfSets& out, const PairRules& rules) {
  return impl_->find({boxes, boxes, true}, {sets, sets}, rules, out);
}

Stats Detector::find_pairs(BoxSpan a, SetOffsets sets_a, BoxSpan b, SetOffsets sets_b, PairsOfSets& out,
                           const PairRules& rules) {
  return impl_->find({a, b, false}, {sets_a, sets_b}, rules, out);
}

Stats Detector::stream_pairs(BoxSpan boxes, SetOffsets sets, PairSink sink, const PairRules& rules) {
  return impl_->stream({boxes, boxes, true}, {sets, sets}, rules, sink);
}

Stats Detector::stream_pairs(BoxSpan a, SetOffsets sets_a, BoxSpan b, SetOffsets sets_b, PairSink sink,
                             const PairRules& rules) {
  return impl_->stream({a, b, false}, {sets_a, sets_b}, rules, sink);
}

std::size_t Detector::scratch_bytes() const {
  const std::size_t of_rows = impl_->pairs_of_rows.size() * detail::NeighbourRows::piece * sizeof(Pair);
  return impl_->arena.capacity() + impl_->copies.capacity() + impl_->pool.capacity() + of_rows;
}

void Detector::shrink_to_fit() noexcept {
  const detail::InUse::Change change(impl_->in_use);
  impl_->arena = {};
  impl_->copies = {};
  impl_->pool.shrink_to_fit();
  std::vector<std::unique_ptr<Pair[]>>().swap(impl_->pairs_of_rows);
}

std::vector<Pair> find_pairs(BoxSpan boxes, const PairRules& rules) {
  std::vector<Pair> pairs;
  if (boxes.size() > detail::thresholds.most_small) {
    Detector().find_pairs(boxes, pairs, rules);
    return pairs;
  }
  // Without a Detector, which takes longer to make than few boxes to compare.
  detail::Arena copies;
  detail::with_input({boxes, boxes, true}, rules, copies, [&](const auto& input) {
    Stats stats;
    detail::search_small(input, append_to(pairs), stats);
    return stats;
  });
  return pairs;
}

std::vector<Pair> find_pairs(BoxSpan a, BoxSpan b, const PairRules& rules) {
  std::vector<Pair> pairs;
  Detector().find_pairs(a, b, pairs, rules);
  return pairs;
}

}  // namespace boxstream
