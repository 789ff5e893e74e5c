// SPDX-License-Identifier: MIT
// Searches by rules against brute force: open boxes, tolerances, ids and filters, in sets of any two coordinate types;
// found, streamed, stopped, thrown out of, as neighbours and cut into many sets; by both methods, and by executors that
// do their tasks in any order and on other threads.
//
// Input: byte 0: bits 0 and 1 the coordinates of the first set (float, double, int32, int64), bits 2 and 3 those of the
// second, bit 4 open, bit 5 the paper's tree, bit 6 ids, bit 7 filters; byte 1: bits 0 to 2 the executor (none; first
// task first; last one first; any order; another thread; real threads), bits 3 to 7 into how many sets both are cut,
// and the cutoff of the paper's tree; byte 2: with which batch the sink stops the search (even) or throws (odd), if not
// 0; byte 3: how many ids and filters there are, and bit 7 whether a tolerance follows, a number. Then boxes
// (sets.hpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <boxstream/detector.hpp>

#include "bytes.hpp"
#include "core/executors.hpp"
#include "finding.hpp"
#include "rules_truth.hpp"
#include "sets.hpp"
#include "truth.hpp"

namespace boxstream::fuzz {
namespace {

using tests::Boxes;
using tests::Filters;
using tests::Pairs;

constexpr std::size_t most_boxes = 300;
constexpr double most_exact = 9007199254740992.0;  // 2^53

/// A number as a coordinate. Few integers beyond what is allowed, for else most searches would be refused.
template <class S>
S coordinate(double x) {
  if constexpr (std::is_integral_v<S>) {
    if (std::isnan(x)) return 0;
    if (sizeof(S) == 8 && std::isinf(x)) return x < 0 ? std::numeric_limits<S>::min() : std::numeric_limits<S>::max();
    constexpr double most = sizeof(S) == 8 ? most_exact : static_cast<double>(std::numeric_limits<S>::max());
    return static_cast<S>(std::clamp(x, -most, most));
  } else {
    return static_cast<S>(x);
  }
}

/// Boxes of one of four coordinate types, and the same as doubles.
class AnySet {
 public:
  template <class S>
  AnySet(const Boxes<S>& read, unsigned coordinates) {
    if (coordinates == 0)
      hold<float>(read);
    else if (coordinates == 1)
      hold<double>(read);
    else if (coordinates == 2)
      hold<std::int32_t>(read);
    else
      hold<std::int64_t>(read);
  }

  BoxSpan boxes() const {
    return std::visit([](const auto& held) { return BoxSpan(held); }, held_);
  }
  const Boxes<double>& exact() const { return exact_; }
  bool is_refused() const { return is_refused_; }
  std::size_t size() const { return exact_.size(); }
  std::size_t invalid() const { return tests::count_invalid(exact_); }

 private:
  template <class S, class Read>
  void hold(const Boxes<Read>& read) {
    std::vector<BasicAabb<S>> boxes(read.size());
    exact_.resize(read.size());
    for (std::size_t i = 0; i < read.size(); ++i)
      for (int d = 0; d < 3; ++d) {
        boxes[i].min[d] = take<S>(static_cast<double>(read[i].min[d]), exact_[i].min[d]);
        boxes[i].max[d] = take<S>(static_cast<double>(read[i].max[d]), exact_[i].max[d]);
      }
    held_ = std::move(boxes);
  }

  template <class S>
  S take(double x, double& exact) {
    const S taken = coordinate<S>(x);
    exact = static_cast<double>(taken);
    is_refused_ |= std::is_integral_v<S> && std::abs(exact) > most_exact;
    return taken;
  }

  std::variant<std::vector<Aabb>, std::vector<Aabb64>, std::vector<IntAabb>, std::vector<IntAabb64>> held_;
  Boxes<double> exact_;
  bool is_refused_ = false;
};

struct Thrown {};

/// Searches of one pair of sets, or of one set with itself.
struct Searches {
  const AnySet &a, &b;
  bool self;
  PairRules rules;
  unsigned last_batch, sets;
  Pairs expected;

  Stats find(Detector& detector, Pairs& pairs) const {
    return self ? detector.find_pairs(a.boxes(), pairs, rules)
                : detector.find_pairs(a.boxes(), b.boxes(), pairs, rules);
  }
  Stats stream(Detector& detector, PairSink sink) const {
    return self ? detector.stream_pairs(a.boxes(), sink, rules)
                : detector.stream_pairs(a.boxes(), b.boxes(), sink, rules);
  }
  Stats find_neighbours(Detector& detector, Neighbours& out, Directions directions) const {
    return self ? detector.find_neighbours(a.boxes(), out, rules, directions)
                : detector.find_neighbours(a.boxes(), b.boxes(), out, rules);
  }
  Pairs find_once() const { return self ? find_pairs(a.boxes(), rules) : find_pairs(a.boxes(), b.boxes(), rules); }

  void promise_right(const Pairs& found, const char* what) const {
    const std::string wrong = difference(found, expected, a.exact(), b.exact());
    promise(wrong.empty(), std::string(self ? "one set, " : "two sets, ") + what + ": " + wrong);
  }

  void check(Detector& detector, Detector& alone) const {
    Pairs found, once;
    const Stats stats = find(detector, found);
    promise_right(found, "found");
    promise(stats.boxes == a.size() + (self ? 0 : b.size()), "Stats::boxes");
    promise(stats.invalid == a.invalid() + (self ? 0 : b.invalid()), "Stats::invalid");
    promise(stats.pairs == expected.size(), "Stats::pairs");
    find(alone, once);
    promise(once == found, "the order depends on the executor");
    promise_right(find_once(), "found once");
    check_stream(detector, found);
    check_neighbours(detector, Directions::both);
    check_neighbours(detector, Directions::one);
    check_many(detector);
    promise(detector.scratch_bytes() < (std::size_t{1} << 26), "scratch memory");
  }

  void check_stream(Detector& detector, const Pairs& found) const {
    Pairs streamed;
    std::size_t batches = 0;
    const auto sink = [&](Span<const Pair> pairs) {
      promise(!pairs.empty(), "an empty batch");
      streamed.insert(streamed.end(), pairs.begin(), pairs.end());
      if (++batches != last_batch) return true;
      if (last_batch % 2 == 1) throw Thrown();
      return false;
    };
    bool has_thrown = false;
    try {
      promise(stream(detector, sink).pairs == streamed.size(), "Stats::pairs of a stream");
    } catch (const Thrown&) {
      has_thrown = true;
    }
    const bool is_stopped = last_batch != 0 && batches == last_batch;
    promise(has_thrown == (is_stopped && last_batch % 2 == 1), "what a sink throws passes through");
    promise(is_stopped || streamed.size() == found.size(), "a stream ended too early");
    promise(streamed.size() <= found.size() && std::equal(streamed.begin(), streamed.end(), found.begin()),
            "streamed in another order than found");
  }

  void check_neighbours(Detector& detector, Directions directions) const {
    Pairs of_rows = expected;
    if (self && directions == Directions::both)
      for (const Pair pair : expected) of_rows.push_back({pair.b, pair.a});
    std::sort(of_rows.begin(), of_rows.end());
    Neighbours rows;
    promise(find_neighbours(detector, rows, directions).pairs == expected.size(), "Stats::pairs of neighbours");
    promise(rows.offsets.size() == a.size() + 1 && rows.offsets.front() == 0, "Neighbours::offsets");
    Pairs found;
    for (std::uint32_t i = 0; i < a.size(); ++i)
      for (std::uint64_t at = rows.offsets[i]; at < rows.offsets[i + 1]; ++at)
        found.push_back({i, rows.indices.at(static_cast<std::size_t>(at))});
    promise(found == of_rows, "neighbours");
  }

  void check_many(Detector& detector) const {
    const auto cuts_a = cut(a.size(), sets), cuts_b = cut(b.size(), sets);
    Pairs within = expected;
    within.erase(std::remove_if(within.begin(), within.end(),
                                [&](Pair pair) { return set_of(pair.a, cuts_a) != set_of(pair.b, cuts_b); }),
                 within.end());
    PairsOfSets found;
    if (self)
      detector.find_pairs(a.boxes(), cuts_a, found, rules);
    else
      detector.find_pairs(a.boxes(), cuts_a, b.boxes(), cuts_b, found, rules);
    const std::string wrong = difference(found.pairs, within, a.exact(), b.exact());
    promise(wrong.empty(), "many sets: " + wrong);
    promise(found.offsets.size() == sets + 1 && found.offsets.back() == within.size(), "PairsOfSets::offsets");
  }

  void check_refused(Detector& detector) const {
    Pairs found(1);
    try {
      find(detector, found);
    } catch (const std::invalid_argument&) {
      promise(found.empty(), "an output of a search that was refused");
      return;
    }
    promise(false, "an integer that no double holds was taken");
  }
};

std::unique_ptr<Executor> make_executor(unsigned kind) {
  constexpr unsigned threads = 4;
  switch (kind) {
    case 1:
      return std::make_unique<tests::InlineExecutor>(threads, 0);
    case 2:
      return std::make_unique<tests::ReversedExecutor>(threads);
    case 3:
      return std::make_unique<tests::ShuffledExecutor>(threads);
    case 4:
      return std::make_unique<tests::ElsewhereExecutor>(threads);
    case 5:
      return std::make_unique<tests::ThreadExecutor>(threads);
    default:
      return nullptr;
  }
}

std::vector<std::uint32_t> some_ids(std::size_t boxes, std::uint32_t different) {
  std::minstd_rand random(different);
  std::vector<std::uint32_t> ids(boxes);
  for (std::uint32_t& id : ids) id = static_cast<std::uint32_t>(random() >> 8) % different;
  return ids;
}

Filters some_filters(std::size_t boxes, std::uint32_t different) {
  std::minstd_rand random(different);
  Filters filters(boxes);
  for (Filter& filter : filters) {
    const unsigned kind = static_cast<unsigned>(random() >> 8) % different;
    filter = {1u << kind % 32, kind % 3 == 0 ? ~(1u << kind % 32) : 0xffu << kind / 2 % 32};
  }
  return filters;
}

template <class S>
void run(Bytes& in, unsigned flags) {
  const unsigned way = in.byte(), last_batch = in.byte(), different = in.byte();
  PairRules rules;
  rules.touching = (flags & 16) == 0;
  if ((different & 128) != 0) {
    const double tolerance = std::abs(in.number<double>());
    if (std::isfinite(tolerance)) rules.tolerance = tolerance;
  }
  const TwoSets<S> read = read_sets<S>(in, most_boxes);
  const AnySet a(read.a, flags & 3), b(read.b, flags >> 2 & 3);

  const std::uint32_t kinds = 1 + different % 128;
  const auto ids_a = some_ids(a.size(), kinds), ids_b = some_ids(b.size(), kinds);
  const Filters filters_a = some_filters(a.size(), kinds), filters_b = some_filters(b.size(), kinds);
  if ((flags & 64) != 0) rules.ids = ids_a;
  if ((flags & 128) != 0) rules.filters = filters_a;
  PairRules of_two = rules;
  if ((flags & 64) != 0) of_two.ids_b = ids_b;
  if ((flags & 128) != 0) of_two.filters_b = filters_b;

  const std::unique_ptr<Executor> executor = make_executor(way & 7);
  DetectorOptions options;
  options.method = (flags & 32) != 0 ? Method::hybrid : Method::planned;
  options.cutoff = way >> 3;
  Detector alone(options);
  options.executor = executor.get();
  Detector made(options);
  Detector detector = std::move(made);

  const unsigned sets = 1 + (way >> 3);
  if (a.is_refused())
    Searches{a, a, true, rules, last_batch, sets, {}}.check_refused(detector);
  else
    Searches{a, a, true, rules, last_batch, sets, truth(a.exact(), rules)}.check(detector, alone);
  if (a.is_refused() || b.is_refused())
    Searches{a, b, false, of_two, last_batch, sets, {}}.check_refused(detector);
  else
    Searches{a, b, false, of_two, last_batch, sets, truth(a.exact(), b.exact(), of_two)}.check(detector, alone);
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream::fuzz;
  Bytes in(data, size);
  const unsigned flags = in.byte();
  if ((flags & 3) == 0)
    run<float>(in, flags);
  else
    run<double>(in, flags);
  return 0;
}
