// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "block_sink.hpp"
#include "executor.hpp"
#include "search.hpp"
#include "signals.hpp"
#include "usage.hpp"

namespace boxstream::python {

/// Where a search takes place: a Detector with the Executor that it borrows.
class PyDetector {
 public:
  explicit PyDetector(py::handle executor, const DetectorOptions& options = {})
      : executor_(executor_of(executor)), detector_({executor_.get(), options.method, options.cutoff}) {}

  py::array find_pairs(const Search& search, py::handle dtype, py::handle max_pairs);
  py::tuple find_pairs_in_sets(const Search& search, py::handle offsets, py::handle other_offsets, py::handle dtype);
  py::tuple find_neighbours(const Search& search, py::handle both, py::handle dtype);
  std::uint64_t stream_pairs(const Search& search, py::handle callback, py::handle block, py::handle dtype);
  py::array find_near_pairs(const NearSearch& search, py::handle dtype, py::handle max_pairs);
  std::uint64_t stream_near_pairs(const NearSearch& search, py::handle callback, py::handle block, py::handle dtype);

  const Stats& stats() const { return stats_; }
  std::size_t scratch_bytes() const { return detector_.scratch_bytes(); }

 private:
  /// `search(detector, unlocked)` without the interpreter's lock, alone in this detector.
  template <class Search>
  void run(Search search) {
    const Usage::Change change(usage_);
    stats_ = without_lock([&](const Unlocked& unlocked) { return search(detector_, unlocked); });
  }

  /// `search(detector, sink)`, whose pairs are collected; MemoryError for more than `max_pairs` (None: any number), or
  /// than there is memory for.
  template <class Find>
  std::vector<Pair> collect(py::handle max_pairs, Find find) {
    const std::size_t most = max_pairs.is_none() ? SIZE_MAX : count_of(max_pairs, "max_pairs", 0);
    std::vector<Pair> pairs;
    bool too_many = false;
    try {
      run([&](Detector& detector, const Unlocked& unlocked) {
        Signals signals(unlocked);
        const auto add = [&](Span<const Pair> found) {
          signals.check();
          too_many = found.size() > most - pairs.size();
          if (!too_many) pairs.insert(pairs.end(), found.begin(), found.end());
          return !too_many;
        };
        return find(detector, PairSink(add));
      });
    } catch (const std::bad_alloc&) {
      refuse_pairs("there is not enough memory for the search and its pairs");
    }
    if (too_many) refuse_pairs("more pairs than max_pairs=" + std::to_string(most));
    return pairs;
  }
  [[noreturn]] static void refuse_pairs(const std::string& what);

  /// `search(detector, sink)` for a sink that passes blocks to `callback`. Returns how many pairs were passed on.
  template <class Find>
  std::uint64_t stream(py::handle callback, py::handle block, py::handle dtype, Find find) {
    const Blocks blocks(callback, block, indices_of(dtype));
    std::uint64_t passed = 0;
    run([&](Detector& detector, const Unlocked& unlocked) {
      BlockSink sink(blocks, unlocked);
      bool stopped = false;
      const auto listen = [&](Span<const Pair> pairs) { return !(stopped = !sink(pairs)); };
      const Stats stats = find(detector, PairSink(listen));
      if (!stopped) sink.finish();
      passed = sink.passed();
      return stats;
    });
    return passed;
  }

  std::shared_ptr<ThreadPool> executor_;
  Detector detector_;
  Stats stats_;
  Usage usage_{"Detector"};
};

void add_stats(py::module_& module);
void add_detector(py::module_& module);

}  // namespace boxstream::python
