// SPDX-License-Identifier: MIT
#include <boxstream/out_of_core.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <boxstream/detector.hpp>

#include "out_of_core/budget.hpp"
#include "out_of_core/loaded_boxes.hpp"
#include "out_of_core/numbered_boxes.hpp"
#include "out_of_core/regions.hpp"
#include "out_of_core/stored_boxes.hpp"
#include "out_of_core/stream_sample.hpp"
#include "out_of_core/temporary_file.hpp"

namespace boxstream {

namespace {

using detail::Budget;
using detail::check_tolerance;
using detail::LoadedBoxes;
using detail::NumberedBox;
using detail::NumberedBoxes;
using detail::Region;
using detail::Regions;
using detail::StoredBoxes;
using detail::StreamSample;
using detail::TemporaryFile;

template <class S>
class OutOfCoreSearch {
 public:
  OutOfCoreSearch(WidePairSink sink, const OutOfCoreOptions& options, OutOfCoreStats& stats)
      : options_(options),
        executor_(options.memory < Budget::least_shared ? nullptr : options.executor),
        budget_(Budget::of<S>(options.memory)),
        stats_(stats),
        sink_(sink),
        loaded_(budget_.boxes) {}

  void run(BasicBoxReader<S>& reader) {
    owned_.reserve(budget_.pairs);
    check_tolerance(options_.tolerance);
    detail::ReaderBoxes<S> boxes(reader, budget_.block / sizeof(NumberedBox<S>), options_, stats_);
    search(boxes, {}, UINT64_MAX);
    if (!file_) return;
    stats_.bytes_written = file_->bytes_written();
    stats_.bytes_read = file_->bytes_read();
    stats_.file_bytes = file_->size();
  }

 private:
  /// Finds the pairs that the region owns among the boxes that touch it. `above` is the number of boxes of the region
  /// that it is a part of. False when the sink wants no more.
  bool search(NumberedBoxes<S>& boxes, const Region<S>& region, std::uint64_t above) {
    std::optional<Regions<S>> regions;
    const std::uint64_t size = load(boxes, region, above, regions);
    if (size <= budget_.boxes) return join([](Pair) { return true; });
    if (!regions || regions->size() == 1) return search_blocks(boxes, region);
    std::vector<StoredBoxes<S>> parts = distribute(boxes, *regions);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      StoredBoxes<S> part = std::move(parts[i]);  // its blocks are free afterwards
      if (!search(part, (*regions)[i], size)) return false;
    }
    return true;
  }

  /// As many as fit, and regions to divide the others into, unless the sample of the region above was off. Returns how
  /// many there are.
  std::uint64_t load(NumberedBoxes<S>& boxes, const Region<S>& region, std::uint64_t above,
                     std::optional<Regions<S>>& regions) {
    StreamSample<S> sample(budget_.sample);
    std::uint64_t size = 0;
    loaded_.cut_off_at(0);
    for_each(boxes, [&](const NumberedBox<S>& box) {
      ++size;
      sample.add(box.box);
      if (!loaded_.is_full()) loaded_.add(box, region);
      return true;
    });
    if (size > budget_.boxes && size <= above - above / 8)
      regions.emplace(region, sample.boxes(), sampled_that_fit(size, sample.size()), budget_.regions);
    return size;
  }

  /// How many of the sample are to touch a region: some less than fit, for a sample estimates. In integers, for the
  /// caller may trap what rounds.
  std::size_t sampled_that_fit(std::uint64_t size, std::size_t sampled) const {
    return static_cast<std::size_t>(std::uint64_t{budget_.boxes} * sampled / size * 4 / 5);
  }

  std::vector<StoredBoxes<S>> distribute(NumberedBoxes<S>& boxes, const Regions<S>& regions) {
    if (!file_) file_.emplace(options_.directory, budget_.block);
    std::vector<StoredBoxes<S>> parts;
    parts.reserve(regions.size());
    for (std::size_t i = 0; i < regions.size(); ++i) parts.emplace_back(*file_);
    for_each(boxes, [&](const NumberedBox<S>& box) {
      regions.for_each_touched(box.box, [&](std::size_t i) { parts[i].push(box); });
      return true;
    });
    for (StoredBoxes<S>& part : parts) {
      part.finish();
      stats_.copies += part.size();
    }
    return parts;
  }

  /// Blocks of boxes with each other, all with all: one is loaded, and behind it each of those that follow.
  bool search_blocks(NumberedBoxes<S>& boxes, const Region<S>& region) {
    const std::size_t in_block = budget_.boxes / 2;
    for (std::uint64_t begin = 0, at = 1; at > begin; begin += in_block) {
      at = 0;
      loaded_.cut_off_at(0);
      bool is_first = true;
      const auto join_blocks = [&] {
        const bool go_on = join([&](Pair pair) { return pair.b < in_block ? is_first : pair.a < in_block; });
        is_first = false;
        loaded_.cut_off_at(in_block);
        return go_on;
      };
      const auto take = [&](const NumberedBox<S>& box) {
        if (at++ >= begin) loaded_.add(box, region);
        return loaded_.size() < 2 * in_block || join_blocks();
      };
      if (!for_each(boxes, take)) return false;
      if ((is_first || loaded_.size() > in_block) && !join_blocks()) return false;
    }
    return true;
  }

  /// Finds pairs among the loaded boxes and passes on those that are wanted and owned by their region. The Detector is
  /// a new one each time: memory that it would keep from one search is needed for the next.
  template <class Wanted>
  bool join(const Wanted& is_wanted) {
    ++stats_.searches;
    bool go_on = true;
    const auto take = [&](Span<const Pair> pairs) {
      for (const Pair pair : pairs)
        if (go_on && loaded_.owns(pair) && is_wanted(pair)) go_on = deliver(loaded_.numbers(pair));
      return go_on = go_on && pass_on();
    };
    PairRules rules;
    rules.touching = options_.touching;
    Detector({executor_}).stream_pairs(loaded_.boxes(), take, rules);
    return go_on;
  }

  bool deliver(WidePair pair) {
    owned_.push_back(pair);
    return owned_.size() < budget_.pairs || pass_on();
  }

  bool pass_on() {
    stats_.pairs += owned_.size();
    const bool go_on = owned_.empty() || sink_(owned_);
    owned_.clear();
    return go_on;
  }

  const OutOfCoreOptions& options_;
  Executor* const executor_;
  const Budget budget_;
  OutOfCoreStats& stats_;
  WidePairSink sink_;
  std::vector<WidePair> owned_;
  LoadedBoxes<S> loaded_;
  std::optional<TemporaryFile> file_;
};

template <class S>
OutOfCoreStats stream(BasicBoxReader<S>& boxes, WidePairSink sink, const OutOfCoreOptions& options) {
  OutOfCoreStats stats;
  OutOfCoreSearch<S>(sink, options, stats).run(boxes);
  return stats;
}

}  // namespace

OutOfCoreStats stream_pairs(BoxReader& boxes, WidePairSink sink, const OutOfCoreOptions& options) {
  return stream(boxes, sink, options);
}

OutOfCoreStats stream_pairs(BoxReader64& boxes, WidePairSink sink, const OutOfCoreOptions& options) {
  return stream(boxes, sink, options);
}

}  // namespace boxstream
