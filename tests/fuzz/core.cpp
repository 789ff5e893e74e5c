// SPDX-License-Identifier: MIT
// Searches of box sets against brute force: one set and two, and each cut into many; collected, streamed and stopped,
// with and without filters and tasks.
//
// Input: byte 0: bit 0 double, bit 1 filters, bit 2 an executor that claims 4 threads, bits 3 to 7 into how many sets
// both are cut; byte 1: with which batch the sink stops the search, if not 0, and by its lowest four bits the cutoff of
// the paper's tree, which searches as well; with filters: byte 2, how many different ones, and two bytes (group, mask)
// for each. Then boxes (sets.hpp).
#include <algorithm>
#include <string>

#include <boxstream/detector.hpp>

#include "bytes.hpp"
#include "core/executors.hpp"
#include "either_scalar.hpp"
#include "finding.hpp"
#include "sets.hpp"
#include "truth.hpp"

namespace boxstream::fuzz {
namespace {

using tests::Boxes;
using tests::Filters;
using tests::Pairs;

constexpr std::size_t most_boxes = 400;

template <class S>
struct Sets : TwoSets<S> {
  Filters filters_a, filters_b;
};

template <class S>
Sets<S> read_sets(Bytes& in, const Filters& filters) {
  Sets<S> sets{fuzz::read_sets<S>(in, most_boxes), {}, {}};
  for (std::size_t i = 0; i < sets.a.size() && !filters.empty(); ++i)
    sets.filters_a.push_back(filters[i % filters.size()]);
  for (std::size_t i = 0; i < sets.b.size() && !filters.empty(); ++i)
    sets.filters_b.push_back(filters[(7 * i + 1) % filters.size()]);
  return sets;
}

/// One kind of search in all the ways to get its pairs; `find` and `stream` run it.
template <class S, class Find, class Stream>
void check(const Sets<S>& sets, bool self, const Pairs& expected, unsigned stop, Find find, Stream stream) {
  const Boxes<S>& b = self ? sets.a : sets.b;
  Pairs collected;
  const Stats stats = find(collected);
  const std::string wrong = difference(collected, expected, sets.a, b);
  promise(wrong.empty(), (self ? "one set: " : "two sets: ") + wrong);
  promise(stats.boxes == sets.a.size() + (self ? 0 : b.size()), "Stats::boxes");
  promise(stats.invalid == tests::count_invalid(sets.a) + (self ? 0 : tests::count_invalid(b)), "Stats::invalid");
  promise(stats.pairs == expected.size(), "Stats::pairs");

  Pairs streamed;
  std::size_t batches = 0;
  const Stats of_stream = stream([&](Span<const Pair> pairs) {
    promise(!pairs.empty(), "an empty batch");
    promise(stop == 0 || batches < stop, "called again after it returned false");
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
    return ++batches != stop;
  });
  promise(of_stream.pairs == streamed.size(), "Stats::pairs of a stream");
  promise(streamed.size() <= collected.size() && std::equal(streamed.begin(), streamed.end(), collected.begin()),
          "streamed in another order than collected");
  promise((stop != 0 && batches == stop) || streamed.size() == collected.size(), "a stream ended too early");
}

/// The same boxes cut into many sets. `whole` are their pairs without the cuts.
template <class S, class Find, class Stream>
void check_many(const Boxes<S>& a, const Boxes<S>& b, unsigned count, Pairs whole, Find find, Stream stream) {
  const std::vector<std::uint64_t> cuts_a = cut(a.size(), count), cuts_b = cut(b.size(), count);
  whole.erase(std::remove_if(whole.begin(), whole.end(),
                             [&](Pair pair) { return set_of(pair.a, cuts_a) != set_of(pair.b, cuts_b); }),
              whole.end());
  PairsOfSets found;
  find(cuts_a, cuts_b, found);
  const std::string wrong = difference(found.pairs, whole, a, b);
  promise(wrong.empty(), "many sets: " + wrong);
  promise(found.offsets.size() == count + 1 && found.offsets.front() == 0 && found.offsets.back() == whole.size(),
          "PairsOfSets::offsets");
  for (std::size_t set = 0; set < count; ++set)
    for (std::uint64_t i = found.offsets[set]; i < found.offsets[set + 1]; ++i)
      promise(set_of(found.pairs[i].a, cuts_a) == set, "a pair of another set");

  Pairs streamed;
  stream(cuts_a, cuts_b, [&](Span<const Pair> pairs) {
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
    return true;
  });
  promise(streamed == found.pairs, "many sets: streamed in another order than collected");
}

template <class S>
void run(Bytes& in, unsigned flags) {
  const unsigned stop = in.byte();
  Filters filters;
  if ((flags & 2) != 0)
    for (unsigned left = 1 + in.below(8); left > 0; --left) {
      const std::uint32_t group = in.byte();
      filters.push_back({group, in.byte()});
    }
  const Sets<S> sets = read_sets<S>(in, filters);
  const Pairs one_set = truth(sets.a, sets.filters_a);
  const Pairs two_sets = truth(sets.a, sets.b, sets.filters_a, sets.filters_b);

  tests::InlineExecutor four(4);
  Detector detector({(flags & 4) != 0 ? &four : nullptr});
  check(
      sets, true, one_set, stop, [&](Pairs& pairs) { return detector.find_pairs(sets.a, pairs, sets.filters_a); },
      [&](PairSink sink) { return detector.stream_pairs(sets.a, sink, sets.filters_a); });
  check(
      sets, false, two_sets, stop,
      [&](Pairs& pairs) { return detector.find_pairs(sets.a, sets.b, pairs, sets.filters_a, sets.filters_b); },
      [&](PairSink sink) { return detector.stream_pairs(sets.a, sets.b, sink, sets.filters_a, sets.filters_b); });

  const unsigned count = 1 + (flags >> 3);
  check_many(
      sets.a, sets.a, count, one_set,
      [&](SetOffsets cuts, SetOffsets, PairsOfSets& out) { detector.find_pairs(sets.a, cuts, out, sets.filters_a); },
      [&](SetOffsets cuts, SetOffsets, PairSink sink) { detector.stream_pairs(sets.a, cuts, sink, sets.filters_a); });
  check_many(
      sets.a, sets.b, count, two_sets,
      [&](SetOffsets cuts_a, SetOffsets cuts_b, PairsOfSets& out) {
        detector.find_pairs(sets.a, cuts_a, sets.b, cuts_b, out, sets.filters_a, sets.filters_b);
      },
      [&](SetOffsets cuts_a, SetOffsets cuts_b, PairSink sink) {
        detector.stream_pairs(sets.a, cuts_a, sets.b, cuts_b, sink, sets.filters_a, sets.filters_b);
      });

  // The paper's tree finds the same.
  DetectorOptions of_paper;
  of_paper.executor = (flags & 4) != 0 ? &four : nullptr;
  of_paper.method = Method::hybrid;
  of_paper.cutoff = stop % 16;
  Detector paper(of_paper);
  check(
      sets, true, one_set, stop, [&](Pairs& pairs) { return paper.find_pairs(sets.a, pairs, sets.filters_a); },
      [&](PairSink sink) { return paper.stream_pairs(sets.a, sink, sets.filters_a); });
  check(
      sets, false, two_sets, stop,
      [&](Pairs& pairs) { return paper.find_pairs(sets.a, sets.b, pairs, sets.filters_a, sets.filters_b); },
      [&](PairSink sink) { return paper.stream_pairs(sets.a, sets.b, sink, sets.filters_a, sets.filters_b); });

  // Whatever runs the tasks, and whatever was searched before, the order is the same.
  Pairs used, fresh;
  detector.find_pairs(sets.a, used, sets.filters_a);
  Detector().find_pairs(sets.a, fresh, sets.filters_a);
  promise(used == fresh, "the order depends on the executor or on what was searched before");
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream::fuzz;
  return run_with_either_scalar(data, size, []<class S>(Bytes& in, unsigned flags) { run<S>(in, flags); });
}
