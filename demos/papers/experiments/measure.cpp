// SPDX-License-Identifier: MIT
#include "papers/experiments/measure.hpp"

#include <algorithm>
#include <boxstream/detector.hpp>
#include <stdexcept>
#include <utility>

#include "base/clock.hpp"

namespace boxstream::papers {

double thread_ms() {
  return scenes::milliseconds(scenes::now());
}

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

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double measure_time(int repeats, const std::function<void()>& prepare, const std::function<void()>& run) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    prepare();
    const double begun = thread_ms();
    run();
    times.push_back(thread_ms() - begun);
  }
  return median(std::move(times));
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

std::vector<Measured> measure_in_turns(int repeats, const std::vector<Contestant>& contestants) {
  std::vector<std::vector<double>> times(contestants.size());
  std::vector<Measured> all(contestants.size());
  for (int i = 0; i < repeats; ++i)
    for (std::size_t c = 0; c < contestants.size(); ++c) {
      PairSum found;
      const auto sink = [&](std::uint32_t a, std::uint32_t b) { found.add(a, b); };
      const double begun = thread_ms();
      contestants[c].search(sink);
      times[c].push_back(thread_ms() - begun);
      all[c].found = found;
      require_same(found, all[0].found, contestants[c].name);
    }
  for (std::size_t c = 0; c < contestants.size(); ++c) all[c].ms = median(std::move(times[c]));
  return all;
}

}  // namespace boxstream::papers
