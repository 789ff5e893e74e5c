// SPDX-License-Identifier: MIT
#include <boxstream/out_of_core.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include <boxstream/detector.hpp>

#include "out_of_core/loaded_boxes.hpp"
#include "out_of_core/numbered_boxes.hpp"
#include "out_of_core/regions.hpp"
#include "out_of_core/stored_boxes.hpp"
#include "out_of_core/stream_sample.hpp"
#include "out_of_core/temporary_file.hpp"

namespace boxstream {

namespace {

using detail::LoadedBoxes;
using detail::NumberedBox;
using detail::NumberedBoxes;
using detail::Region;
using detail::Regions;
using detail::StoredBoxes;
using detail::StreamSample;
using detail::TemporaryFile;

/// How the memory is used: a quarter for a block of each region that is written, and for the sample; the rest for the
/// boxes that are searched.
struct Budget {
  static constexpr std::uint64_t least = 64 << 10, least_block = 4 << 10, most_block = 1 << 20, most_regions = 256;
  static constexpr std::uint64_t most_sampled = 1 << 16;
  static constexpr std::uint64_t copies_of_sample = 4;  // what Regions makes of it is in the parts of its leaves
  static constexpr std::uint64_t scratch_of_box = 64;   // of a Detector: 39 to 58 bytes

  template <class S>
  static Budget of(std::uint64_t memory) {
    if (memory < least) throw std::invalid_argument("boxstream: searches out of core need 64 KiB of memory");
    constexpr std::uint64_t of_box = sizeof(NumberedBox<S>) + 1 + scratch_of_box;
    const std::uint64_t block = std::clamp(memory / 4 / most_regions, least_block, most_block);
    return {
        static_cast<std::size_t>(std::min<std::uint64_t>(memory / 4 * 3 / of_box, UINT32_MAX - 1)),
        static_cast<std::size_t>(block), static_cast<std::size_t>(std::min(memory / 4 / block, most_regions)),
        static_cast<std::size_t>(std::min(memory / 4 / copies_of_sample / sizeof(detail::KeyBox<S>), most_sampled))};
  }

  std::size_t boxes;    // in memory at once
  std::size_t block;    // bytes
  std::size_t regions;  // written at once
  std::size_t sample;   // boxes
};

template <class S>
class OutOfCoreSearch {
 public:
  OutOfCoreSearch(WidePairSink sink, const OutOfCoreOptions& options, OutOfCoreStats& stats)
      : options_(options),
        budget_(Budget::of<S>(options.memory)),
        stats_(stats),
        detector_({options.executor}),
        sink_(sink),
        first_(budget_.boxes),
        second_(budget_.boxes / 2) {}

  void run(BasicBoxReader<S>& reader) {
    detail::ReaderBoxes<S> boxes(reader, stats_);
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
    StreamSample<S> sample(budget_.sample);
    std::uint64_t size = 0;
    first_.clear();
    for_each(boxes, [&](const NumberedBox<S>& box) {
      ++size;
      sample.add(box.box);
      if (!first_.is_full()) first_.add(box, region);
      return true;
    });
    if (size <= budget_.boxes) return join(first_);
    if (size > above - above / 8) return search_blocks(boxes, region);  // the sample misled
    return divide(boxes, region, size, std::move(sample));
  }

  bool divide(NumberedBoxes<S>& boxes, const Region<S>& region, std::uint64_t size, StreamSample<S> sample) {
    // Some less than fits, for a sample estimates.
    const double fits = 0.8 * static_cast<double>(budget_.boxes) / static_cast<double>(size);
    const auto most_boxes = static_cast<std::size_t>(fits * static_cast<double>(sample.size()));
    const Regions<S> regions(region, sample.boxes(), most_boxes, budget_.regions);
    sample = StreamSample<S>(0);
    if (regions.size() == 1) return search_blocks(boxes, region);
    std::vector<StoredBoxes<S>> parts = distribute(boxes, regions);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      StoredBoxes<S> part = std::move(parts[i]);  // its blocks are free afterwards
      if (!search(part, regions[i], size)) return false;
    }
    return true;
  }

  std::vector<StoredBoxes<S>> distribute(NumberedBoxes<S>& boxes, const Regions<S>& regions) {
    if (!file_) file_.emplace(options_.directory, budget_.block);
    std::vector<StoredBoxes<S>> parts;
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

  /// Blocks of boxes with each other, all with all.
  bool search_blocks(NumberedBoxes<S>& boxes, const Region<S>& region) {
    const std::uint64_t in_block = budget_.boxes / 2;
    for (std::uint64_t begin = 0, at = 1; at > begin; begin += in_block) {
      at = 0;
      first_.clear();
      second_.clear();
      const auto take = [&](const NumberedBox<S>& box) {
        if (const std::uint64_t i = at++; i >= begin) (i < begin + in_block ? first_ : second_).add(box, region);
        if (second_.boxes().size() < in_block) return true;
        const bool go_on = join(first_, second_);
        second_.clear();
        return go_on;
      };
      if (!for_each(boxes, take) || !join(first_, second_) || !join(first_)) return false;
    }
    return true;
  }

  bool join(const LoadedBoxes<S>& set) {
    ++stats_.searches;
    bool go_on = true;
    detector_.stream_pairs(set.boxes(), [&](Span<const Pair> pairs) { return go_on = deliver(set, set, pairs); });
    return go_on;
  }

  bool join(const LoadedBoxes<S>& a, const LoadedBoxes<S>& b) {
    ++stats_.searches;
    bool go_on = true;
    detector_.stream_pairs(a.boxes(), b.boxes(), [&](Span<const Pair> pairs) { return go_on = deliver(a, b, pairs); });
    return go_on;
  }

  bool deliver(const LoadedBoxes<S>& a, const LoadedBoxes<S>& b, Span<const Pair> pairs) {
    owned_.clear();
    for (const Pair pair : pairs)
      if (a.owns(pair.a, b, pair.b)) owned_.push_back({a.number(pair.a), b.number(pair.b)});
    stats_.pairs += owned_.size();
    return owned_.empty() || sink_(owned_);
  }

  const OutOfCoreOptions& options_;
  const Budget budget_;
  OutOfCoreStats& stats_;
  Detector detector_;
  WidePairSink sink_;
  std::vector<WidePair> owned_;
  LoadedBoxes<S> first_, second_;
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
