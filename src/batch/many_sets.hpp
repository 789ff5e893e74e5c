// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <boxstream/detector.hpp>

#include "base/even_parts.hpp"
#include "base/thresholds.hpp"
#include "batch/one_search.hpp"

namespace boxstream::detail {

/// The boxes of many searches, those of search i between two offsets. For single sets, `b` is the same as `a`.
template <class S>
struct ManyInputs {
  Input<S> all;
  SetOffsets offsets_a, offsets_b;

  std::size_t size() const { return offsets_a.size() - 1; }
  std::size_t boxes() const { return all.boxes(); }
  /// Boxes of the searches before that one.
  std::uint64_t boxes_before(std::size_t set) const { return offsets_a[set] + (all.self ? 0 : offsets_b[set]); }
  std::uint64_t boxes(std::size_t set) const { return boxes_before(set + 1) - boxes_before(set); }
  std::uint64_t largest() const {
    std::uint64_t most = 0;
    for (std::size_t set = 0; set < size(); ++set) most = std::max(most, boxes(set));
    return most;
  }

  Input<S> operator[](std::size_t set) const {
    const auto part = [set](auto all_of, SetOffsets offsets) {
      if (all_of.empty()) return all_of;
      const auto first = static_cast<std::size_t>(offsets[set]);
      return all_of.subspan(first, static_cast<std::size_t>(offsets[set + 1]) - first);
    };
    return {part(all.a, offsets_a),
            part(all.b, offsets_b),
            part(all.filters_a, offsets_a),
            part(all.filters_b, offsets_b),
            all.self,
            static_cast<std::uint32_t>(offsets_a[set]),
            static_cast<std::uint32_t>(offsets_b[set]),
            all.method,
            all.cutoff,
            all.faces,
            part(all.ids_a, offsets_a),
            part(all.ids_b, offsets_b),
            all.float_kind};
  }
};

/// Throws unless they ascend from zero to the number of boxes.
inline void check_offsets(SetOffsets offsets, std::size_t boxes) {
  bool right = !offsets.empty() && offsets[0] == 0 && offsets[offsets.size() - 1] == boxes;
  for (std::size_t i = 1; i < offsets.size(); ++i) right &= offsets[i - 1] <= offsets[i];
  if (!right) throw std::invalid_argument("boxstream: offsets of sets must ascend from 0 to the number of boxes");
}

/// Where sets of few boxes end that begin with the set `first`; `first` if it has more, or there are two sets each.
template <class S>
std::size_t end_of_tiny(const ManyInputs<S>& inputs, std::size_t first, std::size_t last) {
  if (!inputs.all.self || inputs.all.method != Method::planned) return first;
  while (first < last && inputs.boxes(first) <= thresholds.most_tiny) ++first;
  return first;
}

/// All of them at once.
template <class S>
void search_tiny(const ManyInputs<S>& inputs, std::size_t first, std::size_t last, PairBuffer& buffer, Stats& stats) {
  TinyCounts found;
  compare_tiny(inputs.all.a.data(), &inputs.offsets_a[first], last - first, inputs.all.faces, buffer, found);
  stats.records += found.valid;
  stats.invalid += found.boxes - found.valid;
  stats.cells += found.sets;
  for (std::size_t i = first; i < last; ++i) stats.tests += inputs.boxes(i) * (inputs.boxes(i) - 1) / 2;
}

/// The searches [first, last), one after the other; small ones write to one buffer. False when the sink refused.
template <class S>
bool search_in_turn(const ManyInputs<S>& inputs, std::size_t first, std::size_t last, Arena& arena, PairSink sink,
                    Stats& stats) {
  DeliveringBuffer<S> buffer(inputs.all, sink);
  const auto search = [&](const Input<S>& input) {
    if (is_small(input)) {
      search_small(input, buffer, stats);
      return !buffer.has_stopped();
    }
    return buffer.flush() && search_large(input, arena, nullptr, sink, stats);
  };
  bool go_on = true;
  while (first < last && go_on) {
    const std::size_t tiny = end_of_tiny(inputs, first, last);
    if (tiny == first) {
      go_on = search(inputs[first++]);
    } else {
      search_tiny(inputs, first, tiny, buffer, stats);
      go_on = !buffer.has_stopped();
      first = tiny;
    }
  }
  go_on = go_on && buffer.flush();
  stats.pairs += buffer.delivered();
  return go_on;
}

/// The same as tasks of about as many boxes each.
template <class S>
bool search_as_tasks(const ManyInputs<S>& inputs, std::size_t first, std::size_t last, const Parallel& parallel,
                     PairSink sink, Stats& stats) {
  const std::size_t boxes_of_task = parallel.least_boxes / thresholds.tasks_of_share;
  const std::uint64_t before = inputs.boxes_before(first), boxes = inputs.boxes_before(last) - before;
  OrderedTasks in_order(parallel, sink, stats);
  const std::size_t tasks = static_cast<std::size_t>(
      std::min<std::uint64_t>({last - first, boxes / boxes_of_task, thresholds.tasks_of_thread * in_order.threads()}));
  const auto begin_of = [&](std::size_t task) {
    const std::uint64_t wanted = before + boxes * task / tasks;
    std::size_t low = first, high = last;
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (inputs.boxes_before(middle) < wanted)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  };
  return in_order.run(tasks, [&](std::size_t i, Arena& arena, PairSink take, Stats& work) {
    return search_in_turn(inputs, begin_of(i), i + 1 == tasks ? last : begin_of(i + 1), arena, take, work);
  });
}

/// All searches in their order. With `parallel`, if it is not null, those of many boxes are done by all threads one
/// after the other, and those between them as tasks.
template <class S>
bool search_many(const ManyInputs<S>& inputs, Arena& arena, const Parallel* parallel, PairSink sink, Stats& stats) {
  if (parallel == nullptr) return search_in_turn(inputs, 0, inputs.size(), arena, sink, stats);
  const auto is_large = [&](std::size_t i) { return inputs.boxes(i) >= parallel->least_boxes; };
  for (std::size_t first = 0; first < inputs.size();) {
    std::size_t last = first;
    while (last < inputs.size() && !is_large(last)) ++last;
    const bool many = inputs.boxes_before(last) - inputs.boxes_before(first) >= parallel->least_boxes;
    if (!(many ? search_as_tasks(inputs, first, last, *parallel, sink, stats)
               : search_in_turn(inputs, first, last, arena, sink, stats)))
      return false;
    if (last < inputs.size() && !search_large(inputs[last], arena, parallel, sink, stats)) return false;
    first = last + 1;
  }
  return true;
}

/// The first of `pairs` from `at` on of which `a` is not below `end`; of no pair behind it is. They are counted by
/// blocks, for where they end is unpredictable.
inline std::size_t end_of_pairs(Span<const Pair> pairs, std::size_t at, std::uint32_t end) {
  constexpr std::size_t block = 16;
  while (at + block <= pairs.size()) {
    std::uint32_t below = 0;
    for (std::size_t i = 0; i < block; ++i) below += pairs[at + i].a < end ? 1 : 0;
    at += below;
    if (below < block) return at;
  }
  while (at < pairs.size() && pairs[at].a < end) ++at;
  return at;
}

/// Where the pairs of each set begin, of one of `parts` parts of the sets.
inline void find_pair_offsets(Span<const Pair> pairs, SetOffsets sets, std::size_t part, std::size_t parts,
                              Span<std::uint64_t> out) {
  const std::size_t first = begin_of_part(sets.size(), part, parts), last = begin_of_part(sets.size(), part + 1, parts);
  if (first == last) return;
  const auto is_below = [](Pair pair, std::uint64_t box) { return pair.a < box; };
  auto at =
      static_cast<std::size_t>(std::lower_bound(pairs.begin(), pairs.end(), sets[first], is_below) - pairs.begin());
  for (std::size_t i = first; i < last; ++i) out[i] = at = end_of_pairs(pairs, at, static_cast<std::uint32_t>(sets[i]));
}

}  // namespace boxstream::detail
