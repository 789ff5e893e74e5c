// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "apart.hpp"
#include "arrays.hpp"
#include "block_sink.hpp"
#include "executor.hpp"
#include "search.hpp"
#include "signals.hpp"
#include "usage.hpp"

namespace boxstream::python {

using GoesOn = FunctionRef<bool()>;

/// What is searched, which a search that its caller has left goes on with.
using SearchPointer = std::shared_ptr<const Search>;

/// Where a search takes place: a Detector with the Executor that it borrows.
class PyDetector {
 public:
  explicit PyDetector(py::handle executor, const DetectorOptions& options = {})
      : executor_(executor_of(executor)), detector_({executor_.get(), options.method, options.cutoff}) {}

  py::array find_pairs(SearchPointer search, py::handle dtype, py::handle max_pairs);
  py::tuple find_pairs_in_sets(SearchPointer search, py::handle offsets, py::handle other_offsets, py::handle dtype);
  py::tuple find_neighbours(SearchPointer search, py::handle both, py::handle dtype);
  std::uint64_t stream_pairs(const Search& search, py::handle callback, py::handle block, py::handle dtype);
  py::array find_near_pairs(std::shared_ptr<const NearSearch> search, py::handle dtype, py::handle max_pairs);
  std::uint64_t stream_near_pairs(const NearSearch& search, py::handle callback, py::handle block, py::handle dtype);

  const Stats& stats() const { return stats_; }
  std::size_t scratch_bytes() {
    const Usage::Read read(usage_);
    return detector_.scratch_bytes();
  }
  void shrink_to_fit() {
    const Usage::Change change(usage_);
    detector_.shrink_to_fit();
  }

 private:
  /// `search(detector, unlocked)` without the interpreter's lock, alone in this detector.
  template <class Search>
  void run(Search search) {
    const Usage::Change change(usage_);
    stats_ = without_lock([&](const Unlocked& unlocked) { return search(detector_, unlocked); });
  }

  /// `search(detector, goes_on)` of so many boxes, alone in this detector. From `least` on it is run apart, and may run
  /// on after this has thrown: it owns all that it uses, and this detector stays in use. `goes_on` is to be called now
  /// and then: it handles signals, and returns false once the result is no longer wanted. A search that cannot call it
  /// has `least_apart_silent`.
  template <class Search>
  void run_whole(std::size_t boxes, std::size_t least, Search search) {
    if (boxes < least) {
      run([&](Detector& detector, const Unlocked& unlocked) {
        Signals signals(unlocked);
        return search(detector, GoesOn([&] {
                        signals.check();
                        return true;
                      }));
      });
      return;
    }
    struct Held {
      Held(py::object object, Usage& usage, Search work)
          : self(std::move(object)), change(usage), search(std::move(work)) {}
      py::object self;
      Usage::Change change;
      Search search;
      std::atomic<bool> left = false;
      Stats stats;
    };
    const auto held = std::make_shared<Held>(py::cast(this, py::return_value_policy::reference), usage_, search);
    const auto work = [this, held] { held->stats = held->search(detector_, GoesOn([&] { return !held->left; })); };
    run_apart(work, &held->left);
    stats_ = held->stats;
  }

  /// `search(detector, sink)`, whose pairs are collected; MemoryError for more than `max_pairs` (None: any number), or
  /// than there is memory for.
  template <class Find>
  std::vector<Pair> collect(py::handle max_pairs, std::size_t boxes, Find find) {
    const std::size_t most = max_pairs.is_none() ? SIZE_MAX : count_of(max_pairs, "max_pairs", 0);
    struct Collected {
      std::vector<Pair> pairs;
      bool too_many = false;
    };
    const auto collected = std::make_shared<Collected>();
    try {
      run_whole(boxes, least_apart, [collected, most, find = std::move(find)](Detector& detector, GoesOn goes_on) {
        auto& [pairs, too_many] = *collected;
        const auto add = [&](Span<const Pair> found) {
          if (!goes_on()) return false;
          too_many = found.size() > most - pairs.size();
          if (!too_many) pairs.insert(pairs.end(), found.begin(), found.end());
          return !too_many;
        };
        return find(detector, PairSink(add));
      });
    } catch (const std::bad_alloc&) {
      refuse_pairs("there is not enough memory for the search and its pairs");
    }
    if (collected->too_many) refuse_pairs("more pairs than max_pairs=" + std::to_string(most));
    return std::move(collected->pairs);
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
