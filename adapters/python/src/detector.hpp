// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "arrays.hpp"
#include "block_sink.hpp"
#include "executor.hpp"
#include "usage.hpp"

namespace boxstream::python {

/// Where a search takes place: a Detector with the Executor that it borrows.
class PyDetector {
 public:
  explicit PyDetector(py::handle executor, const DetectorOptions& options = {})
      : executor_(executor_of(executor)), detector_({executor_.get(), options.method, options.cutoff}) {}

  py::array find_pairs(py::handle boxes, py::handle other, py::handle groups, py::handle masks, py::handle invalid);
  std::uint64_t stream_pairs(py::handle boxes, py::handle callback, py::handle other, py::handle groups,
                             py::handle masks, py::handle block, py::handle invalid);
  py::tuple find_pairs_in_sets(py::handle boxes, py::handle offsets, py::handle other, py::handle other_offsets,
                               py::handle groups, py::handle masks, py::handle invalid);
  py::array find_near_pairs(py::handle balls, py::handle distance, py::handle invalid);
  std::uint64_t stream_near_pairs(py::handle balls, py::handle distance, py::handle callback, py::handle block,
                                  py::handle invalid);

  const Stats& stats() const { return stats_; }
  std::size_t scratch_bytes() const { return detector_.scratch_bytes(); }

 private:
  /// `search(detector, unlocked)` without the interpreter's lock, alone in this detector.
  template <class Search>
  void run(Search search) {
    const Usage::Change change(usage_);
    stats_ = without_lock([&](const Unlocked& unlocked) { return search(detector_, unlocked); });
  }

  /// `search(detector, sink)` for a sink that passes blocks to `callback`. Returns how many pairs were passed on.
  template <class Search>
  std::uint64_t stream(py::handle callback, py::handle block, Search search) {
    const Blocks blocks(callback, block);
    std::uint64_t passed = 0;
    run([&](Detector& detector, const Unlocked& unlocked) {
      BlockSink sink(blocks, unlocked);
      bool stopped = false;
      const auto listen = [&](Span<const Pair> pairs) { return !(stopped = !sink(pairs)); };
      const Stats stats = search(detector, PairSink(listen));
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
