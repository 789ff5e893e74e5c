// SPDX-License-Identifier: MIT
#include "papers/experiments/measure.hpp"

#include <algorithm>
#include <boxstream/detector.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

namespace boxstream::papers {

namespace {

template <class Stream>
Measured measure_stream(int repeats, const Stream& stream) {
  Detector detector;
  PairSum found;
  const auto sink = [&](Span<const Pair> pairs) {
    for (const Pair pair : pairs) found.add(pair.a, pair.b);
    return true;
  };
  stream(detector, sink);
  const double ms = measure_time(
      repeats, [&] { found = {}; }, [&] { stream(detector, sink); });
  return {ms, found};
}

std::uint32_t hash_of(const Box& box) {
  std::uint64_t hash = 0;
  for (const Interval& i : box.projections) {
    hash = (hash ^ static_cast<std::uint32_t>(i.lo)) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 29) ^ static_cast<std::uint32_t>(i.hi)) * 0xd6e8feb86659fd93u;
  }
  return static_cast<std::uint32_t>(hash >> 32);
}

void add_by_ends(PairSum& sum, const Box& a, const Box& b) {
  const std::uint32_t x = hash_of(a), y = hash_of(b);
  sum.add(std::min(x, y), std::max(x, y));
}

}  // namespace

double measure_time(int repeats, const std::function<void()>& prepare, const std::function<void()>& run) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    prepare();
    times.push_back(measure::time_once(run));
  }
  return measure::median(std::move(times));
}

Measured measure(int repeats, const std::function<void(Found)>& search) {
  PairSum found;
  const auto sink = [&](std::uint32_t a, std::uint32_t b) { found.add(a, b); };
  const double ms = measure_time(
      repeats, [&] { found = {}; }, [&] { search(sink); });
  return {ms, found};
}

Measured measure_engine(int repeats, const std::vector<Aabb>& boxes) {
  return measure_stream(repeats, [&](Detector& detector, const auto& sink) { detector.stream_pairs(boxes, sink); });
}

Measured measure_engine(int repeats, const std::vector<Aabb>& a, const std::vector<Aabb>& b) {
  return measure_stream(repeats, [&](Detector& detector, const auto& sink) { detector.stream_pairs(a, b, sink); });
}

void require_same(const PairSum& found, const PairSum& expected, const std::string& what) {
  if (found == expected) return;
  throw std::runtime_error(what + " does not find the same pairs: " + std::to_string(found.pairs) + " of " +
                           std::to_string(expected.pairs));
}

void require_same_boxes(VersionOne& version, const HybridOptions& options, const std::vector<Box>& boxes,
                        const std::vector<Aabb>& closed) {
  PairSum found, expected;
  version.find_pairs(VersionOne::Sorting::structures, options, [&](std::uint32_t a, std::uint32_t b) {
    add_by_ends(found, version.boxes()[a], version.boxes()[b]);
  });
  Detector().stream_pairs(closed, [&](Span<const Pair> pairs) {
    for (const Pair pair : pairs) add_by_ends(expected, boxes[pair.a], boxes[pair.b]);
    return true;
  });
  require_same(found, expected, "Version One");
}

measure::Interleaving all_rounds(int repeats) {
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  return {repeats, 0, no_limit, no_limit};
}

std::vector<Measured> measure_interleaved(int repeats, const std::vector<Contestant>& contestants) {
  std::vector<std::vector<double>> times(contestants.size());
  std::vector<Measured> all(contestants.size());
  measure::interleave(
      contestants.size(), all_rounds(repeats), measure::Order::forwards, [](int) {},
      [&](int, std::size_t c) {
        PairSum found;
        const auto sink = [&](std::uint32_t a, std::uint32_t b) { found.add(a, b); };
        times[c].push_back(measure::time_once([&] { contestants[c].search(sink); }));
        all[c].found = found;
        require_same(found, all[0].found, contestants[c].name);
      });
  for (std::size_t c = 0; c < contestants.size(); ++c) all[c].ms = measure::median(std::move(times[c]));
  return all;
}

}  // namespace boxstream::papers
